// The tables of assembly/FORMAT.md are the descriptions of the records.

#include <fstream>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "assembly/records/assembly_record.hpp"
#include "assembly/records/frame_record.hpp"
#include "assembly/records/summary_record.hpp"

namespace cupola::format_page_test {
namespace {

/// A visitor that writes a table.
struct PageTable {
  std::string text;
  explicit PageTable(const char* kind) : text(fmt::format("| {} | meaning |\n|---|---|\n", kind)) {}
  void operator()(const char* key, const char* unit, const char* meaning, const auto&) {
    text += fmt::format("| `{}` | {}{}{} |\n", key, unit, *unit == '\0' ? "" : ", ", meaning);
  }
};

template <class R>
std::string table_of(const R& record, const char* kind) {
  PageTable table(kind);
  fields(table, record);
  return table.text;
}

TEST(FormatPage, HasTheTablesOfTheRecords) {
  std::ifstream in(CUPOLA_SOURCE_DIR "/assembly/FORMAT.md");
  std::ostringstream page;
  page << in.rdbuf();
  const ContactTable contacts;
  const BlockTable blocks;
  PageTable strength("array");
  strength_fields(strength, contacts);
  PageTable contact_poses("array");
  contact_pose_fields(contact_poses, blocks);
  for (const std::string& table : {table_of(Part(), "array"),
                                   table_of(Block(), "array"),
                                   table_of(BuiltTie(), "array"),
                                   table_of(BuiltChain(), "array"),
                                   table_of(Sheet(), "array"),
                                   table_of(contacts, "array"),
                                   strength.text,
                                   table_of(blocks, "array"),
                                   contact_poses.text,
                                   table_of(TieTable(), "array"),
                                   table_of(Interruption(), "key"),
                                   table_of(Summary(), "key"),
                                   table_of(Accuracy(), "key of `accuracy`"),
                                   table_of(ForcesUnique(), "key of `forces_unique`"),
                                   table_of(LawViolation(), "key of `largest_law_violation`"),
                                   table_of(ForceCertificate{1.0, ""}, "key of `certified_force_error`"),
                                   table_of(WorstSteps(), "key of `worst_steps`"),
                                   table_of(RunStep(), "key of an entry of `worst_steps`"),
                                   table_of(Robustness(), "key of `robustness`"),
                                   table_of(Sought(), "key of `sought`"),
                                   table_of(ForceRange(), "key of an entry of `ranges`"),
                                   table_of(RangeEnd(), "key of `min` and `max`"),
                                   table_of(PartVerdict(), "key of an entry of `parts`")})
    EXPECT_NE(page.str().find("\n" + table + "\n"), std::string::npos)
        << "assembly/FORMAT.md must have this table:\n"
        << table;
}

}  // namespace
}  // namespace cupola::format_page_test

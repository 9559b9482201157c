// The tables of assembly/FORMAT.md are the descriptions of the records.

#include <fstream>
#include <sstream>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "assembly/records/frame_record.hpp"
#include "assembly/records/summary_record.hpp"

namespace cupola::format_page_test {
namespace {

template <class R>
std::string table_of(R record, const char* kind) {
  std::string table = fmt::format("| {} | meaning |\n|---|---|\n", kind);
  fields(
      [&table](const char* key, const char* unit, const char* meaning, auto&&) {
        table += fmt::format("| `{}` | {}{}{} |\n", key, unit, *unit == '\0' ? "" : ", ", meaning);
      },
      record);
  return table;
}

TEST(FormatPage, HasTheTablesOfTheRecords) {
  std::ifstream in(CUPOLA_SOURCE_DIR "/assembly/FORMAT.md");
  std::ostringstream page;
  page << in.rdbuf();
  const auto expect = [&page](const std::string& table) {
    EXPECT_NE(page.str().find(table), std::string::npos) << "assembly/FORMAT.md lacks this table:\n" << table;
  };
  expect(table_of(ContactTable(), "array"));
  expect(table_of(BlockTable(), "array"));
  expect(table_of(TieTable(), "array"));
  expect(table_of(Summary(), "key"));
  expect(table_of(Accuracy(), "key of `accuracy`"));
  expect(table_of(LawViolation(), "key of `largest_law_violation`"));
  expect(table_of(ForceCertificate{1.0, ""}, "key of `certified_force_error`"));
  expect(table_of(Robustness(), "key of `robustness`"));
  expect(table_of(ForceRange(), "key of an entry of `ranges`"));
  expect(table_of(RangeEnd(), "key of `min` and `max`"));
  expect(table_of(Interruption(), "key of `interrupted.json`"));
}

}  // namespace
}  // namespace cupola::format_page_test

#include "postproc/tables/result_tables.hpp"

#include <algorithm>
#include <cstdint>
#include <map>
#include <set>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "postproc/tables/mesh_output.hpp"
#include "tests/postproc/scene.hpp"

namespace cupola::result_tables_test {
namespace {

std::map<std::string, Table> tables_of(const Evaluation& e) {
  std::map<std::string, Table> tables;
  visit_tables(e, [&](Table table) { tables[table.name] = std::move(table); });
  return tables;
}

TEST(ResultTables, NameImportedBlocksBesideTheirNumbers) {
  Evaluation e = test::column_evaluation(0.6, 0.4);
  for (Block& block : e.assembly.blocks) block.name = "stone";
  std::set<std::string> named;
  for (const auto& [name, table] : tables_of(e))
    for (size_t c = 0; c + 1 < table.columns.size(); ++c) {
      const std::string& key = table.columns[c].key;
      if (key != "block" && key != "support") continue;
      named.insert(name);
      EXPECT_EQ(table.columns[c + 1].key, key + "_name") << name;
    }
  EXPECT_EQ(named, (std::set<std::string>{"blocks", "reactions", "section_0.8m", "wall"}));
}

// The two heights have the same six digits.
TEST(ResultTables, HaveOneTablePerSection) {
  const Assembly a = test::column(3);
  Case scene = test::column_case();
  scene.postproc.sections = {1.2, 1.2000001};
  const Evaluation e = test::evaluated(a, {test::column_at_rest(a, test::kGravity, 0.0, 0.6, 0.4)},
                                       test::column_summary(a), scene, test::fresh_folder("results"));
  const std::map<std::string, Table> tables = tables_of(e);
  for (const char* name : {"section_1.2m", "section_1.2000001m"}) {
    ASSERT_TRUE(tables.contains(name)) << name;
    EXPECT_EQ(tables.at(name).rows.size(), 1u);
  }
}

// The second of three courses has been laid.
TEST(ResultTables, LeaveOutBlocksThatAStageHasNotLaid) {
  Evaluation e = test::column_evaluation(0.6, 0.4);
  e.last.frame.role = FrameRole::stage;
  e.last.frame.time = 1.0;
  e.last.frame.contacts = {};
  EXPECT_EQ(tables_of(e).at("blocks").rows.size(), 3u) << "the support and two blocks";
  DisplacedBlocks blocks(e);
  const Mesh& mesh = blocks.at(e.last);
  const auto laid = std::ranges::find(mesh.cell_data, "laid", &MeshArray::name);
  ASSERT_NE(laid, mesh.cell_data.end());
  EXPECT_EQ(std::get<std::vector<std::int32_t>>(laid->values), (std::vector<std::int32_t>{1, 1, 1, 0}));
}

}  // namespace
}  // namespace cupola::result_tables_test

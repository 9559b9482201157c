#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "postproc/evaluation/quantity_text.hpp"
#include "postproc/figures/figures.hpp"
#include "postproc/tables/mesh_output.hpp"
#include "postproc/tables/result_columns.hpp"
#include "postproc/tables/result_tables.hpp"
#include "postproc/tables/shell_map.hpp"
#include "tests/postproc/scene.hpp"

namespace cupola::columns_test {
namespace {

template <class Row>
void expect_sound(const Columns<Row>& columns, std::initializer_list<Keys> files) {
  std::set<std::string> names;
  for (const Column<Row>& column : columns) {
    EXPECT_FALSE(column.meaning.empty()) << column.key;
    for (const std::string& key : column.in_table ? column.table_keys() : std::vector{column.array_name()})
      EXPECT_TRUE(names.insert(key).second) << key;
  }
  for (const Keys& keys : files)
    for (const char* key : keys)
      EXPECT_TRUE(std::any_of(columns.begin(), columns.end(), [&](const Column<Row>& column) {
        return column.array_name() == key;
      })) << key;
}

TEST(Columns, NamesAreUniqueAndEveryFileNamesColumnsThatExist) {
  expect_sound(ring_columns(), {kRingSummaryKeys});
  expect_sound(joint_columns(), {kJointKeys, kCrackKeys});
  expect_sound(block_columns(), {kBlockMeshKeys, kWrenchCellKeys, kWrenchPointKeys});
  expect_sound(thrust_columns(), {});
  expect_sound(hoop_columns(), {});
  expect_sound(section_columns(), {});
  expect_sound(member_columns(), {});
  expect_sound(plane_columns(), {});
  expect_sound(line_cell_columns(), {kLineCellKeys});
  expect_sound(shell_columns(), {});
  expect_sound(section_cell_columns(), {kSectionCellKeys});
}

TEST(Columns, AVectorHasThreeColumnsInATableAndOneArrayInAMesh) {
  const Column<JointWrench>& force = column_named(joint_columns(), "force_N");
  EXPECT_EQ(force.table_keys(), (std::vector<std::string>{"force_x_N", "force_y_N", "force_z_N"}));
  const Column<JointWrench>& ring = column_named(joint_columns(), "ring");
  EXPECT_EQ(ring.table_keys(), std::vector<std::string>{"ring"});
}

TEST(Columns, TablesAndMeshesHoldTheSameValues) {
  const Evaluation e = test::column_evaluation(0.7, 0.3, 2.0);
  const Table table = joint_table(e, e.last.joints.wrenches);
  const Mesh mesh = joints_mesh(e);
  const auto forces = mesh.array<double>(mesh.point_data, "force_N", 3);
  const auto kinds = mesh.array<std::int32_t>(mesh.point_data, "kind", 1);
  ASSERT_EQ(forces.size(), 3 * table.rows.size()) << "a sum over the file counts every joint once";
  EXPECT_EQ(mesh.num_cells(), static_cast<int>(table.rows.size()));
  size_t force_x = 0;
  while (table.columns.at(force_x).key != "force_x_N") ++force_x;
  for (size_t j = 0; j < table.rows.size(); ++j) {
    for (size_t i = 0; i < 3; ++i) EXPECT_EQ(std::get<double>(table.rows[j][force_x + i]), forces[3 * j + i]);
    EXPECT_EQ(std::get<std::string>(table.rows[j][2]), to_string(static_cast<JointKind>(kinds[j])));
  }
}

// Gravity that leans: loads and forces beside columns along z are along z, too.
TEST(Columns, VerticalIsAlongZ) {
  const Assembly a = test::column_with_wythes();
  Case scene = test::column_case();
  scene.loads.gravity = Vec3(2.0, 0.0, -test::kGravity);
  scene.postproc.planes = {{"middle", {0.0, 0.0, 0.8}, Vec3::UnitZ()}};
  Frame frame = test::column_at_rest(a, test::kGravity, 0.0, 0.6, 0.4);
  for (Vec3& force : frame.contacts.force) force.x() = -2.0 / test::kGravity * force.z();
  const Evaluation e =
      test::evaluated(a, {frame}, test::column_summary(a), scene, test::fresh_folder("results"));
  const double weight = free_weight(a, test::kGravity), rounding = 1e-12 * weight;
  const auto found = [](const Table& table, const std::string& key, size_t row) {
    const auto column = std::ranges::find(table.columns, key, &Table::Column::key) - table.columns.begin();
    return std::get<double>(table.rows.at(row).at(static_cast<size_t>(column)));
  };
  EXPECT_NEAR(found(ring_table(e), "load_above_N", 0), weight, rounding);
  EXPECT_NEAR(found(ring_table(e), "joint_force_z_N", 0), weight, rounding);
  EXPECT_NEAR(found(wythe_table(e), "vertical_force_N", 0), weight, rounding);
  EXPECT_NEAR(found(member_table(e), "vertical_force_N", 0), weight, rounding);
  const ForceUnit unit = force_unit(weight / 3.0);
  EXPECT_NE(section_figure(e, e.sections.at(0))
                .caption.find(fmt::format("add up to {:.5g} {}.", unit.per_newton * weight / 3.0, unit.name)),
            std::string::npos);
  EXPECT_NE(plane_figure(e, e.planes.at(0))
                .caption.find(fmt::format("{:.5g} {}", unit.per_newton * weight / 3.0, unit.name)),
            std::string::npos)
      << plane_figure(e, e.planes[0]).caption;
}

// Readers tell integers from doubles, also where nothing has cracked.
TEST(Columns, ArraysKeepTheirTypeWithoutRows) {
  const Mesh cracks = cracks_mesh(test::column_evaluation(0.6, 0.4));
  ASSERT_EQ(cracks.num_cells(), 0);
  EXPECT_TRUE(cracks.array<double>(cracks.cell_data, "opening_m", 1).empty());
  EXPECT_TRUE(cracks.array<std::int32_t>(cracks.cell_data, "kind", 1).empty());
}

}  // namespace
}  // namespace cupola::columns_test

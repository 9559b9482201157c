#include <algorithm>

#include <fmt/format.h>

#include "postproc/tables/observed_cracks.hpp"
#include "postproc/tables/result_columns.hpp"
#include "postproc/tables/shell_map.hpp"

namespace cupola {
namespace {

struct MeshFile {
  const char* name;
  std::vector<Keys> keys;
};

bool holds(const MeshFile& mesh, const std::string& array) {
  return std::any_of(mesh.keys.begin(), mesh.keys.end(), [&](const Keys& keys) {
    return std::find(keys.begin(), keys.end(), array) != keys.end();
  });
}

std::string head_of(const std::string& heading) {
  return "### " + heading + "\n\n| column | unit | meaning | also in |\n|---|---|---|---|\n";
}

template <class Row>
std::string reference_of(const std::string& heading, const Columns<Row>& columns,
                         const std::vector<MeshFile>& meshes) {
  std::string text = head_of(heading);
  for (const Column<Row>& column : columns) {
    const std::string array = column.array_name();
    std::vector<std::string> names = column.in_table ? column.table_keys() : std::vector{array}, files;
    for (const MeshFile& mesh : meshes)
      if (holds(mesh, array)) files.push_back(mesh.name);
    text += fmt::format("| `{}` | {} | {} |", fmt::join(names, "`, `"), column.unit, column.meaning);
    if (!files.empty())
      text += fmt::format(" `{}`{}", fmt::join(files, "`, `"),
                          array == names.front() ? "" : fmt::format(", as `{}`", array));
    text += " |\n";
  }
  return text + "\n";
}

}  // namespace

std::string column_reference(const std::vector<CopiedTable>& further) {
  std::string copies;
  for (const CopiedTable& table : further) {
    copies += head_of(table.heading);
    for (const Table::Column& column : table.columns)
      copies += fmt::format("| `{}` | {} | {} | |\n", column.key, column.unit, column.meaning);
    copies += "\n";
  }
  return reference_of("ranges.csv: ranges over all admissible states", range_columns(),
                      {{"summary.json", {kRangeSummaryKeys}}}) +
         reference_of("rings.csv: ring cuts", ring_columns(), {{"summary.json", {kRingSummaryKeys}}}) +
         reference_of("reactions.csv: forces on the supports", reaction_columns(), {}) +
         reference_of("members.csv: wythes and bonders", member_columns(), {}) +
         reference_of("wythes.csv: what passes through each wythe", wythe_columns(), {}) +
         reference_of("thrust_NAME.csv, thrust_NAME_WYTHE.csv: thrust line of a meridian", thrust_columns(),
                      {}) +
         reference_of("hoop_NAME.csv: hoop forces across a meridian", hoop_columns(), {}) +
         reference_of("chains.csv: tension of chains", chain_columns(),
                      {{"summary.json", {kChainSummaryKeys}}}) +
         reference_of("ties.csv: bars of chains and other ties", tie_columns(), {{"ties.vtp", {kTieKeys}}}) +
         reference_of("cracks.csv: open joints that follow each other", crack_columns(),
                      {{"cracks.vtp", {kCrackNumberKeys}}}) +
         reference_of("observed.csv: cracks seen on the building and those of the run", observed_columns(),
                      {}) +
         reference_of("section_HEIGHTm.csv: resultants across a bed", section_columns(), {}) +
         reference_of("cut_NAME.csv: joints across a plane", plane_columns(), {}) +
         reference_of("joints.csv, joints.vtp, joint_forces.vtp, cracks.vtp: joints", joint_columns(),
                      {{"joints.vtp", {kJointKeys}},
                       {"joint_forces.vtp", {kJointKeys}},
                       {"cracks.vtp", {kCrackKeys}}}) +
         reference_of(
             "blocks.csv, blocks_NNNN.vtu, wrenches.vtp: blocks", block_columns(),
             {{"blocks_NNNN.vtu", {kBlockMeshKeys}}, {"wrenches.vtp", {kWrenchCellKeys, kWrenchPointKeys}}}) +
         reference_of(
             "shell.csv, wall.csv, arch.csv, shell_WYTHE.csv, wall_WYTHE.csv, arch_WYTHE.csv: blocks of the "
             "unrolled shell",
             shell_columns(), {}) +
         reference_of("thrust_lines.vtp: cells", line_cell_columns(),
                      {{"thrust_lines.vtp", {kLineCellKeys}}}) +
         reference_of("sections.vtp: cells", section_cell_columns(), {{"sections.vtp", {kSectionCellKeys}}}) +
         copies;
}

}  // namespace cupola

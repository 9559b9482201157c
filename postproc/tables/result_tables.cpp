#include "postproc/tables/result_tables.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "postproc/evaluation/meridians.hpp"
#include "postproc/evaluation/sections.hpp"
#include "postproc/tables/observed_cracks.hpp"
#include "postproc/tables/result_columns.hpp"
#include "postproc/tables/shell_map.hpp"

namespace cupola {
namespace {

/// Inserts the names of imported blocks after the columns with their numbers.
Table with_block_names(const Assembly& assembly, Table table) {
  if (assembly.blocks.empty() || assembly.blocks.front().name.empty()) return table;
  for (size_t c = 0; c < table.columns.size(); ++c) {
    const std::string key = table.columns[c].key;
    if (key != "block" && key != "block_a" && key != "block_b" && key != "support") continue;
    const auto after = static_cast<std::ptrdiff_t>(c) + 1;
    table.columns.insert(table.columns.begin() + after, {key + "_name", "", "its name in the imported file"});
    for (auto& row : table.rows)
      row.insert(row.begin() + after, assembly.blocks[static_cast<size_t>(std::get<int>(row[c]))].name);
  }
  return table;
}

/// Inserts the names of wythes and groups of bonders after the kinds of the blocks in column `block`.
Table with_member_names(const Assembly& assembly, Table table) {
  if (assembly.members.empty()) return table;
  const auto kind = std::ranges::find(table.columns, "kind", &Table::Column::key);
  const auto after = kind - table.columns.begin() + 1;
  const auto index = std::ranges::find(table.columns, "block", &Table::Column::key) - table.columns.begin();
  table.columns.insert(table.columns.begin() + after, {"member", "", "its wythe or group of bonders"});
  for (auto& row : table.rows) {
    const Block& block = assembly.blocks[static_cast<size_t>(std::get<int>(row[index]))];
    row.insert(row.begin() + after, block.fixed ? "" : assembly.members[block.member]);
  }
  return table;
}

/// m, between the lowest and the highest height of a column; infinity without two that differ.
double spread_of(const Table& table, size_t column) {
  constexpr double kUnknown = std::numeric_limits<double>::infinity();
  double low = kUnknown, high = -kUnknown;
  for (const auto& row : table.rows) {
    low = std::fmin(low, std::get<double>(row[column]));  // skips NaN
    high = std::fmax(high, std::get<double>(row[column]));
  }
  return high > low ? high - low : kUnknown;
}

/// Gives the columns of forces the floor of the frame, those of moments that times the size of a block, those
/// of forces per metre that over it; those of heights their spread.
void set_floors(double force, double size, Table* table) {
  for (size_t i = 0; i < table->columns.size(); ++i) {
    Table::Column& column = table->columns[i];
    if (column.unit == "N") column.floor = force;
    if (column.unit == "N m") column.floor = force * size;
    if (column.unit == "N/m" && size > 0.0) column.floor = force / size;
    if (column.key == "height_m") column.spread = spread_of(*table, i);
  }
}

/// Calls a function with the rows, piece by piece; once if there are none.
template <class Row, class Take>
void in_pieces(const std::vector<Row>& rows, const Take& take) {
  constexpr size_t kPiece = 1000;
  for (size_t start = 0; start == 0 || start < rows.size(); start += kPiece)
    take(std::span(rows).subspan(start, std::min(kPiece, rows.size() - start)));
}

}  // namespace

Table range_table(const std::vector<ForceRange>& ranges) {
  return make_table("ranges", "Ranges over all admissible states", range_columns(), ranges);
}

Table ring_table(const Evaluation& e) {
  std::vector<RingSum> rows = e.rings;
  std::erase_if(rows, [](const RingSum& cut) { return cut.blocks == 0; });
  return make_table("rings", "Ring cuts: joint forces below each ring against the load above it",
                    ring_columns(), rows);
}

Table member_table(const Evaluation& e) {
  return make_table("members", "What wythes and bonders carry through the cut below each ring",
                    member_columns(), member_rows(e));
}

Table wythe_table(const Evaluation& e) {
  return make_table("wythes", "What passes through each wythe of the cut below each ring", wythe_columns(),
                    wythe_rows(e));
}

Table joint_table(const Evaluation& e, std::span<const JointWrench> joints) {
  const std::string title =
      "Joints" + of_extent(e) + ": wrench on the second block about the centre of pressure";
  return with_block_names(e.assembly, make_table("joints", title, joint_columns(), joints));
}

Table block_table(const Evaluation& e, std::span<const BlockRow> blocks) {
  Table table = make_table("blocks", "Blocks: wrench from the ring below, shell forces, joints, displacement",
                           block_columns(), blocks);
  return with_block_names(e.assembly, with_member_names(e.assembly, std::move(table)));
}

Table thrust_table(const ThrustLine& line) {
  return make_table("thrust_" + in_file_names(line.name), "Thrust line of the meridian " + line.name,
                    thrust_columns(), line.points);
}

Table hoop_table(const MeridianEvaluation& m) {
  return make_table("hoop_" + in_file_names(m.thrust.name),
                    "Hoop forces across the meridian " + m.thrust.name, hoop_columns(), m.hoop);
}

Table crack_table(const Evaluation& e) {
  const bool dilates = e.scene.analysis.friction_law != FrictionLaw::coulomb;
  return make_table(
      "cracks",
      std::string("Cracks: open joints that follow each other over the shell") +
          (dilates ? "; sliding joints open by friction times slip under this friction law" : ""),
      crack_columns(), crack_rows(e));
}

Table chain_table(const Evaluation& e) {
  return make_table("chains", "Chains: tension of their bars", chain_columns(), e.chains);
}

Table tie_table(const Evaluation& e) {
  return with_block_names(e.assembly,
                          make_table("ties", "Bars of chains and other ties", tie_columns(), tie_rows(e)));
}

Table section_table(const Evaluation& e, const SectionEvaluation& section) {
  Table table = make_table(fmt::format("section_{}m", section.height),
                           fmt::format("Resultants of the blocks across the bed nearest to z = {} m ({})",
                                       section.height, beds_text(e.shell, section, "ring")),
                           section_columns(), section.resultants);
  return with_block_names(e.assembly, with_member_names(e.assembly, std::move(table)));
}

Table plane_table(const Evaluation& e, const PlaneCut& cut) {
  return with_block_names(e.assembly, make_table("cut_" + cut.name, "Joints across the plane " + cut.name,
                                                 plane_columns(), plane_joints(e, cut)));
}

void visit_tables(const Evaluation& e, const std::function<void(Table)>& take) {
  const double floor = e.last.joints.floor.force, size = block_size(e.assembly);
  const auto add = [&](Table table) {
    set_floors(floor, size, &table);
    take(std::move(table));
  };
  if (!e.summary.ranges.empty()) add(range_table(e.summary.ranges));
  if (!e.rings.empty()) add(ring_table(e));
  if (!e.reactions.empty())
    add(with_block_names(e.assembly,
                         make_table("reactions", "Forces on the supports", reaction_columns(), e.reactions)));
  if (!e.cracks.empty()) add(crack_table(e));
  if (const auto observed = crack_agreement(e)) add(observed_table(*observed));
  if (!e.members.empty()) add(member_table(e));
  if (!e.wythes.empty()) add(wythe_table(e));
  for (const MeridianEvaluation& m : e.meridians) {
    add(thrust_table(m.thrust));
    for (const ThrustLine& line : m.wythes) {
      Table table = thrust_table(line);
      table.title = fmt::format("Thrust line of the meridian {}, wythe {}", m.thrust.name,
                                e.assembly.members[*line.wythe]);
      add(std::move(table));
    }
    if (!m.hoop.empty()) add(hoop_table(m));
  }
  if (!e.chains.empty()) add(chain_table(e));
  if (e.last.frame.ties.size() > 0) add(tie_table(e));
  for (const SectionEvaluation& section : e.sections) add(section_table(e, section));
  for (const PlaneCut& cut : e.planes) add(plane_table(e, cut));
  for (const ShellMap& map : shell_maps(e))
    in_pieces(map.boxes, [&](auto boxes) { add(with_block_names(e.assembly, shell_table(map, boxes))); });
  in_pieces(e.last.joints.wrenches, [&](auto joints) { add(joint_table(e, joints)); });
  std::vector<BlockRow> laid;
  for (const BlockRow& row : block_rows(e, e.last))
    if (row.laid) laid.push_back(row);
  in_pieces(laid, [&](auto piece) { add(block_table(e, piece)); });
}

}  // namespace cupola

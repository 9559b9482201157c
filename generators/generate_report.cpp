#include "generators/generate_report.hpp"

#include <algorithm>
#include <limits>
#include <map>

#include <fmt/format.h>
#include <nlohmann/json.hpp>

namespace cupola {
namespace {

/// Number and volumes (m3) of a class of blocks.
struct SizeClass {
  int count = 0;
  double smallest = std::numeric_limits<double>::infinity(), largest = 0.0, sum = 0.0;

  void add(double volume) {
    ++count;
    smallest = std::min(smallest, volume);
    largest = std::max(largest, volume);
    sum += volume;
  }
};

std::string kind_of(const Block& block) {
  return to_string(block.kind) + (block.truncated ? ", truncated" : "") +
         (block.rib ? ", across a corner" : "");
}

struct SizeTable {
  std::map<std::string, SizeClass> by_kind;
  std::map<int, SizeClass> by_ring;
};

SizeTable size_table(const Assembly& assembly) {
  SizeTable table;
  for (const Block& block : assembly.blocks) {
    if (block.kind == BlockKind::support) continue;
    table.by_kind[kind_of(block)].add(block.volume);
    table.by_ring[block.ring].add(block.volume);
  }
  return table;
}

nlohmann::ordered_json to_json(const SizeClass& sizes) {
  return {{"blocks", sizes.count},
          {"smallest_m3", sizes.smallest},
          {"mean_m3", sizes.sum / sizes.count},
          {"largest_m3", sizes.largest}};
}

std::string row(const std::string& name, const SizeClass& sizes) {
  return fmt::format("  {:32} {:7} {:12.6g} {:12.6g} {:12.6g}\n", name, sizes.count, sizes.smallest,
                     sizes.sum / sizes.count, sizes.largest);
}

}  // namespace

std::string report_json(const Assembly& assembly, const GenerateReport& report) {
  const ModelReport& m = report.model;
  nlohmann::ordered_json json{{"title", assembly.title},
                              {"blocks", m.num_blocks},
                              {"supports", m.num_supports},
                              {"parts", m.num_parts},
                              {"joints", m.num_joints},
                              {"islands", m.islands},
                              {"blocks_without_joint", m.blocks_without_joint},
                              {"blocks_on_edges", m.blocks_on_edges},
                              {"volume_m3", m.volume},
                              {"parts_volume_m3", m.parts_volume},
                              {"smallest_block_m3", m.smallest_block},
                              {"largest_block_m3", m.largest_block},
                              {"max_convexity_error_m", m.max_convexity_error},
                              {"max_planarity_error_m", m.max_planarity_error},
                              {"max_overlap_m", std::max(m.max_overlap, 0.0)},
                              {"max_joint_gap_m", m.max_joint_gap},
                              {"shortest_edge_m", m.shortest_edge}};
  if (m.shell_volume) {
    json["shell_volume_m3"] = *m.shell_volume;
    json["facets_leave_out"] = 1.0 - m.volume / *m.shell_volume;
  }
  json["warnings"] = assembly.block_warnings;
  for (const std::string& text : assembly.case_warnings) json["warnings"].push_back(text);
  const SizeTable table = size_table(assembly);
  for (const auto& [kind, sizes] : table.by_kind) json["sizes_by_kind"][kind] = to_json(sizes);
  for (const auto& [ring, sizes] : table.by_ring) json["sizes_by_ring"].push_back(to_json(sizes));
  if (!report.import) return json.dump(2) + "\n";
  const ImportReport& i = *report.import;
  json["import"] = {{"already_convex", i.already_convex},
                    {"split_by_planes", i.by_planes},
                    {"split_by_cross_section", i.as_prisms},
                    {"split_by_nef", i.by_nef},
                    {"snapped_facets", i.snapped_facets},
                    {"sliver_parts", i.sliver_parts},
                    {"largest_volume_error", i.largest_volume_error},
                    {"doubled_faces", i.doubled_faces},
                    {"volume_m3", i.volume_of_parts},
                    {"drawn_volume_m3", i.drawn_volume},
                    {"courses", i.courses.courses},
                    {"courses_refused", i.courses.refusal},
                    {"ties", i.ties}};
  for (size_t b = 0; b < i.origins.size(); ++b)
    json["import"]["parts_per_block"].push_back({{"block", i.origins[b].name}, {"parts", i.parts[b]}});
  return json.dump(2) + "\n";
}

std::string report_text(const Assembly& assembly, const GenerateReport& report) {
  const SizeTable table = size_table(assembly);
  std::string text = (assembly.title.empty() ? "" : assembly.title + "\n") + to_text(report);
  for (const auto* warnings : {&assembly.block_warnings, &assembly.case_warnings})
    for (const std::string& warning : *warnings) text += "warning: " + warning + "\n";
  text += fmt::format("\n{:34} {:>7} {:>12} {:>12} {:>12}\n", "block volumes, m3", "blocks", "smallest",
                      "mean", "largest");
  for (const auto& [kind, sizes] : table.by_kind) text += row(kind, sizes);
  if (table.by_ring.size() > 1)
    for (const auto& [ring, sizes] : table.by_ring) text += row(fmt::format("ring {}", ring), sizes);
  return text;
}

}  // namespace cupola

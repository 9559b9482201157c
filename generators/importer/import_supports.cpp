#include "generators/importer/import_supports.hpp"

#include <algorithm>
#include <limits>
#include <set>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/model/joint_rule.hpp"

namespace cupola {
namespace {

void fix(int block, Assembly* assembly) {
  assembly->blocks[block].fixed = true;
  assembly->blocks[block].kind = BlockKind::support;
  assembly->blocks[block].ring = -1;
  for (Part& part : assembly->parts)
    if (part.block == block) part.ring = -1;
}

/// Per block, the z of its lowest corner, m.
std::vector<double> lowest_corners(const Assembly& assembly) {
  std::vector<double> lowest(assembly.blocks.size(), std::numeric_limits<double>::infinity());
  for (const Part& part : assembly.parts)
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f)
      for (const int v : assembly.face(f))
        lowest[part.block] = std::min(lowest[part.block], assembly.vertices[v].z());
  return lowest;
}

}  // namespace

void fix_supports(const ImportedBlocks& source, const std::vector<RawBlock>& raw, const ImportReport& report,
                  Assembly* assembly) {
  const std::set<std::string> named(source.supports.begin(), source.supports.end());
  const std::vector<double> lowest = lowest_corners(*assembly);
  const double plane = report.low.z() + joint_rule(smallest_block_size(*assembly), 0.0).min_width;
  for (size_t b = 0; b < raw.size(); ++b)
    if (named.contains(raw[b].name) || (source.flagged_supports && raw[b].fixed) ||
        (source.fixed_below && assembly->blocks[b].centroid.z() < *source.fixed_below) ||
        (source.fixed_by == ImportedBlocks::SupportRule::lowest && lowest[b] <= plane))
      fix(static_cast<int>(b), assembly);
}

std::string doubt_of_axes(const ImportedBlocks& source, const ImportReport& report,
                          const Assembly& assembly) {
  constexpr double kBottom = 0.15, kMiddle = 0.25;  // of the extents
  const Vec3 extents = report.high - report.low;
  Vec3 mean = Vec3::Zero();
  double highest = 0.0;
  int count = 0;
  for (const Block& block : assembly.blocks) {
    if (!block.fixed) continue;
    const Vec3 share = (block.centroid - report.low).cwiseQuotient(extents);
    mean += share;
    highest = std::max(highest, share.y());
    ++count;
  }
  if (count == 0 || source.up == ImportedBlocks::UpAxis::y || highest > kBottom) return {};
  if (mean.z() / count < kMiddle) return {};
  return "all supports lie at the lower end of y, and not at that of z: if y is upward in the file, set "
         "geometry.import.up: y";
}

int fix_ends(const ImportedBlocks& source, std::span<const FacePair> joints, Assembly* assembly) {
  if (source.fixed_by != ImportedBlocks::SupportRule::one_neighbour) return 0;
  std::vector<std::set<int>> neighbours(assembly->blocks.size());
  for (const FacePair& joint : joints) {
    const int a = assembly->parts[joint.part_a].block, b = assembly->parts[joint.part_b].block;
    neighbours[a].insert(b);
    neighbours[b].insert(a);
  }
  int ends = 0;
  for (size_t b = 0; b < neighbours.size(); ++b) {
    if (neighbours[b].size() != 1 || assembly->blocks[b].fixed) continue;
    fix(static_cast<int>(b), assembly);
    ++ends;
  }
  return ends;
}

void refuse_all_fixed(const ImportedBlocks& source, const Assembly& assembly) {
  if (!std::ranges::all_of(assembly.blocks, &Block::fixed)) return;
  using enum ImportedBlocks::SupportRule;
  throw InputError(fmt::format("geometry.import.{}: all blocks are fixed; leave those free that may move",
                               source.fixed_below        ? "fixed_below"
                               : source.fixed_by != none ? "fixed_by"
                               : source.supports.empty() ? "flagged_supports"
                                                         : "supports"));
}

}  // namespace cupola

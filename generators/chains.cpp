#include "generators/chains.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "generators/surface/azimuth.hpp"

namespace cupola {
namespace {

// Of the thickness: how far the chords of a faceted shell may leave an anchor outside its block.
constexpr double kMostOutside = 0.1;

struct Anchor {
  int block = 0;
  Vec3 point = Vec3::Zero();  // m
};

/// Finds the block in which a point lies. Points outside by less than `tolerance`, beyond the chord of a
/// curved skin, belong to the nearest block.
class BlockFinder {
 public:
  explicit BlockFinder(const Assembly& assembly) : assembly_(assembly) {
    for (const Part& part : assembly.parts) {
      Eigen::AlignedBox3d box;
      for (int f = part.face_start; f < part.face_start + part.num_faces; ++f)
        for (const int v : assembly.face(f)) box.extend(assembly.vertices[v]);
      boxes_.push_back(box);
    }
  }
  /// -1: no block is that near. `tolerance`: m.
  int block_at(const Vec3& point, double tolerance) const {
    double best = -std::numeric_limits<double>::infinity();
    int block = -1;
    for (const bool inside : {true, false})  // the second pass has to look at few boxes only
      for (size_t i = 0; i < boxes_.size(); ++i) {
        if (boxes_[i].contains(point) != inside) continue;
        if (!inside && -boxes_[i].exteriorDistance(point) <= best) continue;
        const double depth = depth_in(assembly_.parts[i], point);
        if (depth <= best) continue;
        best = depth;
        block = assembly_.parts[i].block;
      }
    return best < -tolerance ? -1 : block;
  }

 private:
  /// Least distance to the planes of the faces, m, positive inside.
  double depth_in(const Part& part, const Vec3& point) const {
    double depth = std::numeric_limits<double>::infinity();
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f) {
      const Plane plane = polygon_plane(face_points(assembly_, f));
      depth = std::min(depth, plane.offset - plane.normal.dot(point));
    }
    return depth;
  }

  const Assembly& assembly_;
  std::vector<Eigen::AlignedBox3d> boxes_;
};

/// Consecutive slices of one block at the level of a chain; `end` may lie beyond the seam.
struct Run {
  int block = 0;
  double start = 0.0, end = 0.0;  // abscissae
};

/// The level of one chain in its member.
class Level {
 public:
  Level(const Chain& chain, std::string key, const Storey& shell)
      : chain_(chain), key_(std::move(key)), shell_(shell) {
    if (chain.course >= 0) bed_ = (chain.course + 0.5) * shell.refinement * shell.surface.rows_per_ring;
  }
  Vec3 point(double abscissa) const { return at(bed(abscissa), abscissa, chain_.place); }
  /// The abscissa whose azimuth lies ahead of that of another by an angle (rad).
  double abscissa_ahead(double from, double angle) const {
    const auto point = [&](double abscissa) { return own(bed(abscissa), abscissa, chain_.place); };
    const Vec3 start = point(from);
    return abscissa_at(point, std::atan2(start.y(), start.x()) + angle, from + angle);
  }
  int block(double abscissa, const BlockFinder& blocks) const {
    return block_on(bed(abscissa), abscissa, blocks);
  }
  /// The anchors of a rod, on both sides of a barrel.
  std::pair<Anchor, Anchor> across(double abscissa, const BlockFinder& blocks) const {
    int crown = 0;
    for (int row = 1; row <= shell_.surface.num_rows; ++row)
      if (own(row, abscissa, chain_.place).z() > own(crown, abscissa, chain_.place).z()) crown = row;
    std::array<Anchor, 2> anchors;
    for (const auto& [i, foot] : {std::pair(0, 0), {1, shell_.surface.num_rows}}) {
      const double level = bed(abscissa, foot, crown);
      anchors[i] = {block_on(level, abscissa, blocks), at(level, abscissa, chain_.place)};
    }
    return {anchors[0], anchors[1]};
  }
  /// Of the course at its level.
  const std::vector<double>& cuts() const {
    const int ring = static_cast<int>(bed(0.0)) / shell_.surface.rows_per_ring;
    return shell_.bond.cuts_of(std::min(ring, shell_.bond.num_rings - 1));
  }
  double bed(double abscissa) const { return bed_ ? *bed_ : bed(abscissa, 0.0, shell_.surface.num_rows); }

 private:
  int block_on(double level, double abscissa, const BlockFinder& blocks) const {
    const double thickness = (at(level, abscissa, 1.0) - at(level, abscissa, 0.0)).norm();
    const int found = blocks.block_at(at(level, abscissa, chain_.place), kMostOutside * thickness);
    if (found < 0)
      throw InputError(
          fmt::format("{}.place = {}: a bar would end more than {:g} of the thickness outside the blocks, in "
                      "a cavity or beyond the facets of few slices; give a place in which all anchors lie in "
                      "blocks, from 0 (intrados) to 1 (extrados), or more slices_per_block",
                      key_, chain_.place, kMostOutside));
    return found;
  }
  /// The bed at the height of the chain, between a lower bed and a higher one.
  double bed(double abscissa, double low, double high) const {
    const double height = *chain_.height, bottom = own(low, abscissa, chain_.place).z(),
                 top = own(high, abscissa, chain_.place).z();
    if (height <= bottom || height >= top)
      throw InputError(
          fmt::format("{}.height = {}: must lie between {:.6g} and {:.6g} m, the ends of the masonry there",
                      key_, height, bottom, top));
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (own(middle, abscissa, chain_.place).z() < height ? low : high) = middle;
    }
    return low;
  }
  /// A point in the frame of the member.
  Vec3 own(double bed, double abscissa, double place) const {
    const SurfaceMap& surface = shell_.surface;
    return (1.0 - place) * surface.intrados(bed, abscissa) + place * surface.extrados(bed, abscissa);
  }
  Vec3 at(double bed, double abscissa, double place) const {
    return shell_.placement * own(bed, abscissa, place);
  }

  const Chain& chain_;
  std::string key_;
  const Storey& shell_;
  std::optional<double> bed_;
};

std::vector<Run> runs_of_blocks(const Level& level, const std::vector<double>& cuts, double extent,
                                const BlockFinder& blocks) {
  const int num_slices = static_cast<int>(cuts.size()) - 1;
  std::vector<int> block_of;
  for (int s = 0; s < num_slices; ++s) block_of.push_back(level.block(0.5 * (cuts[s] + cuts[s + 1]), blocks));
  std::vector<Run> runs;
  for (int s = 0; s < num_slices; ++s)
    if (runs.empty() || runs.back().block != block_of[s])
      runs.push_back({block_of[s], cuts[s], cuts[s + 1]});
    else
      runs.back().end = cuts[s + 1];
  if (runs.size() > 1 && runs.front().block == runs.back().block) {
    runs.front().start = runs.back().start - extent;
    runs.pop_back();
  }
  return runs;
}

std::vector<std::pair<Anchor, Anchor>> clamps(const Level& level, const std::vector<Run>& runs,
                                              const Chain& chain, const std::string& key) {
  std::vector<std::pair<Anchor, Anchor>> pairs;
  for (size_t i = 0; i < runs.size(); ++i) {
    const Run &left = runs[i], &right = runs[(i + 1) % runs.size()];
    const double joint = left.end, step = 1e-4 * (left.end - left.start);
    const double metres =
        (level.point(joint + step) - level.point(joint - step)).norm() / (2.0 * step);  // per abscissa
    const double half = 0.5 * chain.clamp_length / metres;
    const double narrowest = std::min(left.end - left.start, right.end - right.start);
    if (half >= narrowest)
      throw InputError(
          fmt::format("{}.clamp_length = {}: half of it must be below the length of a block, {:.3g} m", key,
                      chain.clamp_length, narrowest * metres));
    pairs.push_back({{left.block, level.point(joint - half)}, {right.block, level.point(joint + half)}});
  }
  return pairs;
}

std::vector<std::pair<Anchor, Anchor>> rods(const Level& level, const Chain& chain, const Storey& shell,
                                            const BlockFinder& blocks, const std::string& key) {
  std::vector<std::pair<Anchor, Anchor>> pairs;
  const double length = shell.surface.extent;
  for (const double at : chain.at.empty() ? std::vector{0.5 * length} : chain.at) {
    if (at > length)
      throw InputError(fmt::format("{}.at = {}: the barrel is {:.6g} m long", key, at, length));
    pairs.push_back(level.across(at, blocks));
  }
  return pairs;
}

std::vector<Anchor> polygon(const Level& level, const Chain& chain, const Storey& shell,
                            const BlockFinder& blocks) {
  const SurfaceMap& surface = shell.surface;
  std::vector<Anchor> anchors;
  if (chain.links == 0) {
    for (const Run& run : runs_of_blocks(level, level.cuts(), surface.extent, blocks))
      anchors.push_back({run.block, level.point(0.5 * (run.start + run.end))});
    return anchors;
  }
  const double first = surface.corners.empty() ? 0.0 : surface.corners.front();
  for (int i = 0; i < chain.links; ++i) {
    const double abscissa = level.abscissa_ahead(first, i * surface.extent / chain.links);
    anchors.push_back({level.block(abscissa, blocks), level.point(abscissa)});
  }
  return anchors;
}

BuiltTie built_tie(const std::pair<Anchor, Anchor>& ends, const Chain& chain, int index,
                   const std::string& key) {
  const auto& [a, b] = ends;
  if (a.block == b.block)
    throw InputError(fmt::format("{}: both ends of a bar lie in block {}; give fewer links", key, a.block));
  const double length = (b.point - a.point).norm();
  const double stiffness = chain.axial_stiffness / length;
  const double natural = length + chain.slack - chain.prestress / stiffness;
  if (!(natural > 0.0))
    throw InputError(
        fmt::format("{}.prestress = {}: elongates the bars by more than their length", key, chain.prestress));
  BuiltTie tie{a.block, b.block, a.point, b.point, stiffness, natural};
  tie.yield_force = chain.yield_force.value_or(tie.yield_force);
  tie.chain = index;
  return tie;
}

}  // namespace

void add_chains(const std::vector<Chain>& chains, const std::vector<Storey>& storeys, Assembly* assembly) {
  if (chains.empty()) return;
  const BlockFinder blocks(*assembly);
  for (size_t c = 0; c < chains.size(); ++c) {
    const Chain& chain = chains[c];
    const std::string key = fmt::format("geometry.chains[{}]", c);
    const auto named = std::ranges::find(storeys, chain.member, &Storey::name);
    const Storey& shell = named == storeys.end() ? storeys.back() : *named;
    const Level level(chain, key, shell);
    if (shell.stage_rings > 0 &&
        std::floor(level.bed(0.0) / shell.surface.rows_per_ring) >= shell.stage_rings)
      continue;
    std::vector<std::pair<Anchor, Anchor>> bars;
    if (chain.type == Chain::Type::rods) {
      bars = rods(level, chain, shell, blocks, key);
    } else if (chain.type == Chain::Type::clamps) {
      bars = clamps(level, runs_of_blocks(level, level.cuts(), shell.surface.extent, blocks), chain, key);
    } else {
      const std::vector<Anchor> anchors = polygon(level, chain, shell, blocks);
      for (size_t i = 0; i < anchors.size(); ++i)
        bars.emplace_back(anchors[i], anchors[(i + 1) % anchors.size()]);
    }
    BuiltChain built{chain.name, 0.0};
    for (const auto& bar : bars) {
      assembly->ties.push_back(built_tie(bar, chain, static_cast<int>(assembly->chains.size()), key));
      built.height += 0.5 * (bar.first.point.z() + bar.second.point.z()) / static_cast<double>(bars.size());
    }
    assembly->chains.push_back(built);
  }
}

}  // namespace cupola

#include "generators/bond/fill.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/base/error.hpp"

namespace cupola {
namespace {

constexpr double kInfinity = std::numeric_limits<double>::infinity();

/// The positions where joints may lie, 0 .. num_units (open) or 0 .. num_units - 1 (closed). All lengths are
/// in units of w / slices_per_block.
struct Lattice {
  int num_units, mean, narrowest, widest;
  bool closed;
  std::vector<double> corners;

  /// Distance of two positions, the shorter way round.
  double distance(double a, double b) const {
    return closed ? std::abs(std::remainder(a - b, num_units)) : std::abs(a - b);
  }
};

/// Cost of a joint at each position, given the ascending joints of the ring below. (num_units + 1)
std::vector<double> joint_costs(const Lattice& lattice, const std::vector<int>& below) {
  const double quarter = 0.25 * lattice.mean;
  std::vector<double> cost(lattice.num_units + 1, 0.0);
  for (int position = 0; position <= lattice.num_units; ++position) {
    const auto above = std::ranges::lower_bound(below, position);
    if (!below.empty())
      for (int joint : {above == below.end() ? below.front() : *above,
                        above == below.begin() ? below.back() : *(above - 1)})
        cost[position] = std::max(cost[position], 1.0 - lattice.distance(position, joint) / quarter);
    for (double corner : lattice.corners)
      if (lattice.distance(position, corner) < quarter - 1e-9) cost[position] = kInfinity;
  }
  return cost;
}

struct RingFill {
  double cost = kInfinity;
  std::vector<int> joints;  // ascending, in [0, num_units); without the two ends of an open surface
};

/// Cheapest fill between joints at `start` and start + num_units. best[end] is the lowest cost of the blocks
/// between `start` and start + end, and previous[end] the joint before that end.
RingFill fill_from(const Lattice& lattice, const std::vector<double>& joint_cost, int start) {
  const int N = lattice.num_units;
  std::vector<double> best{lattice.closed ? joint_cost[start] : 0.0};
  best.resize(static_cast<size_t>(N) + 1, kInfinity);
  std::vector<int> previous(best.size(), -1);
  for (int end = 1; end <= N; ++end) {
    const double here = end == N ? 0.0 : joint_cost[(start + end) % N];
    for (int width = lattice.narrowest; width <= std::min(lattice.widest, end); ++width) {
      const double deviation = 1.0 * width / lattice.mean - 1.0;
      const double cost = best[end - width] + deviation * deviation + here;
      if (cost < best[end]) {
        best[end] = cost;
        previous[end] = end - width;
      }
    }
  }
  RingFill fill{best[N], {}};
  if (fill.cost == kInfinity) return fill;
  for (int end = previous[N]; end > 0; end = previous[end]) fill.joints.push_back((start + end) % N);
  if (lattice.closed) fill.joints.push_back(start);
  std::ranges::sort(fill.joints);
  return fill;
}

RingFill fill_ring(const Lattice& lattice, const std::vector<int>& below) {
  const std::vector<double> cost = joint_costs(lattice, below);
  RingFill best;
  // A closed ring has a joint somewhere in its first `widest` positions.
  const int num_starts = lattice.closed ? lattice.widest : 1;
  for (int start = 0; start < num_starts; ++start) {
    RingFill fill = fill_from(lattice, cost, start);
    if (fill.cost < best.cost) best = std::move(fill);
  }
  return best;
}

Lattice make_lattice(const FillBond& bond, const BondGrid& grid) {
  const int m = bond.slices_per_block;
  Lattice lattice{bond.blocks_per_ring * bond.refine * m,
                  m,
                  static_cast<int>(std::ceil(bond.narrowest * m - 1e-9)),
                  static_cast<int>(std::floor(bond.widest * m + 1e-9)),
                  grid.closed,
                  {}};
  for (double corner : grid.corners) lattice.corners.push_back(corner / grid.extent * lattice.num_units);
  return lattice;
}

/// The bond with the given joints of each ring. Its cuts are the positions that some ring uses.
BondPattern pattern_of(const std::vector<std::vector<int>>& joints, const Lattice& lattice,
                       const BondGrid& grid) {
  std::vector<int> used;
  for (const auto& ring : joints) used.insert(used.end(), ring.begin(), ring.end());
  if (!lattice.closed) used.push_back(0);
  std::ranges::sort(used);
  used.erase(std::unique(used.begin(), used.end()), used.end());
  used.push_back(lattice.closed ? used.front() + lattice.num_units : lattice.num_units);

  BondPattern pattern;
  pattern.num_rings = grid.num_rings;
  for (int position : used) pattern.cuts.push_back(grid.extent * position / lattice.num_units);
  for (const auto& ring : joints) {
    const int first_block = static_cast<int>(pattern.blocks.size());
    const int num_blocks = static_cast<int>(ring.size()) + (lattice.closed ? 0 : 1);
    for (size_t s = 0; s + 1 < used.size(); ++s) {
      const auto passed = static_cast<int>(std::ranges::upper_bound(ring, used[s]) - ring.begin());
      pattern.block_of.push_back(first_block + passed % num_blocks);
    }
    pattern.blocks.resize(pattern.blocks.size() + num_blocks);
  }
  return pattern;
}

}  // namespace

BondPattern fill_bond(const FillBond& bond, const BondGrid& grid) {
  const Lattice lattice = make_lattice(bond, grid);
  std::vector<std::vector<int>> joints;
  for (int ring = 0; ring < grid.num_rings; ++ring) {
    const RingFill fill = fill_ring(lattice, joints.empty() ? std::vector<int>{} : joints.back());
    if (fill.cost == kInfinity)
      throw InputError(fmt::format(
          "geometry.bond: ring {} of {} cannot be filled with blocks of {} to {}; widen "
          "narrowest and widest, or increase slices_per_block",
          ring, counted(lattice.num_units, "slice"), lattice.narrowest, counted(lattice.widest, "slice")));
    joints.push_back(fill.joints);
  }
  BondPattern pattern = pattern_of(joints, lattice, grid);
  split_at_corners(grid, &pattern);
  return pattern;
}

}  // namespace cupola

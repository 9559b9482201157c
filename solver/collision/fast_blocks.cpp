#include "solver/collision/fast_blocks.hpp"

#include <algorithm>
#include <vector>

#include "solver/collision/proximity.hpp"
#include "solver/collision/tracked_pairs.hpp"

namespace cupola {
namespace {

/// Whether the boxes of two blocks that start apart meet on straight ways. `turn`: m, by which points move
/// because their block turns.
bool meet(const CollisionModel& shapes, std::span<const Pose> from, std::span<const Pose> to,
          std::span<const double> turn, int a, int b) {
  const Vec3 way = (to[a].p_WB - from[a].p_WB) - (to[b].p_WB - from[b].p_WB);
  Box swept = bounding_box(shapes.box_at(a, from[a], turn[a]));
  swept.extend(Box(swept.min() + way, swept.max() + way));
  return swept.intersects(bounding_box(shapes.box_at(b, from[b], turn[b])));
}

}  // namespace

std::optional<FastPair> fast_pair(const CollisionModel& shapes, std::span<const Pose> from,
                                  std::span<const Pose> to, double h, double middle) {
  constexpr double kTouches = 0.01;  // of the thinner block: contacts so near are known
  const int num_blocks = shapes.num_blocks();
  std::vector<double> way(num_blocks), turn(num_blocks), sought(num_blocks), thickness(num_blocks);
  for (int b = 0; b < num_blocks; ++b) {
    way[b] = motion_bound(from[b], to[b], shapes.block_radius[b]);
    turn[b] = std::max(0.0, way[b] - (to[b].p_WB - from[b].p_WB).norm());
    sought[b] = std::min(way[b], shapes.block_radius[b]);
    thickness[b] = 2.0 * shapes.block_box[b].half_sizes.minCoeff();
  }
  const double thinnest = *std::min_element(thickness.begin(), thickness.end());
  const auto is_fixed = [&](int block) { return shapes.parts[shapes.part_start[block]].fixed; };
  const auto are_near = [&](int a, int b, double padding_a, double padding_b) {
    return overlap(shapes.box_at(a, from[a], padding_a), shapes.box_at(b, from[b], padding_b));
  };
  std::optional<FastPair> worst;
  for (int a = 0; a < num_blocks; ++a) {
    if (way[a] <= sought[a] && 2.0 * middle * way[a] <= thinnest) continue;
    for (int b = 0; b < num_blocks; ++b) {
      if (a == b || (is_fixed(a) && is_fixed(b)) || !meet(shapes, from, to, turn, a, b)) continue;
      const double thin = std::min(thickness[a], thickness[b]), both = way[a] + way[b];
      double share = 1.0;
      if (!are_near(a, b, sought[a], sought[b]))
        share = std::min(sought[a] / way[a], way[b] > 0.0 ? sought[b] / way[b] : 1.0);
      if (2.0 * middle * both > thin && !are_near(a, b, kTouches * thin, kTouches * thin))
        share = std::min(share, thin / (2.0 * middle * both));
      if (share < 1.0 && (!worst || share * h < worst->longest)) worst = FastPair{a, b, way[a], share * h};
    }
  }
  return worst;
}

}  // namespace cupola

#include "postproc/figures/joint_map.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

namespace cupola {
namespace {

/// x moved by whole turns next to `near`.
double beside(double x, double near, double turn) {
  return turn > 0.0 ? x - turn * std::round((x - near) / turn) : x;
}

}  // namespace

JointMap::JointMap(ShellMap map) : map_(std::move(map)) {
  for (const ShellBox& box : map_.boxes) boxes_.emplace(box.block, box);
}

/// The common side of two boxes: upright between neighbours in a ring, level between rings; none if they do
/// not touch.
std::optional<JointMap::Side> JointMap::side_between(const ShellBox& a, const ShellBox& b) const {
  const double turn = map_.vault ? 360.0 : 0.0;
  constexpr double kTouches = 0.1;  // of the width of the narrower box
  const double shift = beside(b.from + b.to, a.from + a.to, 2.0 * turn) - (b.from + b.to);
  const double from = b.from + 0.5 * shift, to = b.to + 0.5 * shift;
  if (a.ring == b.ring) {
    const double near = kTouches * std::min(a.to - a.from, b.to - b.from);
    if (std::abs(from - a.to) <= near) return Side{0.5 * (from + a.to), double(a.ring), 0.0, 1.0};
    if (std::abs(to - a.from) <= near) return Side{0.5 * (to + a.from), double(a.ring), 0.0, 1.0};
    return std::nullopt;
  }
  const double left = std::max(a.from, from), right = std::min(a.to, to);
  if (std::abs(a.ring - b.ring) != 1 || right <= left) return std::nullopt;
  return Side{left, double(std::max(a.ring, b.ring)), right - left, 0.0};
}

std::vector<JointMap::Side> JointMap::sides_of(std::pair<int, int> joint) const {
  std::vector<Side> sides;
  const auto [a, a_end] = boxes_.equal_range(joint.first);
  const auto [b, b_end] = boxes_.equal_range(joint.second);
  if (a == a_end || b == b_end) {
    const auto [first, last] = a == a_end ? std::pair(b, b_end) : std::pair(a, a_end);
    const auto lowest = std::min_element(
        first, last, [](const auto& x, const auto& y) { return x.second.ring < y.second.ring; });
    if (lowest != last)
      sides.push_back(
          {lowest->second.from, double(lowest->second.ring), lowest->second.to - lowest->second.from, 0.0});
    return sides;
  }
  for (auto i = a; i != a_end; ++i)
    for (auto k = b; k != b_end; ++k)
      if (const auto side = side_between(i->second, k->second)) sides.push_back(*side);
  return sides;
}

bool JointMap::has(const Shell& shell, std::pair<int, int> blocks) const {
  return shell.wythes[blocks.first].contains(map_.number) &&
         shell.wythes[blocks.second].contains(map_.number);
}

void JointMap::add(std::pair<int, int> blocks, std::optional<double> value, Rows* rows) {
  for (const Side& side : sides_of(blocks)) {
    const bool first = low_ == 0.0 && high_ == 0.0;
    low_ = first ? side.x : std::min(low_, side.x);
    high_ = first ? side.x + side.dx : std::max(high_, side.x + side.dx);
    std::vector<double>& row = rows->emplace_back(std::vector{side.x, side.y, side.dx, side.dy});
    if (value) row.push_back(*value);
  }
}

std::string JointMap::outlines() const {
  Rows rows;
  for (const auto& [box, rings] : tall_boxes(map_)) {
    const double ring = box.ring;
    rows.push_back({0.5 * (box.from + box.to), ring + 0.5 * rings, box.from, box.to, ring, ring + rings});
  }
  return data_block("outlines", rows);
}

std::string JointMap::axes() const {
  double low = low_, high = high_;
  if (!map_.vault)  // the whole wall
    for (const ShellBox& box : map_.boxes) {
      low = std::min(low, box.from);
      high = std::max(high, box.to);
    }
  const double margin = 0.03 * (high - low) + 1e-3;
  return fmt::format(
      "set xrange [{}:{}]\nset yrange [{}:{}]\nset ytics {}\nset xlabel '{}'\nset ylabel '{}'\nunset "
      "grid\n",
      low - margin, high + margin, map_.first_ring - 0.3, map_.num_rings + 0.3,
      std::max(1, (map_.num_rings - map_.first_ring + 7) / 8),
      map_.vault  ? "azimuth (deg)"
      : map_.arch ? "y (m)"
                  : "along the wall (m)",
      map_.vault ? "ring" : "course");
}

}  // namespace cupola

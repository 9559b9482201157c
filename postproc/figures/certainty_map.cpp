#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <optional>

#include <fmt/format.h>

#include "postproc/figures/figures.hpp"
#include "postproc/figures/plot_style.hpp"
#include "postproc/tables/range_values.hpp"
#include "postproc/tables/shell_map.hpp"

namespace cupola {
namespace {

using Rows = std::vector<std::vector<double>>;
using BoxesOfBlocks = std::multimap<int, ShellBox>;

/// A joint in the unrolled shell: from (x, y) by (dx, dy).
struct DrawnJoint {
  double x = 0.0, y = 0.0, dx = 0.0, dy = 0.0;
};

/// x moved by whole turns next to `near`.
double beside(double x, double near, double turn) {
  return turn > 0.0 ? x - turn * std::round((x - near) / turn) : x;
}

/// The common side of two boxes: upright between neighbours in a ring, level between rings; none if they do not touch.
std::optional<DrawnJoint> side_between(const ShellBox& a, const ShellBox& b, double turn) {
  constexpr double kTouches = 0.1;  // of the width of the narrower box
  const double shift = beside(b.from + b.to, a.from + a.to, 2.0 * turn) - (b.from + b.to);
  const double from = b.from + 0.5 * shift, to = b.to + 0.5 * shift;
  if (a.ring == b.ring) {
    const double near = kTouches * std::min(a.to - a.from, b.to - b.from);
    if (std::abs(from - a.to) <= near) return DrawnJoint{0.5 * (from + a.to), double(a.ring), 0.0, 1.0};
    if (std::abs(to - a.from) <= near) return DrawnJoint{0.5 * (to + a.from), double(a.ring), 0.0, 1.0};
    return std::nullopt;
  }
  const double left = std::max(a.from, from), right = std::min(a.to, to);
  if (std::abs(a.ring - b.ring) != 1 || right <= left) return std::nullopt;
  return DrawnJoint{left, double(std::max(a.ring, b.ring)), right - left, 0.0};
}

/// The sides that two blocks share: several, where a block spans rings. With a support: its side below.
std::vector<DrawnJoint> sides_of(std::pair<int, int> joint, const BoxesOfBlocks& boxes, double turn) {
  std::vector<DrawnJoint> sides;
  const auto [a, a_end] = boxes.equal_range(joint.first);
  const auto [b, b_end] = boxes.equal_range(joint.second);
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
      if (const auto side = side_between(i->second, k->second, turn)) sides.push_back(*side);
  return sides;
}

}  // namespace

Figure certainty_map(const Evaluation& e) {
  const ShellMap map = shell_map(e);
  const double turn = map.vault ? 360.0 : 0.0;
  BoxesOfBlocks boxes;
  Rows outlines, joints, unlimited, unknown;
  for (const ShellBox& box : map.boxes) {
    boxes.emplace(box.block, box);
    outlines.push_back(
        {0.5 * (box.from + box.to), box.ring + 0.5, box.from, box.to, double(box.ring), box.ring + 1.0});
  }
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const ForceRange& range : e.summary.ranges) {
    if (!range.joint) continue;
    const double value = relative_range(range);
    for (const DrawnJoint& side : sides_of(*range.joint, boxes, turn)) {
      std::vector<double> row{side.x, side.y, side.dx, side.dy};
      low = std::min(low, side.x);
      high = std::max(high, side.x + side.dx);
      if (std::isfinite(value)) row.push_back(value);
      (std::isfinite(value) ? joints : std::isinf(value) ? unlimited : unknown).push_back(std::move(row));
    }
  }
  if (!(low <= high)) low = high = 0.0;
  const double margin = 0.03 * (high - low) + 1e-3;
  Figure f;
  f.name = "map_certainty";
  f.title = "Certainty of the joint forces over the shell";
  f.caption =
      "The joints of the unrolled shell, coloured by the width of the range of their normal force over its "
      "mean: at 0 "
      "equilibrium and friction determine the force, at 2 it may be anything from zero to its maximum.";
  f.width = 1100;
  f.height = 640;
  std::string plots =
      fmt::format("$outlines using 1:2:3:4:5:6 with boxxyerror fs empty lc rgb '{}' notitle", kGrey);
  const auto add = [&plots](const Rows& rows, const char* name, const std::string& style) {
    if (!rows.empty()) plots += fmt::format(", ${} using 1:2:3:4{}", name, style);
  };
  add(unknown, "unknown",
      fmt::format(" with vectors nohead lw 3 lc rgb '{}' title 'no force in any state, or not found'",
                  kGrey));
  add(joints, "joints", ":5 with vectors nohead lw 5 lc palette notitle");
  add(unlimited, "unlimited",
      fmt::format(" with vectors nohead lw 5 lc rgb '{}' title 'without limit'", kPurple));
  f.commands =
      plot_style() + data_block("outlines", outlines) + data_block("joints", joints) +
      data_block("unlimited", unlimited) + data_block("unknown", unknown) +
      fmt::format(
          "set xrange [{}:{}]\nset yrange [-0.3:{}]\nset xlabel '{}'\nset ylabel 'ring'\nunset grid\n"
          "set palette defined (0 '{}', 1 '#DDDDDD', 2 '{}')\nset cbrange [0:2]\n"
          "set cblabel 'width of the range over its mean'\nset key outside top right horizontal\n",
          low - margin, high + margin, map.num_rings + 0.3, map.vault ? "azimuth (deg)" : "x (m)", kBlue,
          kOrange) +
      "plot " + plots + "\n";
  return f;
}

}  // namespace cupola

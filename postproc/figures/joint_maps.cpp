#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "postproc/figures/figures.hpp"
#include "postproc/figures/joint_map.hpp"
#include "postproc/figures/plot_style.hpp"
#include "postproc/tables/range_values.hpp"

namespace cupola {
namespace {

/// Continues a plot command with segments of a data block, if it has any.
std::string segments(const JointMap::Rows& rows, const char* name, const std::string& style) {
  return rows.empty() ? "" : fmt::format(", ${} using 1:2:3:4{}", name, style);
}

/// The numbers of the widest cracks on the map, as in cracks.csv, each at its widest joint.
JointMap::Rows numbers_of_cracks(const Evaluation& e, JointMap* map) {
  constexpr size_t kMost = 12;
  const std::vector<JointWrench>& joints = e.last.joints.wrenches;
  JointMap::Rows numbers;
  for (size_t k = 0; k < e.cracks.size() && numbers.size() < kMost; ++k) {
    const int widest =
        *std::ranges::max_element(e.cracks[k].joints, {}, [&](int joint) { return joints[joint].opening; });
    const std::pair<int, int> blocks{joints[widest].block_a, joints[widest].block_b};
    JointMap::Rows sides;
    if (map->has(e.shell, blocks)) map->add(blocks, static_cast<double>(k), &sides);
    if (!sides.empty()) numbers.push_back(sides.front());
  }
  return numbers;
}

std::string outline_plot() {
  return fmt::format("$outlines using 1:2:3:4:5:6 with boxxyerror fs empty lc rgb '{}' notitle", kGrey);
}

}  // namespace

Figure certainty_map(const Evaluation& e, const ShellMap& shell) {
  JointMap map(shell);
  JointMap::Rows joints, unlimited, unknown;
  for (const ForceRange& range : e.summary.ranges) {
    if (!range.joint || !map.has(e.shell, *range.joint)) continue;
    const double value = relative_range(range);
    if (std::isfinite(value))
      map.add(*range.joint, value, &joints);
    else
      map.add(*range.joint, std::nullopt, std::isinf(value) ? &unlimited : &unknown);
  }
  Figure f;
  f.name = fmt::format("map_certainty{}", shell.suffix());
  f.title = fmt::format("Certainty of the joint forces over the {}", mapped_text(shell));
  f.caption =
      "The joints, coloured by the width of the range of their normal force over its mean: at 0 "
      "equilibrium and friction determine the force, at 2 it may be anything from zero to its maximum.";
  f.width = 1100;
  f.height = 640;
  f.vector = map.is_small();
  f.commands =
      plot_style() + map.outlines() + data_block("joints", joints) + data_block("unlimited", unlimited) +
      data_block("unknown", unknown) + map.axes() +
      fmt::format(
          "set palette defined (0 '{}', 1 '#DDDDDD', 2 '{}')\nset cbrange [0:2]\n"
          "set cblabel 'width of the range over its mean'\nset key outside top right horizontal\nplot ",
          kBlue, kOrange) +
      outline_plot() +
      segments(
          unknown, "unknown",
          fmt::format(" with vectors nohead lw 3 lc rgb '{}' title 'no force in any state, or not found'",
                      kGrey)) +
      segments(joints, "joints", ":5 with vectors nohead lw 5 lc palette notitle") +
      segments(unlimited, "unlimited",
               fmt::format(" with vectors nohead lw 5 lc rgb '{}' title 'without limit'", kPurple)) +
      "\n";
  return f;
}

Figure crack_map(const Evaluation& e, const ShellMap& shell) {
  JointMap map(shell);
  JointMap::Rows joints;
  double widest = 0.0;
  int cracks = 0;
  for (const Crack& crack : e.joint_cracks) {
    const JointWrench& joint = e.last.joints.wrenches[crack.joint];
    if (!map.has(e.shell, {joint.block_a, joint.block_b})) continue;
    ++cracks;
    map.add({joint.block_a, joint.block_b}, 1e3 * crack.widest_gap, &joints);
    widest = std::max(widest, crack.widest_gap);
  }
  Figure f;
  f.name = fmt::format("map_cracks{}", shell.suffix());
  f.title = fmt::format("Open joints over the {}", mapped_text(shell));
  f.caption = fmt::format(
      "The joints that are open, at least in part, coloured by their largest gap: {} in all, the widest by "
      "{}.",
      counted(cracks, "joint"), length_text(widest));
  f.width = 1100;
  f.height = 640;
  f.vector = map.is_small();
  if (joints.empty()) return f;
  const JointMap::Rows numbers = numbers_of_cracks(e, &map);
  if (!numbers.empty()) f.caption += " The numbers are those of the widest cracks in cracks.csv.";
  f.commands = plot_style() + map.outlines() + data_block("joints", joints) + data_block("numbers", numbers) +
               map.axes() +
               fmt::format(
                   "set palette defined (0 '#f6b26b', 0.5 '#c0392b', 1 '#4a0d2a')\nset cbrange [0:{}]\n"
                   "set cblabel 'gap (mm)'\nunset key\nplot ",
                   1e3 * widest) +
               outline_plot() + segments(joints, "joints", ":5 with vectors nohead lw 4 lc palette notitle") +
               (numbers.empty() ? "" : ", $numbers using ($1+$3/2):($2+$4/2):5 with labels offset 1,0.5") +
               "\n";
  return f;
}

}  // namespace cupola

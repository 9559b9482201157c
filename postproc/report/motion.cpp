#include "postproc/report/motion.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "assembly/base/counted.hpp"
#include "assembly/model/block_motion.hpp"
#include "postproc/evaluation/quantity_text.hpp"
#include "postproc/report/worst_joints.hpp"

namespace cupola {
namespace {

/// How far each free block is from its place, m, 0 of fixed ones: in a motion its farthest point, as in the
/// summary, of a mechanism its centroid.
std::vector<double> distances_of(const Evaluation& e) {
  const BlockTable& blocks = e.last.frame.blocks;
  if (e.last.frame.role == FrameRole::step)
    return distances_moved(e.assembly, blocks.displacement, blocks.quaternion_wxyz);
  std::vector<double> distances;
  for (size_t b = 0; b < e.assembly.blocks.size(); ++b)
    distances.push_back(e.assembly.blocks[b].fixed ? 0.0 : blocks.displacement[b].norm());
  return distances;
}

/// Blocks that move farther than `least`, m, >= 0.
int count_moving(const Evaluation& e, double least) {
  return static_cast<int>(std::ranges::count_if(distances_of(e), [least](double d) { return d > least; }));
}

/// Bodies of blocks that move farther than `least`, m, >= 0: groups but those of the supports and of blocks
/// that are not laid.
size_t count_bodies(const Evaluation& e, double least) {
  const std::vector<double> distances = distances_of(e);
  std::set<int> bodies;
  for (size_t b = 0; b < e.assembly.blocks.size(); ++b)
    if (distances[b] > least) bodies.insert(e.last.groups[b]);
  for (size_t b = 0; b < e.assembly.blocks.size(); ++b)
    if (e.assembly.blocks[b].fixed) bodies.erase(e.last.groups[b]);
  return bodies.size();
}

struct Farthest {
  size_t block = 0;
  double displacement = 0.0;  // m
};

Farthest farthest_block(const Evaluation& e) {
  const std::vector<double> distances = distances_of(e);
  const auto farthest = std::ranges::max_element(distances);
  return {static_cast<size_t>(farthest - distances.begin()), *farthest};
}

std::string block_text(const Evaluation& e, size_t index) {
  const Block& block = e.assembly.blocks[index];
  if (!block.name.empty()) return fmt::format("block {} ({})", index, block.name);
  return e.rings.empty() ? fmt::format("block {}", index)
                         : fmt::format("block {} in ring {}", index, block.ring);
}

/// Of speeds.
const char* relative_to_ground(const Evaluation& e) {
  return e.scene.supports.base_motion ? ", relative to the ground" : "";
}

/// Of displacements: that of the ground, and what blocks follow of the moves of supports, do not count.
std::string counted_from(const Evaluation& e, const std::string& before) {
  std::vector<std::string> from;
  if (e.scene.supports.base_motion) from.push_back("relative to the ground");
  if (!e.scene.supports.moves.empty()) from.push_back("beyond the moves of supports that it follows");
  return from.empty() ? "" : fmt::format("{}{}", before, fmt::join(from, " and "));
}

/// "50 mm at the end", if that is less than the largest.
std::string end_text(const LargestDisplacement& largest) {
  return largest.at_end ? fmt::format("{} at the end", length_text(*largest.at_end)) : "";
}

void add_numbers_in_time(const Evaluation& e, const std::vector<HistoryRow>& history,
                         std::vector<KeyNumber>* out) {
  const double threshold = e.scene.analysis.thresholds.collapse();
  const LargestDisplacement largest = largest_displacement(e);
  out->push_back({"Largest displacement",
                  length_text(largest.distance),
                  {fmt::format("at {:.4g} s{}", largest.time, counted_from(e, ", "))}});
  if (largest.at_end) out->back().details.push_back(end_text(largest));
  const auto first = std::find_if(history.begin(), history.end(), [threshold](const HistoryRow& row) {
    return row.max_displacement > threshold;
  });
  if (first != history.end())
    out->push_back({fmt::format("Moved more than {}", length_text(threshold)),
                    fmt::format("at {:.4g} s", first->time),
                    {"first block to do so"}});
  if (!history.empty())
    out->push_back({"Fastest point",
                    fmt::format("{:.3g} m/s", history.back().max_speed),
                    {fmt::format("at the end{}", relative_to_ground(e))}});
}

void add_numbers_of_mechanism(const Evaluation& e, std::vector<KeyNumber>* out) {
  constexpr double kSlow = 0.1;  // of the fastest block
  const double least = kSlow * farthest_block(e).displacement;
  out->push_back({"Blocks that begin to move",
                  fmt::format("{} of {}", count_moving(e, least), e.summary.free_blocks),
                  {"faster than a tenth of the fastest",
                   fmt::format("they form {}", counted(count_bodies(e, least), "body", "bodies"))}});
  const std::optional<MovingJoints> joints = moving_joints(e);
  if (!joints) return;
  constexpr double kRounding = 1e-6;
  const auto add = [out](const char* name, double motion) {
    out->push_back({name,
                    fmt::format("{:.3g} %", motion > kRounding ? 100.0 * motion : 0.0),
                    {"of the speed of the fastest block"}});
  };
  add("Fastest sliding of a joint", joints->sliding.motion);
  add("Fastest opening of a joint", joints->opening.motion);
}

void add_motion_in_time(const Evaluation& e, const std::vector<HistoryRow>& history,
                        std::vector<std::string>* out) {
  const double threshold = e.scene.analysis.thresholds.collapse();
  const Farthest farthest = farthest_block(e);
  const size_t bodies = count_bodies(e, 0.0);
  if (const LargestDisplacement largest = largest_displacement(e); largest.at_end)
    out->push_back(fmt::format("The largest displacement of the motion is {:.3g} m{}, at {:.4g} s.",
                               largest.distance, counted_from(e, ", "), largest.time));
  out->push_back(fmt::format(
      "At the end, {:.4g} s, the largest displacement is {:.3g} m{}, of {}; {} of {} are farther than {:g} m "
      "from their places. The blocks move as {}.",
      e.last.frame.time, farthest.displacement, counted_from(e, ", "), block_text(e, farthest.block),
      count_moving(e, threshold), counted(e.summary.free_blocks, "free block"), threshold,
      counted(bodies, "body", "bodies")));
  if (e.lost_joints.value_or(0) > 0)
    out->push_back(fmt::format("{} that carried force at the start separated completely.",
                               counted(*e.lost_joints, "joint")));
  if (!history.empty() && e.summary.weight_N > 0.0)
    out->push_back(fmt::format("The supports carry {:.3g} of the weight at the end.",
                               history.back().reaction / e.summary.weight_N));
}

}  // namespace

LargestDisplacement largest_displacement(const Evaluation& e) {
  const Summary& s = e.summary;
  if (!s.final_displacement_m) return {farthest_block(e).displacement, e.last.frame.time, {}};
  LargestDisplacement largest{*s.max_displacement_m, *s.max_displacement_time_s, {}};
  if (*s.final_displacement_m < largest.distance) largest.at_end = s.final_displacement_m;
  return largest;
}

std::string largest_displacement_text(const Evaluation& e) {
  const LargestDisplacement largest = largest_displacement(e);
  return fmt::format("a block moves by {}{}{}", largest.at_end ? "up to " : "", length_text(largest.distance),
                     counted_from(e, " ")) +
         (largest.at_end ? fmt::format(" (at {:.4g} s; {})", largest.time, end_text(largest)) : "");
}

std::vector<KeyNumber> motion_numbers(const Evaluation& e, const std::vector<HistoryRow>& history) {
  constexpr size_t kMost = 3;
  std::vector<KeyNumber> out;
  const bool unconverged = e.summary.status == Status::unconverged;
  if (unconverged && history.empty()) return out;
  if (!unconverged && is_mechanism(e.last.frame.role))
    add_numbers_of_mechanism(e, &out);
  else if (e.last.frame.role == FrameRole::step)
    add_numbers_in_time(e, history, &out);
  if (out.size() < kMost)
    out.push_back({"Free blocks",
                   fmt::format("{}", e.summary.free_blocks),
                   {fmt::format("in {}", counted(e.summary.joints, "joint"))}});
  if (out.size() < kMost) out.push_back({"Weight", force_text(e.summary.weight_N), {"of the free blocks"}});
  return out;
}

std::vector<std::string> motion_sentences(const Evaluation& e, const std::vector<HistoryRow>& history) {
  std::vector<std::string> out;
  if (e.summary.status == Status::unconverged)
    out.push_back(history.empty()
                      ? "Neither forces nor motion are known: the requested accuracy was not reached."
                      : "The error of the motion is unknown: the requested accuracy was not reached.");
  else if (is_stage(e.last.frame.role))
    out.push_back(
        "The table of stages shows which stages do not stand, the 3-D view how their blocks begin to move.");
  else if (!is_mechanism(e.last.frame.role))
    add_motion_in_time(e, history, &out);
  else if (const Farthest farthest = farthest_block(e); farthest.displacement > 0.0)
    out.push_back(fmt::format(
        "The fastest is {}. A mechanism has directions but no amplitude; the 3-D view shows the directions.",
        block_text(e, farthest.block)));
  return out;
}

std::string how_sure_of_motion(const Evaluation& e) {
  const Summary& s = e.summary;
  const Analysis& analysis = e.scene.analysis;
  if (s.status == Status::unconverged) return "";
  if (s.analysis == AnalysisType::static_) {
    if (proven(s.status))
      return "It is proven that no forces within the limits of the joints balance the loads. The proof "
             "holds for every friction law: they differ only in how joints slide.";
    return analysis.friction_law == FrictionLaw::associated
               ? "A motion was found. That no forces balance the loads is not proven: in joints that jam, "
                 "ties or restraints they might be too large for the accuracy of the solver."
               : "A motion was found, but other contact forces might balance the loads; a range analysis "
                 "(analysis.type: range) shows whether any do.";
  }
  if (is_stage(e.last.frame.role))
    return proven(s.status)
               ? "It is proven of at least one stage that no forces within the limits of the joints balance "
                 "its loads."
               : "Motions were found, but other contact forces might balance the loads of these stages.";
  if (e.last.frame.role != FrameRole::step) return "";
  if (analysis.time_error)
    return fmt::format("The motion was followed with an estimated error of about {} per step.",
                       length_text(*analysis.time_error));
  return fmt::format(
      "Certain: nothing beyond the motion computed. It was followed in steps of {:g} s, and it is not known "
      "how much a shorter step would change it: compare two runs, or set analysis.time_error.",
      s.time_step_s);
}

}  // namespace cupola

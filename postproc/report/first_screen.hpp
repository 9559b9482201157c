#pragma once

#include <string>
#include <vector>

#include "postproc/evaluation/evaluation.hpp"
#include "postproc/figures/figures.hpp"

namespace cupola {

/// A number that a reader looks for first.
struct KeyNumber {
  std::string name;    ///< "Outward thrust"
  std::string value;   ///< with its unit, or a range of values
  std::string detail;  ///< what it means, or between which limits it is certain
};

inline constexpr const char* kLargestPressure = "Largest pressure on a joint";
inline constexpr const char* kLargestFrictionUse = "Largest friction use of a joint";

/// At most three: of a limit analysis the critical value, of a range analysis the ranges, then thrust, thrust line and
/// friction; of a run that is not at rest what moves, how far and when.
std::vector<KeyNumber> key_numbers(const Evaluation& evaluation, const std::vector<HistoryRow>& history);

/// The joint nearest to sliding, and the one whose force is nearest to its edge, as indices into the joints of the frame
/// evaluated. None without loaded joints.
struct WorstJoints {
  std::optional<size_t>
      sliding;  ///< largest friction use; of those that use all of it, the largest normal force
  std::optional<size_t> edge;  ///< least distance of the force from the edge, over the size of the joint
};
WorstJoints worst_joints(const JointWrenches& joints);

/// What answers the first questions, as HTML: warnings, verdict, key numbers, 3-D view, worst joints.
std::string first_screen(const Evaluation& evaluation, const std::vector<HistoryRow>& history,
                         const std::string& viewer);

}  // namespace cupola

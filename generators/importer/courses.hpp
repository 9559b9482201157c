#pragma once

#include <optional>
#include <span>
#include <string>

#include "assembly/model/assembly.hpp"
#include "generators/stereotomy/model_checks.hpp"

namespace cupola {

constexpr int kNoCourse = -1;  ///< of a block whose course the file does not state

/// What was found out about the courses of imported blocks.
struct CourseReport {
  int courses = 0;       ///< 0: none were found
  bool of_file = false;  ///< the file numbers them
  std::string kind;  ///< "rings about a vertical axis", "an arch", "a wall" or "from several springers ..."
  std::string refusal;  ///< why there are none
};

/// Finds the courses of imported blocks from their joints, and labels blocks, parts and faces as those of a
/// generated model, so that ring sums, thrust lines, maps and ranges of the thrust follow.
///
/// The course of a block is its distance from the supports in the graph of joints; of an arch between two
/// supports, from the first. Courses are accepted only if each stone has at most two neighbours in its own,
/// so that the stones form rings or chains, if the lower beds of such neighbours meet end to end within a
/// quarter of the height of the course, and if each stone lies on the course below with one side. Else the
/// assembly remains as it is and the refusal names the stones.
///
/// `numbers` of the file, per block, from either end, replace the distances and the first two rules; each
/// stone must lie on a support or on a stone of a lower course. Throws InputError if only some free blocks
/// have one, and for the axis of an arch.
///
/// `axis` is a point of the vertical axis of a vault (m); none: through the centroid of the faces of the
/// supports. `joints` are those of check_model().
CourseReport set_courses(std::span<const FacePair> joints, std::span<const int> numbers,
                         const std::optional<Vec3>& axis, Assembly* assembly);

}  // namespace cupola

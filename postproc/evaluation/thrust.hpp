#pragma once

#include <optional>
#include <vector>

#include "postproc/evaluation/evaluation.hpp"

namespace cupola {

/// Those of the assembly, without stacks of which no block of the lowest course is at rest: they have fallen,
/// or are not laid. Empty without courses.
std::vector<const Sheet*> pushing_sheets(const Evaluation& evaluation);

/// The lowest course of the stack of a sheet that has stones: cuts may have removed others as a whole.
int lowest_course(const Assembly& assembly, const Sheet& sheet);

/// The cut under that course.
const RingSum& base_of(const Evaluation& evaluation, const Sheet& sheet);

/// The outward thrust of a stack, of an arch at one springing.
struct Thrust {
  double force = 0.0;              ///< N
  std::optional<Vec3> towards;     ///< of an arch: horizontal unit vector outwards at that springing
  std::vector<Reaction> supports;  ///< its part on each, of joints alone; length: NaN of scaled joints
  bool on_blocks = false;          ///< also on blocks of other stacks
  bool held_higher = false;        ///< supports hold courses above the first, of an arch below its last, too
};

/// True for two values that are equal but for a thousandth.
bool alike(double a, double b);

/// Those of the stack of a sheet: one, or both of an arch, the larger first, that at x > 0 in its own frame if
/// they are alike. A half arch has one.
std::vector<Thrust> thrusts_of(const Evaluation& evaluation, const Sheet& sheet);

/// N, the outward thrust of a model: that of the stack that pushes most outwards, or of stones about an axis
/// without courses the sum over the supports. None without either, and where a construction has not laid
/// its lowest course.
std::optional<double> outward_thrust(const Evaluation& evaluation);

/// N, the hoop tension of all courses less their compression where the outward thrust is negative: closed
/// rings that only weigh pull with it over 2 pi. None of a positive thrust, with other loads, ties or
/// strength, where cuts opened the rings, and where supports hold higher courses.
std::optional<double> net_hoop_tension(const Evaluation& evaluation, double thrust);

}  // namespace cupola

#pragma once

#include <map>

#include "postproc/mechanics/joint_speeds.hpp"

namespace cupola {

/// How the joints below and in a course move.
struct CourseMotion {
  double hinging = 0.0, sliding = 0.0, parting = 0.0;  ///< m/s, sums over the joints
  int on = -1;           ///< course below its fastest joint, its own of a head joint; -1: a support
  double fastest = 0.0;  ///< m/s, of that joint

  double sum() const { return hinging + sliding + parting; }
};

/// How a mechanism moves at its joints. A joint slides by the tangential speed of the point where it opens
/// least. It opens by the largest normal speed of its points beyond friction times that: about a hinge if it
/// stays closed somewhere, else its blocks part. Joints slower than 2 % of the fastest block do not count.
struct MechanismMotion {
  GivesWay joints;
  double hinging = 0.0, sliding = 0.0, parting = 0.0;  ///< m/s, sums over the joints
  std::map<int, CourseMotion> by_course;               ///< by the course of the upper block

  double sum() const { return hinging + sliding + parting; }
};

/// `friction`: sliding joints may open by it times their sliding, as the associated law has it.
MechanismMotion mechanism_motion(const Assembly& assembly, const Frame& frame, const JointWrenches& joints,
                                 double friction);

}  // namespace cupola

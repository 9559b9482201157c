#pragma once

#include <map>
#include <utility>
#include <vector>

#include "assembly/model/assembly.hpp"
#include "assembly/model/joint_motion.hpp"
#include "assembly/model/results.hpp"
#include "postproc/mechanics/joint_wrenches.hpp"

namespace cupola {

/// How many joints of a mechanism open about an edge, slide, and part.
struct GivesWay {
  int hinging = 0, sliding = 0, opening = 0;
};

/// How the joints below and in a course move.
struct CourseMotion {
  double hinging = 0.0, sliding = 0.0, parting = 0.0;  ///< sums over the joints
  double height = 0.0;                                 ///< m, mean over the joints, weighted by their motion
  int on = -1;           ///< course below its fastest joint, its own of a head joint; -1: a support
  double fastest = 0.0;  ///< of that joint

  double sum() const { return hinging + sliding + parting; }
};

/// How a mechanism moves at its joints, each with the motion that JointSpeeds gives it: a joint opens by its
/// turning() and slides by its sliding. Speeds are relative to that of the fastest block.
struct MechanismMotion {
  GivesWay joints;
  double hinging = 0.0, sliding = 0.0, parting = 0.0;  ///< sums over the joints
  /// By the course of the upper block; true: at the bed over it, where the last course of an arch springs.
  std::map<std::pair<int, bool>, CourseMotion> by_course;

  double sum() const { return hinging + sliding + parting; }
};

MechanismMotion mechanism_motion(const Assembly& assembly, const Frame& frame, const JointWrenches& joints);

/// Of every joint of a mechanism, with the velocities of the frame, of blocks where its contacts were found.
std::vector<JointSpeeds> joint_speeds(const Assembly& assembly, const Frame& frame,
                                      const JointWrenches& joints);

}  // namespace cupola

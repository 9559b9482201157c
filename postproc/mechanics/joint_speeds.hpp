#pragma once

#include "assembly/model/assembly.hpp"
#include "assembly/model/results.hpp"
#include "postproc/mechanics/joint_wrenches.hpp"

namespace cupola {

/// How fast the two sides of a joint move apart and past each other: the largest values of its points.
struct JointSpeeds {
  double opening = 0.0;  ///< along the normal, m/s, >= 0
  double sliding = 0.0;  ///< in the plane of the joint, m/s
};

/// Of the joint of that number in a mechanism: blocks in place, with the velocities of the frame.
JointSpeeds joint_speeds(const Assembly& assembly, const Frame& frame, const JointWrenches& joints,
                         size_t joint);

/// How many joints of a mechanism open about an edge, slide, and part.
struct GivesWay {
  int hinging = 0, sliding = 0, opening = 0;
};

}  // namespace cupola

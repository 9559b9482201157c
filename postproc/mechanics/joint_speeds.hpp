#pragma once

#include <vector>

#include "assembly/model/assembly.hpp"
#include "assembly/model/joint_motion.hpp"
#include "assembly/model/results.hpp"
#include "postproc/mechanics/joint_wrenches.hpp"

namespace cupola {

/// Of every joint of a mechanism, with the velocities of the frame, of blocks where its contacts were found.
std::vector<JointSpeeds> joint_speeds(const Assembly& assembly, const Frame& frame,
                                      const JointWrenches& joints);

}  // namespace cupola

#pragma once

#include <string>
#include <vector>

#include "assembly/model/joint_motion.hpp"
#include "solver/analysis/record/analysis_sinks.hpp"
#include "solver/dynamics/contact_memory.hpp"
#include "solver/dynamics/equilibrium.hpp"
#include "solver/dynamics/model.hpp"

namespace cupola {

/// Relative motion at a joint of a mechanism.
struct MovingJoint {
  int block_a = 0, block_b = 0;
  JointKind kind = JointKind::other;
  int ring = 0;
  JointSpeeds speeds;
  JointMotion motion() const { return speeds.motion(); }
};

/// Velocity field of a structure without equilibrium, scaled so that the fastest block has speed 1.
struct Mechanism {
  VecX v;                  ///< m/s, rad/s (6 nb)
  std::vector<int> group;  ///< group of each block, which moves as one body; 0: at rest (num_blocks)
  int num_groups = 0;      ///< number of moving groups
  std::vector<MovingJoint> joints;
  /// Kinematic certificate of the associated law: a velocity field that no contact resists (D^T v in Y*) and
  /// on which the loads do positive work proves that there is no equilibrium.
  double load_power = 0.0;  ///< f . v over the sum of |f_block| |v_block|, > 0
  double violation = 0.0;   ///< largest (mu |u_t| - u_n)+ of a contact, relative to the fastest block
};

/// The mechanism with the velocities v (6 nb), of any length. `problem`: the rows of `contacts` come first.
Mechanism find_mechanism(const Model& model, const State& start, const ContactSet& contacts,
                         const ContactProblem& problem, const VecX& v);

/// Writes the mechanism as a frame at 1 s, with its largest speed scaled to 1 m/s, and as two tables.
/// `forces` (N, nc), `violations` (nc) and `owner` are those of the frame.
void write_mechanism(const Model& model, const State& start, const ContactSet& contacts,
                     const ContactMemories& memories, const Mechanism& mechanism, const JointForces& forces,
                     const std::vector<double>& violations, const std::string& owner,
                     const AnalysisSinks& sinks);

/// Tables of the blocks and joints of a mechanism.
std::string mechanism_blocks_csv(const Model& model, const Mechanism& mechanism);
std::string mechanism_joints_csv(const Mechanism& mechanism);

/// One line: the numbers of moving groups and of joints that slide, open and hinge, and the certificate.
std::string describe(const Mechanism& mechanism);

}  // namespace cupola

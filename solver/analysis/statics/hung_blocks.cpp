#include "solver/analysis/statics/hung_blocks.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <Eigen/QR>

#include "assembly/base/disjoint_sets.hpp"

namespace cupola {
namespace {

/// Blocks that press on each other, and the ties that hold them.
struct HungBody {
  std::vector<int> blocks;
  std::vector<size_t> ties;
};

/// The groups of free blocks of which only ties reach to others. Restraints and struts under thrust hold their
/// blocks as joints do.
std::vector<HungBody> hung_bodies(const Model& model, const ContactSet& contacts,
                                  const ContactMemories& memories, const State& state) {
  const std::vector<Block>& blocks = model.assembly->blocks;
  const int ground = static_cast<int>(blocks.size());
  DisjointSets groups(blocks.size() + 1);
  for (int b = 0; b < ground; ++b)
    if (model.free_index[b] == ContactProblem::kFixed) groups.join(b, ground);
  for (size_t i = 0; i < contacts.points.size(); ++i)
    if (!memories.of(i).impulse.isZero(0.0))
      groups.join(contacts.points[i].block_a, contacts.points[i].block_b);
  for (size_t k = 0; k < model.ties.size(); ++k) {
    const Tie& tie = model.ties[k];
    const bool props = tie.strut && tie_gap(model, state, k) < 0.0;
    if (props || tie.is_restraint()) groups.join(tie.block_a, tie.block_b);
  }
  std::map<int, HungBody> found;
  for (const int b : model.free_blocks)
    if (groups.root(b) != groups.root(ground)) found[groups.root(b)].blocks.push_back(b);
  for (size_t k = 0; k < model.ties.size(); ++k) {
    const int a = groups.root(model.ties[k].block_a), b = groups.root(model.ties[k].block_b);
    if (a == b) continue;
    for (const int group : {a, b})
      if (found.contains(group)) found[group].ties.push_back(k);
  }
  std::vector<HungBody> bodies;
  for (auto& [root, body] : found) bodies.push_back(std::move(body));
  return bodies;
}

/// What acts on a body, about the centroid of its first block, and by how much less as the body moves.
struct Pull {
  Vec6 force = Vec6::Zero();      ///< N, N m
  Mat6 stiffness = Mat6::Zero();  ///< of the ties, with that by which they turn
};

void add_tie(const Model& model, size_t k, double yielded, bool holds_b, const State& state,
             const Vec3& origin, Pull* pull) {
  const Tie& tie = model.ties[k];
  const TieGeometry now = tie_geometry(tie, state.poses, state.ground);
  const double elastic = -(tie_gap(model, state, k) + yielded) / tie.compliance;
  if (elastic <= 0.0) return;
  const double tension = std::min(elastic, tie.yield_force);
  const Vec3 force = (holds_b ? tension : -tension) * now.normal;
  const Vec3 arm = (holds_b ? now.point_b : now.point_a) - origin;
  const Mat3 along = now.normal * now.normal.transpose();
  const double stiffness = elastic < tie.yield_force ? 1.0 / tie.compliance : 0.0;
  const double length = (now.point_b - now.point_a).norm();
  const double turning = (tie.strut ? -tension : tension) / length;  // a thrust leans further
  const Mat3 of_end = stiffness * along + turning * (Mat3::Identity() - along);
  pull->force.head<3>() += force;
  pull->force.tail<3>() += arm.cross(force);
  const Mat63 D = Lever{Mat3::Identity(), arm}.matrix();
  pull->stiffness += D * of_end * D.transpose();
  // The arm of the force turns with the body.
  pull->stiffness.bottomRightCorner<3, 3>() += force.dot(arm) * Mat3::Identity() - arm * force.transpose();
}

Pull pull_on(const HungBody& body, const Model& model, const ContactMemories& memories, double time,
             const State& state) {
  const Vec3 origin = state.poses[body.blocks.front()].p_WB;
  const VecX loads = applied_forces(model, state, time);
  Pull pull;
  for (const int b : body.blocks) {
    const auto load = loads.segment<6>(6 * model.free_index[b]);
    pull.force += load;
    pull.force.tail<3>() += (state.poses[b].p_WB - origin).cross(Vec3(load.head<3>()));
  }
  for (const size_t k : body.ties) {
    const bool holds_b = std::ranges::find(body.blocks, model.ties[k].block_b) != body.blocks.end();
    add_tie(model, k, memories.ties[k].yielded, holds_b, state, origin, &pull);
  }
  return pull;
}

/// Moves a body by a displacement and a rotation about the centroid of its first block.
void move_by(const Vec6& step, const HungBody& body, State* state) {
  const Vec3 origin = state->poses[body.blocks.front()].p_WB, turn = step.tail<3>();
  const Eigen::Quaterniond q(Eigen::AngleAxisd(turn.norm(), turn.stableNormalized()));
  for (const int b : body.blocks) {
    Pose& pose = state->poses[b];
    pose.p_WB = origin + step.head<3>() + q * (pose.p_WB - origin);
    pose.q_WB = (q * pose.q_WB).normalized();
  }
}

}  // namespace

bool let_hang(const Model& model, const ContactSet& contacts, const ContactMemories& memories, double time,
              State* state) {
  constexpr int kMostPasses = 50;      // Newton's method needs 3 to 6; bodies hung on bodies more
  constexpr double kRounding = 1e-13;  // of the coordinates
  if (model.ties.empty() || memories.ties.empty()) return false;
  const std::vector<HungBody> bodies = hung_bodies(model, contacts, memories, *state);
  State hung = *state;
  for (int pass = 0; pass < kMostPasses && !bodies.empty(); ++pass) {
    bool at_rest = true;
    for (const HungBody& body : bodies) {
      const Pull pull = pull_on(body, model, memories, time, hung);
      // Of least norm: a tie through the centroid leaves a turn about its axis undetermined.
      Vec6 step = pull.stiffness.completeOrthogonalDecomposition().solve(pull.force);
      if (model.plane) step[1] = step[3] = step[5] = 0.0;
      move_by(step, body, &hung);
      const int first = body.blocks.front();
      const double size = hung.poses[first].p_WB.norm() + std::cbrt(model.assembly->blocks[first].volume);
      at_rest &= step.norm() <= kRounding * size;
    }
    if (!at_rest) continue;
    *state = std::move(hung);
    return true;
  }
  return false;
}

}  // namespace cupola

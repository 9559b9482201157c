#include "solver/analysis/record/mechanism.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/base/disjoint_sets.hpp"
#include "assembly/base/error.hpp"
#include "assembly/files/csv_columns.hpp"
#include "solver/analysis/record/record.hpp"
#include "solver/contact/problem/cone.hpp"

namespace cupola {
namespace {

/// Motion of each joint. The contacts of one joint need not be consecutive in the set.
std::vector<MovingJoint> joint_motions(const ContactSet& contacts, const VecX& u, double fastest) {
  const JointNumbers numbers = number_joints(contacts);
  std::vector<MovingJoint> joints(numbers.count);
  for (size_t i = 0; i < contacts.points.size(); ++i) {
    const Contact& contact = contacts.points[i];
    MovingJoint& joint = joints[numbers.of_contact[i]];
    joint.block_a = contact.block_a;
    joint.block_b = contact.block_b;
    joint.kind = contacts.patches[contact.patch].kind;
    joint.ring = contacts.patches[contact.patch].ring;
    const Vec3 at_point = u.segment<3>(3 * static_cast<Eigen::Index>(i)) / fastest;
    joint.speeds.add(at_point[0], at_point.tail<2>().norm());
  }
  return joints;
}

/// Blocks connected by closed joints form a group. Blocks at rest are group 0; moving groups count from 1.
void find_groups(const Model& model, Mechanism* mechanism) {
  const int num_blocks = static_cast<int>(model.assembly->blocks.size());
  DisjointSets groups(num_blocks);
  for (const MovingJoint& joint : mechanism->joints)
    if (joint.motion() == JointMotion::closed) groups.join(joint.block_a, joint.block_b);
  const auto moves = [&](int block) {
    const int i = model.free_index[block];
    return i != ContactProblem::kFixed && mechanism->v.segment<3>(6 * i).norm() > JointSpeeds::kStopped;
  };
  std::vector<bool> group_moves(num_blocks, false);
  for (int block = 0; block < num_blocks; ++block)
    if (moves(block)) group_moves[groups.root(block)] = true;
  std::vector<int> number(num_blocks, 0);
  mechanism->group.assign(num_blocks, 0);
  for (int block = 0; block < num_blocks; ++block) {
    const int root = groups.root(block);
    if (!group_moves[root]) continue;
    if (number[root] == 0) number[root] = ++mechanism->num_groups;
    mechanism->group[block] = number[root];
  }
}

}  // namespace

Mechanism find_mechanism(const Model& model, const State& start, const ContactSet& contacts,
                         const ContactProblem& problem, const VecX& v) {
  CUPOLA_ASSERT(v.size() == 6 * static_cast<Eigen::Index>(model.num_free()));
  CUPOLA_ASSERT(problem.num_contacts() >= static_cast<int>(contacts.points.size()));
  const double fastest = std::max(largest_speed(v), 1e-300);
  const VecX u = relative_velocity(problem, v);

  Mechanism mechanism;
  mechanism.v = v / fastest;
  mechanism.joints = joint_motions(contacts, u, fastest);
  find_groups(model, &mechanism);

  const VecX f = applied_forces(model, start, start.time);
  double power = 0.0, scale = 0.0;
  for (Eigen::Index i = 0; i < f.size(); i += 6) {
    power += f.segment<6>(i).dot(mechanism.v.segment<6>(i));
    scale += f.segment<3>(i).norm() * mechanism.v.segment<3>(i).norm();
  }
  mechanism.load_power = scale > 0.0 ? power / scale : 0.0;
  for (int i = 0; i < problem.num_contacts(); ++i) {
    if (std::isfinite(contact_law(problem, i).strength.compression))
      continue;  // such a joint may close: it crushes
    mechanism.violation =
        std::max(mechanism.violation, (problem.mu[i] * u.segment<2>(3 * i + 1).norm() - u[3 * i]) / fastest);
  }
  return mechanism;
}

void write_mechanism(const Model& model, const State& start, const ContactSet& contacts,
                     const ContactMemories& memories, const Mechanism& mechanism, const JointForces& forces,
                     const std::vector<double>& violations, const std::string& owner,
                     const AnalysisSinks& sinks) {
  State moving = start;
  moving.v = mechanism.v;
  moving.time = 1.0;
  Frame frame = make_frame(model, moving, contacts, forces, violations, memories,
                           std::vector<Vec3>(moving.poses.size(), Vec3::Zero()));
  set_contact_poses_if_moved(model, start, &frame);
  set_role(FrameRole::mechanism, owner, &frame);
  sinks.frame(frame);
  sinks.table("mechanism_blocks.csv", mechanism_blocks_csv(model, mechanism));
  sinks.table("mechanism_joints.csv", mechanism_joints_csv(mechanism));
}

namespace {

/// The velocity of a free block of a mechanism, the first three m/s, the others rad/s.
struct MovingBlock {
  const Block& block;
  int number, group;
  Eigen::Matrix<double, 6, 1> v;
};

template <int component>
std::string speed(const MovingBlock& moving) {
  return fmt::format("{:.9g}", moving.v[component]);
}

constexpr CsvColumn<MovingBlock> kBlockColumns[] = {
    {"block", [](const MovingBlock& b) { return std::to_string(b.number); }},
    {"ring", [](const MovingBlock& b) { return std::to_string(b.block.ring); }},
    {"slot", [](const MovingBlock& b) { return std::to_string(b.block.slot); }},
    {"group", [](const MovingBlock& b) { return std::to_string(b.group); }},
    {"v_x", speed<0>},
    {"v_y", speed<1>},
    {"v_z", speed<2>},
    {"omega_x", speed<3>},
    {"omega_y", speed<4>},
    {"omega_z", speed<5>},
};

constexpr CsvColumn<MovingJoint> kJointColumns[] = {
    {"block_a", [](const MovingJoint& j) { return std::to_string(j.block_a); }},
    {"block_b", [](const MovingJoint& j) { return std::to_string(j.block_b); }},
    {"kind", [](const MovingJoint& j) { return to_string(j.kind); }},
    {"ring", [](const MovingJoint& j) { return std::to_string(j.ring); }},
    {"motion", [](const MovingJoint& j) { return to_string(j.motion()); }},
    {"opening", [](const MovingJoint& j) { return fmt::format("{:.9g}", j.speeds.opening); }},
    {"sliding", [](const MovingJoint& j) { return fmt::format("{:.9g}", j.speeds.sliding); }},
};

}  // namespace

std::string mechanism_blocks_csv(const Model& model, const Mechanism& mechanism) {
  std::string text = csv_header(kBlockColumns) + "\n";
  for (int i = 0; i < model.num_free(); ++i) {
    const int number = model.free_blocks[i];
    text += csv_row(kBlockColumns, MovingBlock{model.assembly->blocks[number], number,
                                               mechanism.group[number], mechanism.v.segment<6>(6 * i)}) +
            "\n";
  }
  return text;
}

std::string mechanism_joints_csv(const Mechanism& mechanism) {
  std::string text = csv_header(kJointColumns) + "\n";
  for (const MovingJoint& joint : mechanism.joints) text += csv_row(kJointColumns, joint) + "\n";
  return text;
}

std::string describe(const Mechanism& mechanism) {
  const auto count = [&](JointMotion motion) {
    return std::count_if(mechanism.joints.begin(), mechanism.joints.end(),
                         [motion](const MovingJoint& joint) { return joint.motion() == motion; });
  };
  const bool one = mechanism.num_groups == 1;
  return fmt::format(
      "{} of blocks {}; joints that only slide: {}, open: {}, turn about an edge: {}; relative power of the "
      "loads "
      "{:.3g}, largest violation of the friction cones {:.1e}",
      counted(mechanism.num_groups, "group"), one ? "moves" : "move", count(JointMotion::sliding),
      count(JointMotion::opening), count(JointMotion::hinging), mechanism.load_power, mechanism.violation);
}

}  // namespace cupola

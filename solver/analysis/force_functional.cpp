#include "solver/analysis/force_functional.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/model/block_names.hpp"
#include "solver/analysis/base_blocks.hpp"
#include "solver/dynamics/time_step.hpp"

namespace cupola {
namespace {

constexpr const char* kKey = "analysis.range.quantities";

/// Builds the objectives of one quantity after another.
class Objectives {
 public:
  Objectives(const Case& scene, const Model& model, const ContactSet& contacts)
      : model_(model),
        assembly_(*model.assembly),
        contacts_(contacts),
        joints_(scene, *model.assembly, contacts) {}

  std::vector<RangeObjective> operator()(const BaseThrust&) const;
  std::vector<RangeObjective> operator()(const BlockReaction& reaction) const;
  std::vector<RangeObjective> operator()(const JointForce& joint) const;
  std::vector<RangeObjective> operator()(const HoopForce& hoop) const;
  std::vector<RangeObjective> operator()(const BaseShare& share) const;
  std::vector<RangeObjective> operator()(const BaseRatio& ratio) const;
  std::vector<RangeObjective> operator()(const TieForce& tie) const;
  std::vector<RangeObjective> operator()(const AllJoints& all) const;

 private:
  bool fixed(int block) const { return assembly_.blocks[block].fixed; }
  std::string label(int block) const { return block_label(assembly_, block); }
  std::set<int> base_blocks() const { return blocks_on_supports(assembly_, joints_); }
  std::set<int> base_blocks(const BaseBlocks& group) const {
    return blocks_on_supports(assembly_, joints_, group);
  }
  ForceFunctional none() const;
  /// Adds direction . (force of the pair on `block`).
  void add(const BlockPair& pair, int block, const Vec3& direction, ForceFunctional* f) const;
  /// Force of the blocks on their supports along a direction that depends on the joint.
  template <class Direction>
  ForceFunctional on_supports(const std::set<int>& blocks, const Direction& direction) const;
  ForceFunctional weight_of(const std::set<int>& blocks, double factor) const;
  RangeObjective normal_force(int block_a, int block_b) const;
  /// Part of the direction in the plane of the joint, unit.
  Vec3 in_plane(const JointForce& joint, const BlockPair& pair) const;

  const Model& model_;
  const Assembly& assembly_;
  const ContactSet& contacts_;
  JointGeometry joints_;
};

/// A group of base blocks in words.
std::string name_of(const BaseBlocks& blocks) {
  switch (blocks.group) {
    case BaseBlocks::Group::mid_sails:
      return "mid-sails";
    case BaseBlocks::Group::listed:
      return "listed blocks";
    case BaseBlocks::Group::herringbone:
      return "herringbone blocks";
    case BaseBlocks::Group::ribs:
      break;
  }
  return "ribs";
}

const Vec3 kDown = -Vec3::UnitZ();

ForceFunctional Objectives::none() const {
  return {std::vector<Vec3>(contacts_.points.size(), Vec3::Zero()), std::vector<double>(model_.ties.size()),
          0.0};
}

void Objectives::add(const BlockPair& pair, int block, const Vec3& direction, ForceFunctional* f) const {
  for (const int i : pair.contacts)
    f->contacts[i] += contacts_.points[i].block_b == block ? direction : Vec3(-direction);
}

template <class Direction>
ForceFunctional Objectives::on_supports(const std::set<int>& blocks, const Direction& direction) const {
  ForceFunctional f = none();
  for (const auto& [key, pair] : joints_.pairs()) {
    const auto [a, b] = key;
    if (fixed(a) == fixed(b)) continue;
    if (blocks.contains(a) || blocks.contains(b)) add(pair, fixed(a) ? a : b, direction(pair.centroid), &f);
  }
  return f;
}

ForceFunctional Objectives::weight_of(const std::set<int>& blocks, double factor) const {
  return on_supports(blocks, [factor](const Vec3&) { return Vec3(factor * kDown); });
}

std::vector<RangeObjective> Objectives::operator()(const BaseThrust&) const {
  const auto direction = [this](const Vec3& point) -> Vec3 {
    const Vec3 outward = joints_.outward(point);
    return joints_.is_arch() && outward.x() < 0.0 ? Vec3::Zero() : outward;  // one springing
  };
  return {{"thrust", "N", on_supports(base_blocks(), direction), {}}};
}

std::vector<RangeObjective> Objectives::operator()(const BlockReaction& reaction) const {
  check_block(assembly_, reaction.block);
  const bool vertical = reaction.component == BlockReaction::Component::vertical;
  const auto direction = [&](const Vec3& point) {
    if (reaction.direction) return *reaction.direction;
    return vertical ? kDown : joints_.outward(point);
  };
  if (!fixed(reaction.block)) base_blocks({BaseBlocks::Group::listed, {reaction.block}});
  const std::string name =
      reaction.direction
          ? fmt::format("reaction of block {} along ({:g}, {:g}, {:g})", label(reaction.block),
                        reaction.direction->x(), reaction.direction->y(), reaction.direction->z())
          : fmt::format("{} reaction of block {}", to_string(reaction.component), label(reaction.block));
  return {{name, "N", on_supports({reaction.block}, direction), {}}};
}

Vec3 Objectives::in_plane(const JointForce& joint, const BlockPair& pair) const {
  constexpr double kNormal = 1e-6;  // sine of the angle to the normal from which a direction lies along it
  const Vec3 given = joint.direction ? joint.direction->normalized() : joints_.outward(pair.centroid);
  const Vec3 d = given - pair.normal * pair.normal.dot(given);
  if (d.norm() <= kNormal)
    throw InputError(fmt::format("{}: the direction is normal to joint {}-{}; give one in its plane", kKey,
                                 label(joint.block_a), label(joint.block_b)));
  return d.normalized();
}

RangeObjective Objectives::normal_force(int block_a, int block_b) const {
  ForceFunctional f = none();
  for (const int i : joints_.pair(block_a, block_b).contacts)
    f.contacts[i] = contacts_.points[i].normal;  // compression positive
  return {fmt::format("normal force of joint {}-{}", label(block_a), label(block_b)), "N", f, {}};
}

std::vector<RangeObjective> Objectives::operator()(const JointForce& joint) const {
  using enum JointForce::Component;
  check_block(assembly_, joint.block_a);
  check_block(assembly_, joint.block_b);
  const BlockPair& pair = joints_.pair(joint.block_a, joint.block_b);
  const RangeObjective pressure = normal_force(joint.block_a, joint.block_b);
  if (joint.component == normal) return {pressure};
  const std::string name = fmt::format("{} of joint {}-{}", to_string(joint.component), label(joint.block_a),
                                       label(joint.block_b));
  if (joint.component == eccentricity) {
    const Vec3 d = in_plane(joint, pair);
    ForceFunctional moment = pressure.value;
    for (const int i : pair.contacts)
      moment.contacts[i] *= d.dot(contacts_.points[i].point_a - pair.centroid);
    return {{name, "m", moment, pressure.value}};
  }
  const Vec3 direction = joint.component == shear ? in_plane(joint, pair)
                         : joint.direction        ? *joint.direction
                                                  : joints_.outward(pair.centroid);
  ForceFunctional force = none();
  add(pair, joint.block_b, direction, &force);
  return {{name, "N", force, {}}};
}

std::vector<RangeObjective> Objectives::operator()(const HoopForce& hoop) const {
  const auto in_ring = [&](int block) { return !fixed(block) && assembly_.blocks[block].ring == hoop.ring; };
  if (hoop.ring >= assembly_.num_rings)
    throw InputError(fmt::format("{}: ring {} does not exist: the model has rings 0 to {}", kKey, hoop.ring,
                                 assembly_.num_rings - 1));
  constexpr double kMean = -0.5 / std::numbers::pi;
  ForceFunctional f = none();
  for (const auto& [key, pair] : joints_.pairs()) {
    const auto [a, b] = key;
    if (in_ring(a) == in_ring(b)) continue;
    for (const int i : pair.contacts) {
      const Contact& contact = contacts_.points[i];
      const Vec3 direction = kMean * joints_.outward(contact.point_a);
      f.contacts[i] = in_ring(contact.block_b) ? direction : Vec3(-direction);
    }
  }
  const State rest = state_at_rest(model_);
  const VecX loads = applied_forces(model_, rest, rest.time);
  for (size_t k = 0; k < model_.free_blocks.size(); ++k) {
    const int block = model_.free_blocks[k];
    const Vec3 force = loads.segment<3>(6 * static_cast<Eigen::Index>(k));
    if (in_ring(block)) f.constant += kMean * joints_.outward(assembly_.blocks[block].centroid).dot(force);
  }
  return {{fmt::format("hoop force of ring {}", hoop.ring), "N", f, {}}};
}

std::vector<RangeObjective> Objectives::operator()(const BaseShare& share) const {
  const std::set<int> blocks = base_blocks(share.of);
  RangeObjective objective{fmt::format("share of the {}", name_of(share.of)), "", weight_of(blocks, 1.0),
                           weight_of(base_blocks(), 1.0)};
  return {objective};
}

std::vector<RangeObjective> Objectives::operator()(const BaseRatio& ratio) const {
  const auto mean = [this](const BaseBlocks& group) {
    const std::set<int> blocks = base_blocks(group);
    return weight_of(blocks, 1.0 / static_cast<double>(blocks.size()));
  };
  return {{fmt::format("ratio of the {} to the {}", name_of(ratio.of), name_of(ratio.over)), "",
           mean(ratio.of), mean(ratio.over)}};
}

std::vector<RangeObjective> Objectives::operator()(const TieForce& tie) const {
  const int count = static_cast<int>(model_.ties.size());
  if (tie.tie >= count)
    throw InputError(count == 0 ? fmt::format("{}: the model has no ties", kKey)
                                : fmt::format("{}: tie {} does not exist: the model has ties 0 to {}", kKey,
                                              tie.tie, count - 1));
  ForceFunctional f = none();
  f.ties[tie.tie] = 1.0;
  return {{fmt::format("force of tie {}", tie.tie), "N", f, {}}};
}

std::vector<RangeObjective> Objectives::operator()(const AllJoints& all) const {
  const double sector = 2.0 * std::numbers::pi / all.sectors;
  std::vector<RangeObjective> objectives;
  for (const auto& [key, pair] : joints_.pairs()) {
    const double azimuth = std::atan2(pair.centroid.y(), pair.centroid.x());
    if (azimuth + (azimuth < 0.0 ? 2.0 * std::numbers::pi : 0.0) < sector)
      objectives.push_back(normal_force(key.first, key.second));
  }
  return objectives;
}

}  // namespace

double ForceFunctional::operator()(const JointForces& forces) const {
  double value = constant;
  for (size_t i = 0; i < contacts.size(); ++i) value += contacts[i].dot(forces.contacts[i]);
  for (size_t i = 0; i < ties.size(); ++i) value += ties[i] * forces.ties[i];
  return value;
}

VecX ForceFunctional::coefficients(const ContactSet& set) const {
  const auto nc = static_cast<Eigen::Index>(contacts.size());
  VecX c = VecX::Zero(3 * (nc + static_cast<Eigen::Index>(ties.size())));
  for (Eigen::Index i = 0; i < nc; ++i)
    c.segment<3>(3 * i) = contact_frame(set.points[i].normal).transpose() * contacts[i];
  for (size_t i = 0; i < ties.size(); ++i) c[3 * (nc + static_cast<Eigen::Index>(i))] = ties[i];
  return c;
}

double RangeObjective::operator()(const JointForces& forces) const {
  return over ? value(forces) / (*over)(forces) : value(forces);
}

std::vector<RangeObjective> range_objectives(const ForceQuantity& quantity, const Case& scene,
                                             const Model& model, const ContactSet& contacts) {
  return std::visit(Objectives(scene, model, contacts), quantity);
}

}  // namespace cupola

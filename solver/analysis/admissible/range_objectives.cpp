#include "solver/analysis/admissible/range_objectives.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "solver/analysis/admissible/base_blocks.hpp"

namespace cupola {
namespace {

constexpr const char* kSupportsKey = "analysis.range.quantities";

/// Builds the objectives of a quantity.
class Objectives {
 public:
  explicit Objectives(const ForceScene& scene) : scene_(scene) {}

  std::vector<RangeObjective> operator()(const BaseThrust&) const;
  std::vector<RangeObjective> operator()(const BlockReaction& reaction) const;
  std::vector<RangeObjective> operator()(const JointForce& joint) const {
    return {objective_of(joint, scene_)};
  }
  std::vector<RangeObjective> operator()(const HoopForce& hoop) const { return {objective_of(hoop, scene_)}; }
  std::vector<RangeObjective> operator()(const BaseShare& share) const;
  std::vector<RangeObjective> operator()(const BaseRatio& ratio) const;
  std::vector<RangeObjective> operator()(const TieForce& tie) const;
  std::vector<RangeObjective> operator()(const RestraintForce& restraint) const;
  std::vector<RangeObjective> operator()(const AllJoints& all) const { return objectives_of(all, scene_); }

 private:
  std::set<int> base_blocks() const { return blocks_on_supports(scene_.assembly, scene_.joints); }
  std::set<int> base_blocks(const BaseBlocks& group) const {
    return blocks_on_supports(scene_.assembly, scene_.joints, group);
  }
  /// Force of the blocks on their supports along a direction that depends on the joint.
  template <class Direction>
  ForceFunctional on_supports(const std::set<int>& blocks, const Direction& direction) const;
  /// Adds the forces along `direction` on supports of ties that lead from them to free blocks, at either end
  /// of which is `block`. Restraints are forces of the ground.
  void add_anchored(int block, const Vec3& direction, ForceFunctional* f) const;
  /// N, of the stack of a sheet, of an arch at the springing towards +x.
  ForceFunctional thrust_of(const Sheet& sheet) const;
  ForceFunctional weight_of(const std::set<int>& blocks, double factor) const;
  /// Ties without those of the restraints, which follow them: a tie and a strut each.
  int num_ties() const { return static_cast<int>(scene_.model.ties.size()) - 2 * num_restraints(); }
  int num_restraints() const { return static_cast<int>(scene_.scene.supports.restraints.size()); }
  /// `sign` times the force of a bar that pulls and pushes, tension positive. That of its tie or strut alone
  /// has no limit, because they press against each other.
  ForceFunctional bar(int strut, double sign) const;

  const ForceScene& scene_;
};

/// A group of base blocks in words, which no other group of the model has.
std::string name_of(const BaseBlocks& group, const std::set<int>& blocks) {
  switch (group.group) {
    case BaseBlocks::Group::mid_sails:
      return "the mid-sails";
    case BaseBlocks::Group::listed:
      return fmt::format("{} {}", blocks.size() == 1 ? "block" : "blocks", fmt::join(blocks, ", "));
    case BaseBlocks::Group::herringbone:
      return "the herringbone blocks";
    case BaseBlocks::Group::ribs:
      break;
  }
  return "the ribs";
}

void require_exists(const char* what, const char* plural, int number, int count) {
  if (number < count) return;
  throw InputError(count == 0 ? fmt::format("{}: the model has no {}", kSupportsKey, plural)
                              : fmt::format("{}: {} {} does not exist: the model has {} 0 to {}",
                                            kSupportsKey, what, number, plural, count - 1));
}

const Vec3 kDown = -Vec3::UnitZ();

template <class Direction>
ForceFunctional Objectives::on_supports(const std::set<int>& blocks, const Direction& direction) const {
  ForceFunctional f = scene_.zero();
  for (const auto& [key, pair] : scene_.joints.pairs()) {
    const auto [a, b] = key;
    if (scene_.fixed(a) == scene_.fixed(b)) continue;
    const auto [support, block] = scene_.fixed(a) ? std::pair(a, b) : std::pair(b, a);
    if (blocks.contains(support) || blocks.contains(block))
      scene_.add(pair, support, direction(pair.centroid, block), &f);
  }
  return f;
}

void Objectives::add_anchored(int block, const Vec3& direction, ForceFunctional* f) const {
  const State rest = state_at_rest(scene_.model);
  for (size_t k = 0; k < scene_.model.ties.size(); ++k) {
    const Tie& tie = scene_.model.ties[k];
    if (tie.is_restraint() || scene_.fixed(tie.block_a) == scene_.fixed(tie.block_b)) continue;
    if (tie.block_a != block && tie.block_b != block) continue;
    const double on_b = direction.dot(tie_geometry(tie, rest.poses, rest.ground).normal);
    f->ties[k] += scene_.fixed(tie.block_b) ? on_b : -on_b;
  }
}

ForceFunctional Objectives::weight_of(const std::set<int>& blocks, double factor) const {
  return on_supports(blocks, [factor](const Vec3&, int) { return Vec3(factor * kDown); });
}

ForceFunctional Objectives::bar(int strut, double sign) const {
  ForceFunctional f = scene_.zero();
  f.ties[strut - 1] = sign;
  f.ties[strut] = -sign;
  return f;
}

ForceFunctional Objectives::thrust_of(const Sheet& sheet) const {
  const ThrustJoints& thrust = scene_.joints.thrust();
  ForceFunctional f = scene_.zero();
  for (const auto& [key, pair] : scene_.joints.pairs()) {
    const JointKind kind = scene_.contacts.patches[scene_.contacts.points[pair.contacts.front()].patch].kind;
    const int bearer = thrust.bearer(sheet, {key.first, key.second, kind, 0}, pair.centroid, pair.normal);
    if (bearer < 0 || thrust.is_at_far_side(sheet, pair.centroid)) continue;
    const int pushing = bearer == key.first ? key.second : key.first;
    scene_.add(pair, bearer, scene_.joints.outward_on_support(pair.centroid, pushing), &f);
  }
  return f;
}

/// Of each stack that has an axis, on its supports and on what carries it, the last first.
std::vector<RangeObjective> Objectives::operator()(const BaseThrust&) const {
  const std::vector<const Sheet*> pushing = pushing_sheets(scene_.assembly);
  if (pushing.empty()) return {{"thrust", "N", thrust_of({}), {}, {}}};  // which refuses it
  std::vector<RangeObjective> objectives;
  for (const Sheet* sheet : pushing)
    objectives.push_back(
        {pushing.size() == 1 ? "thrust" : "thrust of " + sheet->name, "N", thrust_of(*sheet), {}, {}});
  return objectives;
}

std::vector<RangeObjective> Objectives::operator()(const BlockReaction& reaction) const {
  check_block(scene_.assembly, reaction.block);
  const bool vertical = reaction.component == BlockReaction::Component::vertical;
  const Vec3 unit = reaction.direction ? reaction.direction->normalized() : kDown;
  const bool outward = !reaction.direction && !vertical;
  const auto direction = [&](const Vec3& point, int block) {
    return outward ? scene_.joints.outward_on_support(point, block) : unit;
  };
  if (!scene_.fixed(reaction.block)) base_blocks({BaseBlocks::Group::listed, {reaction.block}});
  ForceFunctional f = on_supports({reaction.block}, direction);
  // Outward counts joints alone, as reactions.csv does.
  if (!outward) add_anchored(reaction.block, unit, &f);
  const std::string name = fmt::format(
      "{}reaction of block {}{}", reaction.direction ? "" : fmt::format("{} ", to_string(reaction.component)),
      scene_.label(reaction.block), along_text(reaction.direction));
  return {{name, "N", std::move(f), {}}};
}

std::vector<RangeObjective> Objectives::operator()(const BaseShare& share) const {
  const std::set<int> blocks = base_blocks(share.of);
  RangeObjective objective{fmt::format("share of {}", name_of(share.of, blocks)), "", weight_of(blocks, 1.0),
                           weight_of(base_blocks(), 1.0)};
  return {objective};
}

std::vector<RangeObjective> Objectives::operator()(const BaseRatio& ratio) const {
  const std::set<int> of = base_blocks(ratio.of), over = base_blocks(ratio.over);
  const auto mean = [this](const std::set<int>& blocks) {
    return weight_of(blocks, 1.0 / static_cast<double>(blocks.size()));
  };
  return {{fmt::format("ratio of {} to {}", name_of(ratio.of, of), name_of(ratio.over, over)), "", mean(of),
           mean(over)}};
}

std::vector<RangeObjective> Objectives::operator()(const TieForce& tie) const {
  require_exists("tie", "ties", tie.tie, num_ties());
  const int strut = strut_of(scene_.model.ties, tie.tie);
  if (strut >= 0) return {{fmt::format("force of rod {}-{}", strut - 1, strut), "N", bar(strut, 1.0), {}}};
  ForceFunctional f = scene_.zero();
  f.ties[tie.tie] = 1.0;
  return {{fmt::format("force of tie {}", tie.tie), "N", f, {}}};
}

std::vector<RangeObjective> Objectives::operator()(const RestraintForce& restraint) const {
  require_exists("restraint", "restraints", restraint.restraint, num_restraints());
  const int strut = num_ties() + 2 * restraint.restraint + 1;
  return {{fmt::format("force of restraint {}", restraint.restraint), "N", bar(strut, -1.0), {}}};
}

}  // namespace

std::string along_text(const std::optional<Vec3>& direction) {
  if (!direction) return "";
  return fmt::format(" along ({:g}, {:g}, {:g})", direction->x(), direction->y(), direction->z());
}

std::vector<RangeObjective> range_objectives(const ForceQuantity& quantity, const Case& scene,
                                             const Model& model, const ContactSet& contacts) {
  const ForceScene forces(scene, model, contacts);
  return std::visit(Objectives(forces), quantity);
}

}  // namespace cupola

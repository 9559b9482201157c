#include "solver/dynamics/ties.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/model/block_names.hpp"

namespace cupola {
namespace {

/// The tie between two points of the assembly as generated. Its force is zero at `tie.length`.
Tie make_tie(const Assembly& assembly, BuiltTie tie, const std::string& key) {
  check_block_exists(assembly, tie.block_a, key);
  check_block_exists(assembly, tie.block_b, key);
  if (tie.block_a == tie.block_b)
    throw InputError(
        fmt::format("{}: both ends are on block {}; a tie connects two blocks", key, tie.block_a));
  if (assembly.blocks[tie.block_a].fixed && assembly.blocks[tie.block_b].fixed)
    throw InputError(fmt::format("{}: blocks {} and {} are fixed; a tie holds a free block", key, tie.block_a,
                                 tie.block_b));
  if (tie.point_a == tie.point_b)
    throw InputError(fmt::format("{}: the ends on blocks {} and {} coincide", key, tie.block_a, tie.block_b));
  if (tie.block_a > tie.block_b) {
    std::swap(tie.block_a, tie.block_b);
    std::swap(tie.point_a, tie.point_b);
  }
  return {tie.block_a,
          tie.block_b,
          tie.point_a - assembly.blocks[tie.block_a].centroid,
          tie.point_b - assembly.blocks[tie.block_b].centroid,
          tie.length,
          1.0 / tie.stiffness,
          false,
          tie.yield_force,
          tie.chain,
          Vec3::Zero(),
          Vec3::Zero()};
}

/// A tie that carries `prestress` as generated: its natural length is shorter by prestress / stiffness, or
/// longer by `slack`.
Tie pair_tie(const Assembly& assembly, const PairTie& pair, const std::string& key) {
  check_block_exists(assembly, pair.block_a, key + ".block_a");
  check_block_exists(assembly, pair.block_b, key + ".block_b");
  BuiltTie tie;
  tie.block_a = pair.block_a;
  tie.block_b = pair.block_b;
  tie.point_a = pair.point_a.value_or(assembly.blocks[pair.block_a].centroid);
  tie.point_b = pair.point_b.value_or(assembly.blocks[pair.block_b].centroid);
  tie.stiffness = pair.stiffness;
  tie.length = (tie.point_b - tie.point_a).norm() + pair.slack - pair.prestress / pair.stiffness;
  tie.yield_force = pair.yield_force.value_or(tie.yield_force);
  const Tie made = make_tie(assembly, tie, key);
  if (!(tie.length > 0.0))
    throw InputError(
        fmt::format("{}: the prestress {} N elongates the tie by more than its length; reduce it or "
                    "increase the stiffness",
                    key, pair.prestress));
  return made;
}

/// The bar of a restraint: from the ground, at the distance of a block, to the held point.
Tie restraint_bar(const Assembly& assembly, const Restraint& restraint, const std::string& key) {
  check_block_exists(assembly, restraint.block, key + ".block");
  const Block& block = assembly.blocks[restraint.block];
  if (block.fixed)
    throw InputError(fmt::format("{}.block: block {} is fixed already; remove this restraint", key,
                                 block_label(assembly, restraint.block)));
  const auto ground = std::ranges::find_if(assembly.blocks, &Block::fixed);
  if (ground == assembly.blocks.end())
    throw InputError(fmt::format("{}: no block is fixed, against which a point could be held", key));
  const Vec3 direction = restraint.direction.normalized();
  const Vec3 held = restraint.point.value_or(block.centroid);
  Tie bar;
  bar.block_a = static_cast<int>(ground - assembly.blocks.begin());
  bar.block_b = restraint.block;
  bar.natural_length = std::cbrt(block.volume);
  bar.ground = held - bar.natural_length * direction;
  bar.p_AP_A = bar.ground - ground->centroid;
  bar.p_BP_B = held - block.centroid;
  bar.compliance = 1.0 / restraint.stiffness;
  bar.direction = direction;
  return bar;
}

/// Adds a bar that carries tension and compression.
void add_both_signs(const Tie& tie, std::vector<Tie>* ties) {
  ties->push_back(tie);
  ties->push_back(tie);
  ties->back().strut = true;
  ties->back().yield_force = std::numeric_limits<double>::infinity();
}

}  // namespace

TieGeometry tie_geometry(const Tie& tie, const std::vector<Pose>& poses, const Vec3& ground) {
  const bool turns = !tie.is_restraint();
  const Pose a = turns ? poses[tie.block_a] : Pose{tie.ground + ground, Eigen::Quaterniond::Identity()};
  const Pose& b = poses[tie.block_b];
  const Vec3 r_a = turns ? Vec3(a.q_WB * tie.p_AP_A) : Vec3::Zero();
  const Vec3 r_b = b.q_WB * tie.p_BP_B;
  const Vec3 along = (b.p_WB - a.p_WB) + (r_b - r_a);
  const double length = turns ? along.norm() : tie.direction.dot(along);
  TieGeometry geometry;
  geometry.point_b = b.p_WB + r_b;
  // What a restraint holds slides across its direction, and the line of its force goes with it.
  geometry.point_a = turns ? Vec3(a.p_WB + r_a) : Vec3(geometry.point_b - tie.natural_length * tie.direction);
  const double sign = tie.strut ? 1.0 : -1.0;
  if (!turns)
    geometry.normal = sign * tie.direction;
  else if (length > 0.0)
    geometry.normal = sign / length * along;
  geometry.gap = sign * (length - tie.natural_length);
  CUPOLA_ASSERT(std::abs(geometry.normal.squaredNorm() - 1.0) < 1e-9);
  return geometry;
}

Contact as_contact(const Tie& tie, const TieGeometry& now) {
  Contact contact;
  contact.block_a = tie.is_restraint() ? -1 : tie.block_a;
  contact.block_b = tie.block_b;
  contact.point_a = now.point_a;
  contact.point_b = now.point_b;
  contact.normal = now.normal;
  contact.gap = now.gap;
  return contact;
}

std::vector<Tie> make_ties(const Case& scene, const Assembly& assembly) {
  std::vector<Tie> ties;
  for (size_t i = 0; i < scene.ties.pairs.size(); ++i)
    ties.push_back(pair_tie(assembly, scene.ties.pairs[i], fmt::format("ties.pairs[{}]", i)));
  for (BuiltTie built : assembly.ties) {
    if (std::isinf(built.stiffness)) built.stiffness = scene.ties.rod_stiffness;
    const Tie tie = make_tie(assembly, built, "tie of the assembly");
    if (built.pushes)
      add_both_signs(tie, &ties);
    else
      ties.push_back(tie);
  }
  const std::vector<Restraint>& restraints = scene.supports.restraints;
  for (size_t i = 0; i < restraints.size(); ++i)
    add_both_signs(restraint_bar(assembly, restraints[i], fmt::format("supports.restraints[{}]", i)), &ties);
  return ties;
}

int strut_of(const std::vector<Tie>& ties, int k) {
  if (ties[k].strut) return k;
  return k + 1 < std::ssize(ties) && ties[k + 1].strut ? k + 1 : -1;
}

void remove_self_stress(const std::vector<Tie>& ties, std::vector<double>* forces) {
  for (size_t k = 1; k < ties.size(); ++k) {
    if (!ties[k].strut) continue;
    const double common = std::min((*forces)[k - 1], (*forces)[k]);
    (*forces)[k - 1] -= common;
    (*forces)[k] -= common;
  }
}

}  // namespace cupola

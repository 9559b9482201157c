#include "postproc/mechanics/joint_wrenches.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

#include <Eigen/Geometry>

#include "assembly/base/error.hpp"
#include "postproc/mechanics/ring_sums.hpp"

namespace cupola {
namespace {

/// False where a support stands beside a block, whose beds, or without any the course, face elsewhere.
bool is_on_bed(const Shell& shell, const Block& block, int number, const Vec3& normal) {
  constexpr double kFacing = 0.5;  // cosine; in a flat dome a third of a ring and one of its ends have 0.64
  bool has_bed = false;
  for (const int bed : {block.ring, shell.bed_above(block.ring + block.num_rings - 1)}) {
    if (bed < 0 || bed >= static_cast<int>(shell.blocks.size())) continue;
    const auto own = std::ranges::lower_bound(shell.blocks[bed], number, {}, &BlockBed::block);
    if (own == shell.blocks[bed].end() || own->block != number) continue;
    if (std::abs(normal.dot(own->plane.normal)) >= kFacing) return true;
    has_bed = true;
  }
  return !has_bed && std::abs(normal.dot(shell.direction(block.ring))) >= kFacing;
}

/// Cosine of the normal of a joint with the direction from ring to ring; 0 where it is upright or of a support
/// beside a block. Supports belong to no ring: their neighbour decides.
double facing(const Assembly& assembly, const Shell& shell, const JointWrench& joint) {
  constexpr double kUpright = 1e-9;  // rounding of a model 1 km from the origin
  const Vec3& normal = joint.patch.plane.normal;
  int ring = joint.ring;
  if (joint.kind == JointKind::base) {
    const int number = assembly.blocks[joint.block_a].fixed ? joint.block_b : joint.block_a;
    if (!is_on_bed(shell, assembly.blocks[number], number, normal)) return 0.0;
    ring = assembly.blocks[number].ring;
  }
  const double cosine = normal.dot(shell.direction(ring));
  return std::abs(cosine) > kUpright ? cosine : 0.0;
}

/// True where the lower block is of the last course of an arch that springs from the sheet of the upper one.
bool stands_on_other_sheet(const Assembly& assembly, const JointWrench& joint) {
  const Block &lower = assembly.blocks[joint.lower], &upper = assembly.blocks[joint.upper];
  return !upper.fixed && upper.ring < lower.ring &&
         assembly.sheet_of(upper.ring) != assembly.sheet_of(lower.ring);
}

/// Sets which block of a bed or base joint lies further along the shell: between two courses of a sheet that
/// of the higher number, else the one to which the normal points, of an upright bed joint the higher course.
/// Stones of one course lean on each other and on a support beside them, and none is carried.
void find_upper(const Assembly& assembly, const Shell& shell, JointWrench* joint) {
  const Block &a = assembly.blocks[joint->block_a], &b = assembly.blocks[joint->block_b];
  double towards_b = facing(assembly, shell, *joint);
  const bool apart = a.ring + a.num_rings <= b.ring || b.ring + b.num_rings <= a.ring;
  const bool numbered = apart && assembly.sheet_of(a.ring) == assembly.sheet_of(b.ring);
  if (joint->kind == JointKind::bed && (numbered || towards_b == 0.0)) towards_b = b.ring - a.ring;
  if (towards_b == 0.0) return;
  joint->upper = towards_b > 0.0 ? joint->block_b : joint->block_a;
  joint->lower = towards_b > 0.0 ? joint->block_a : joint->block_b;
  joint->carried = stands_on_other_sheet(assembly, *joint) ? -1 : joint->upper;
}

/// Tangential part of the force of a joint over the largest possible one. That of a point in a dry joint
/// follows from its own use; of points without shear it is taken in proportion to normal force.
double friction_use(const ContactTable& contacts, std::vector<int>::const_iterator begin,
                    std::vector<int>::const_iterator end) {
  constexpr double kNoShear = 1e-6;  // of a point's limit, which then has no digits left
  Vec3 shear = Vec3::Zero();
  const bool dry = contacts.friction_limit.empty();
  double limit = 0.0, known = 0.0, pressed = 0.0;
  for (auto row = begin; row != end; ++row) {
    const double n = contacts.normal_force[*row], use = contacts.friction_use[*row];
    const Vec3 t = contacts.force[*row] - n * contacts.normal[*row];
    shear += t;
    pressed += n;
    if (!dry) limit += contacts.friction_limit[*row];
    if (!dry || !(use > kNoShear)) continue;
    limit += t.norm() / use;
    known += n;
  }
  if (known > 0.0) limit *= pressed / known;
  return limit > 0.0 ? shear.norm() / limit : 0.0;
}

/// Share of the area of the joint whose points carry no normal force.
double open_share(const ContactTable& contacts, const std::vector<int>& rows, const Floor& floor,
                  const JointWrench& joint) {
  constexpr double kNoPressure = 1e-9;  // of the force; rounding beside the shear of a cohesive joint
  double open_area = 0.0;
  for (int i = joint.contact_start; i < joint.contact_start + joint.num_contacts; ++i) {
    const int row = rows[i];
    if (std::abs(contacts.normal_force[row]) <=
        std::max(floor.force, kNoPressure * contacts.force[row].norm()))
      open_area += contacts.area[row];
  }
  return joint.area > 0.0 ? open_area / joint.area : 0.0;
}

/// Sums the forces of the joint over its contact points, `rows` of the contacts, about the patch centroid.
void fill(const ContactTable& contacts, const std::vector<int>& rows, JointWrench* joint) {
  const auto begin = rows.begin() + joint->contact_start;
  const auto end = begin + joint->num_contacts;
  CUPOLA_ASSERT(begin < end && joint->block_a < joint->block_b);
  std::vector<Vec3> points;
  Vec3 normal = Vec3::Zero();
  for (auto row = begin; row != end; ++row) {
    points.push_back(contacts.point[*row]);
    normal += contacts.area[*row] * contacts.normal[*row];
  }
  if (normal.norm() == 0.0) normal = contacts.normal[*begin];
  joint->patch = planar_hull(points, normal.normalized());

  double damaged_area = 0.0;
  for (auto row = begin; row != end; ++row) {
    const double n = contacts.normal_force[*row];
    joint->normal_force += n;
    joint->area += contacts.area[*row];
    joint->centroid += contacts.area[*row] * contacts.point[*row];
    if (contacts.area[*row] > 0.0)
      joint->largest_pressure = std::max(joint->largest_pressure, n / contacts.area[*row]);
    if (!contacts.strength_use.empty())
      joint->strength_use = std::fmax(joint->strength_use, contacts.strength_use[*row]);  // NaN at first
    if (!contacts.damage.empty()) damaged_area += contacts.area[*row] * contacts.damage[*row];
    // A joint that pulls elongates elastically before it cracks, and crushed faces part before they lose force.
    const double opening = (contacts.crack_opening.empty() ? contacts.gap : contacts.crack_opening)[*row];
    joint->opening = std::max(joint->opening, opening);
    joint->touches = joint->touches || !std::isnan(contacts.slip[*row]);
    joint->slip = std::max(joint->slip, contacts.slip[*row]);  // not NaN
  }
  joint->centroid = joint->area > 0.0 ? Vec3(joint->centroid / joint->area) : joint->patch.centroid;
  joint->friction_use = friction_use(contacts, begin, end);
  if (joint->area > 0.0 && !contacts.damage.empty()) joint->damage = damaged_area / joint->area;
  joint->wrench.point = joint->centre_of_pressure = joint->patch.centroid;
  for (auto row = begin; row != end; ++row)
    joint->wrench.add_force(contacts.point[*row], contacts.force[*row]);
  CUPOLA_ASSERT(joint->wrench.force.allFinite() && joint->wrench.moment.allFinite());
}

/// Moves the wrench to the centre of the normal forces. They have none where they cancel, as in pure bending.
void find_centre_of_pressure(const ContactTable& contacts, const std::vector<int>& rows, const Floor& floor,
                             JointWrench* joint) {
  constexpr double kRounding = 1e-9;  // of the forces that cancel
  Vec3 weighted = Vec3::Zero();
  double sizes = 0.0;
  for (int i = joint->contact_start; i < joint->contact_start + joint->num_contacts; ++i) {
    const double n = contacts.normal_force[rows[i]];
    weighted += n * (contacts.point[rows[i]] - joint->patch.centroid);
    sizes += std::abs(n);
  }
  joint->normal_force = above(joint->normal_force, std::max(floor.force, kRounding * sizes));
  if (joint->normal_force == 0.0) return;
  joint->centre_of_pressure += weighted / joint->normal_force;
  joint->wrench = moved_to(joint->wrench, joint->centre_of_pressure);
}

/// Fills in what follows from the direction and place of the joint's force, as far as it has them.
void measure(const ContactTable& contacts, const std::vector<int>& rows, const Floor& floor,
             JointWrench* joint) {
  constexpr double kNone = std::numeric_limits<double>::quiet_NaN();
  joint->negligible = floor.hides(joint->wrench.force);
  joint->opening = above(joint->opening, floor.length);
  joint->slip = above(joint->slip, floor.length);
  joint->axis.point = joint->patch.centroid;
  joint->eccentricity = joint->edge_distance = joint->kern = kNone;
  if (joint->negligible) {
    joint->friction_use = joint->couple_length = kNone;
    return;
  }
  find_centre_of_pressure(contacts, rows, floor, joint);
  if (joint->normal_force != 0.0) {
    const Eigen::Vector2d in_patch = joint->patch.coordinates(joint->centre_of_pressure);
    joint->eccentricity = above(in_patch.norm(), floor.length);
    joint->edge_distance = distance_to_outline(joint->patch, in_patch);
    if (joint->normal_force > 0.0) joint->kern = above(kern_use(joint->patch, in_patch), floor.share);
  }
  joint->friction_use = above(joint->friction_use, floor.share);
  joint->axis = central_axis(joint->wrench);
  joint->couple_length = couple_length(joint->wrench, floor);
}

}  // namespace

JointWrenches joint_wrenches(const Assembly& assembly, const ContactTable& contacts, const Shell& shell,
                             double unbalanced) {
  JointWrenches out;
  const std::vector<Joint> joints = joints_of(contacts);
  out.wrenches.resize(joints.size());
  for (size_t i = 0; i < joints.size(); ++i) static_cast<Joint&>(out.wrenches[i]) = joints[i];
  out.contacts.resize(static_cast<size_t>(contacts.size()));
  std::iota(out.contacts.begin(), out.contacts.end(), 0);
  std::stable_sort(out.contacts.begin(), out.contacts.end(),
                   [&](int i, int j) { return contacts.joint[i] < contacts.joint[j]; });
  for (int i = 0; i < contacts.size(); ++i) {
    JointWrench& joint = out.wrenches[contacts.joint[out.contacts[i]]];
    if (joint.num_contacts++ == 0) joint.contact_start = i;
  }
  std::erase_if(out.wrenches, [](const JointWrench& joint) { return joint.num_contacts == 0; });
  double largest = 0.0;
  for (JointWrench& joint : out.wrenches) {
    fill(contacts, out.contacts, &joint);
    largest = std::max(largest, joint.wrench.force.norm());
  }
  out.floor = floor_of(largest, unbalanced, block_size(assembly));
  for (JointWrench& joint : out.wrenches) {
    joint.open_share = open_share(contacts, out.contacts, out.floor, joint);
    measure(contacts, out.contacts, out.floor, &joint);
    if (joint.kind == JointKind::bed || joint.kind == JointKind::base) find_upper(assembly, shell, &joint);
  }
  index_by_block(assembly.blocks.size(), &out);
  return out;
}

void index_by_block(size_t num_blocks, JointWrenches* joints) {
  joints->of_block.assign(num_blocks, {});
  for (size_t i = 0; i < joints->wrenches.size(); ++i)
    for (const int block : {joints->wrenches[i].block_a, joints->wrenches[i].block_b})
      joints->of_block[block].push_back(static_cast<int>(i));
}

WytheRange wythes_of(const Assembly& assembly, const Shell& shell, const Joint& joint) {
  const WytheRange a = shell.wythes[joint.block_a], b = shell.wythes[joint.block_b];
  const WytheRange common{std::max(a.from, b.from), std::min(a.to, b.to)};
  if (common.count() > 0) return common;
  return assembly.blocks[joint.block_a].ring > assembly.blocks[joint.block_b].ring ? a : b;
}

Wrench wrench_on(const JointWrench& joint, int block) {
  CUPOLA_ASSERT(block == joint.block_a || block == joint.block_b);
  return block == joint.block_b ? joint.wrench : -1.0 * joint.wrench;
}

std::vector<Wrench> wrenches_from_below(const Assembly& assembly, const JointWrenches& joints,
                                        const Poses& poses) {
  std::vector<Wrench> wrenches(assembly.blocks.size());
  for (size_t b = 0; b < wrenches.size(); ++b)
    wrenches[b].point = poses.placed(static_cast<int>(b), assembly.blocks[b].centroid);
  for (const JointWrench& joint : joints.wrenches)
    if (joint.carried >= 0) wrenches[joint.carried].add(wrench_on(joint, joint.carried));
  return wrenches;
}

}  // namespace cupola

#include "postproc/mechanics/shell_cracks.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <span>

#include "assembly/base/disjoint_sets.hpp"

namespace cupola {
namespace {

/// An open joint: its gaps at both edges and its trace over the shell.
struct OpenJoint {
  int joint = 0;
  CrackCourse course = CrackCourse::layers;
  double inner = 0.0, outer = 0.0, widest = 0.0;  // m, gaps
  double depth = 0.0;                             // m, through the thickness
  double length = 0.0;                            // m, of the open part along the trace
  Vec3 from = Vec3::Zero(), to = Vec3::Zero();    // m, ends of the trace of the whole joint
};

CrackCourse course_of(JointKind kind) {
  if (kind == JointKind::bed || kind == JointKind::base) return CrackCourse::parallel;
  return kind == JointKind::wythe ? CrackCourse::layers : CrackCourse::meridional;
}

/// Mean direction from the intrados to the extrados of both blocks; zero if neither has one.
Vec3 through_shell(const std::vector<ShellAxes>& axes, const Joint& joint) {
  Vec3 sum = Vec3::Zero();
  for (const int block : {joint.block_a, joint.block_b})
    if (axes[block].exists) sum += axes[block].n;
  return sum.stableNormalized();
}

double gap_of(const ContactTable& c, int row, const Floor& floor) {
  const double gap = c.crack_opening.empty() ? c.gap[row] : c.crack_opening[row];
  return c.normal_force[row] > floor.force || gap <= floor.length ? 0.0 : gap;
}

/// m along a direction, over which a joint is open: to where its gap, linear between open and closed points,
/// vanishes. One corner alone opens over a length, too.
double open_length(const ContactTable& c, const JointWrench& j, const JointWrenches& joints,
                   const Vec3& along) {
  const std::span rows(joints.contacts.data() + j.contact_start, static_cast<size_t>(j.num_contacts));
  double from = std::numeric_limits<double>::infinity(), to = -from;
  for (const int open : rows) {
    const double gap = gap_of(c, open, joints.floor);
    if (gap == 0.0) continue;
    for (const int other : rows) {
      const bool is_open = gap_of(c, other, joints.floor) > 0.0;
      const double share = is_open ? 1.0 : gap / (gap - std::min(0.0, c.gap[other]));
      const double x = along.dot(c.point[open] + share * (c.point[other] - c.point[open]));
      from = std::min(from, x);
      to = std::max(to, x);
    }
  }
  return std::max(0.0, to - from);
}

OpenJoint open_joint(const ContactTable& c, const JointWrenches& joints, int number, const Vec3& outwards) {
  constexpr double kEdge = 0.25;  // share of the depth, at either edge
  const JointWrench& j = joints.wrenches[number];
  OpenJoint open{.joint = number, .course = course_of(j.kind)};
  const Vec3 normal = j.patch.plane.normal;
  const Vec3 depth = (outwards - outwards.dot(normal) * normal).stableNormalized();
  if (depth.isZero(0.0)) open.course = CrackCourse::layers;
  const Vec3 along = depth.isZero(0.0) ? j.patch.axis_1 : Vec3(normal.cross(depth));
  Eigen::Vector2d low(1e300, 1e300), high(-1e300, -1e300);  // along, depth
  const auto place = [&](int row) {
    const Vec3 x = c.point[row] - j.patch.centroid;
    return Eigen::Vector2d(x.dot(along), x.dot(depth));
  };
  for (int i = j.contact_start; i < j.contact_start + j.num_contacts; ++i) {
    low = low.cwiseMin(place(joints.contacts[i]));
    high = high.cwiseMax(place(joints.contacts[i]));
  }
  open.depth = high.y() - low.y();
  for (int i = j.contact_start; i < j.contact_start + j.num_contacts; ++i) {
    const int row = joints.contacts[i];
    const double gap = gap_of(c, row, joints.floor);
    if (gap == 0.0) continue;
    const Eigen::Vector2d at = place(row);
    open.widest = std::max(open.widest, gap);
    if (open.course != CrackCourse::layers) {  // which end at no face
      if (at.y() <= low.y() + kEdge * open.depth) open.inner = std::max(open.inner, gap);
      if (at.y() >= high.y() - kEdge * open.depth) open.outer = std::max(open.outer, gap);
    }
  }
  open.length = open_length(c, j, joints, along);
  open.from = j.patch.centroid + low.x() * along;
  open.to = j.patch.centroid + high.x() * along;
  return open;
}

/// The blocks that each block meets at a bed.
std::vector<std::set<int>> beds_between(const Assembly& assembly, const JointWrenches& joints) {
  std::vector<std::set<int>> met(assembly.blocks.size());
  for (const JointWrench& j : joints.wrenches) {
    if (course_of(j.kind) != CrackCourse::parallel) continue;
    met[j.block_a].insert(j.block_b);
    met[j.block_b].insert(j.block_a);
  }
  return met;
}

class Chains {
 public:
  Chains(const Assembly& assembly, const JointWrenches& joints, const std::vector<OpenJoint>& open)
      : assembly_(assembly), joints_(joints), open_(open), met_(beds_between(assembly, joints)) {}

  bool follow(int p, int q) const {
    const OpenJoint &a = open_[p], &b = open_[q];
    if (a.course != b.course) return false;
    const JointWrench &ja = joints_.wrenches[a.joint], &jb = joints_.wrenches[b.joint];
    if (a.course == CrackCourse::layers) return shares_block(ja, jb);
    if (assembly_.num_rings == 0) return meets_end(a, b);
    if (a.course == CrackCourse::parallel)
      return follow_along(ja, jb) && (shares_block(ja, jb) || meets_end(a, b));
    return ja.ring != jb.ring && (meets_end(a, b) || (on_common_bed(ja, jb) && ends_near(a, b)));
  }

 private:
  /// Joints of one bed, or along the supports, which may lie beside several courses.
  static bool follow_along(const Joint& a, const Joint& b) {
    return a.kind == b.kind && (a.kind == JointKind::base || a.ring == b.ring);
  }
  static bool shares_block(const Joint& a, const Joint& b) {
    return a.block_a == b.block_a || a.block_a == b.block_b || a.block_b == b.block_a ||
           a.block_b == b.block_b;
  }
  bool meets_end(const OpenJoint& a, const OpenJoint& b) const {
    const double tolerance = 0.1 * std::min((a.to - a.from).norm(), (b.to - b.from).norm());
    return least_distance(a, b) <= tolerance;
  }
  static double least_distance(const OpenJoint& a, const OpenJoint& b) {
    return std::min(
        {(a.from - b.from).norm(), (a.from - b.to).norm(), (a.to - b.from).norm(), (a.to - b.to).norm()});
  }
  /// A block of the one rests on a block of the other.
  bool on_common_bed(const Joint& a, const Joint& b) const {
    for (const int x : {a.block_a, a.block_b})
      for (const int y : {b.block_a, b.block_b})
        if (met_[x].contains(y)) return true;
    return false;
  }
  /// Not further apart than the larger of the blocks beside them is wide.
  bool ends_near(const OpenJoint& a, const OpenJoint& b) const {
    const JointWrench &ja = joints_.wrenches[a.joint], &jb = joints_.wrenches[b.joint];
    double width = 0.0;
    for (const JointWrench* j : {&ja, &jb})
      width = std::max(
          width, (assembly_.blocks[j->block_a].centroid - assembly_.blocks[j->block_b].centroid).norm());
    return least_distance(a, b) <= 0.75 * width;
  }

  const Assembly& assembly_;
  const JointWrenches& joints_;
  const std::vector<OpenJoint>& open_;
  std::vector<std::set<int>> met_;
};

std::vector<OpenJoint> open_joints(const ContactTable& c, const JointWrenches& joints,
                                   const std::vector<ShellAxes>& axes) {
  std::vector<OpenJoint> all;
  double widest = 0.0;
  for (size_t j = 0; j < joints.wrenches.size(); ++j) {
    OpenJoint open = open_joint(c, joints, static_cast<int>(j), through_shell(axes, joints.wrenches[j]));
    widest = std::max(widest, open.widest);
    if (open.widest > 0.0) all.push_back(std::move(open));
  }
  std::erase_if(all, [&](const OpenJoint& open) { return open.widest < kHairline * widest; });
  return all;
}

/// The pairs that may follow each other: those whose blocks are the same or meet.
std::vector<std::vector<int>> joints_of_blocks(const Assembly& assembly, const JointWrenches& joints,
                                               const std::vector<OpenJoint>& open) {
  std::vector<std::vector<int>> of(assembly.blocks.size());
  for (size_t k = 0; k < open.size(); ++k) {
    const JointWrench& j = joints.wrenches[open[k].joint];
    of[j.block_a].push_back(static_cast<int>(k));
    of[j.block_b].push_back(static_cast<int>(k));
  }
  return of;
}

ShellCrack crack_of(const Assembly& assembly, const std::vector<OpenJoint>& open, std::vector<int> members,
                    const JointWrenches& joints) {
  const auto key = [&](int k) { return std::pair(joints.wrenches[open[k].joint].ring, open[k].joint); };
  std::ranges::sort(members, {}, key);
  ShellCrack crack;
  crack.course = open[members.front()].course;
  double weight = 0.0;
  for (const int k : members) {
    const OpenJoint& o = open[k];
    const JointWrench& j = joints.wrenches[o.joint];
    crack.joints.push_back(o.joint);
    crack.length += o.length;
    crack.width = std::max(crack.width, o.widest);
    crack.width_inner = std::max(crack.width_inner, o.inner);
    crack.width_outer = std::max(crack.width_outer, o.outer);
    crack.through = crack.through || (o.inner > 0.0 && o.outer > 0.0);
    const double rotation = o.depth > 0.0 ? (o.outer - o.inner) / o.depth : 0.0;
    if (std::abs(rotation) > std::abs(crack.rotation)) crack.rotation = rotation;
    crack.slip = std::max(crack.slip, j.slip);
    crack.middle += o.widest * j.patch.centroid;
    weight += o.widest;
  }
  crack.middle /= weight;
  const JointWrench& first = joints.wrenches[crack.joints.front()];
  crack.azimuth = azimuth(assembly, first.block_a, first.block_b, crack.middle);
  crack.start = first.patch.centroid;
  crack.end = joints.wrenches[crack.joints.back()].patch.centroid;
  return crack;
}

}  // namespace

std::vector<ShellCrack> shell_cracks(const Assembly& assembly, const ContactTable& contacts,
                                     const JointWrenches& joints, const std::vector<ShellAxes>& axes) {
  const std::vector<OpenJoint> open = open_joints(contacts, joints, axes);
  const Chains chains(assembly, joints, open);
  const std::vector<std::vector<int>> of_block = joints_of_blocks(assembly, joints, open);
  std::vector<std::vector<int>> near(assembly.blocks.size());  // blocks that share a joint, ascending
  for (const JointWrench& j : joints.wrenches) {
    near[j.block_a].push_back(j.block_b);
    near[j.block_b].push_back(j.block_a);
  }
  for (std::vector<int>& blocks : near) {
    std::ranges::sort(blocks);
    blocks.erase(std::unique(blocks.begin(), blocks.end()), blocks.end());
  }
  DisjointSets joined(open.size());
  const auto join_with = [&](int k, int block) {
    for (const int other : of_block[block])
      if (other > k && chains.follow(k, other)) joined.join(other, k);
  };
  for (size_t k = 0; k < open.size(); ++k) {
    const JointWrench& j = joints.wrenches[open[k].joint];
    for (const int block : {j.block_a, j.block_b}) {
      join_with(static_cast<int>(k), block);
      for (const int other : near[block]) join_with(static_cast<int>(k), other);
    }
  }
  std::map<int, std::vector<int>> groups;
  for (size_t k = 0; k < open.size(); ++k)
    groups[joined.root(static_cast<int>(k))].push_back(static_cast<int>(k));
  std::vector<ShellCrack> cracks;
  for (auto& [root, members] : groups) cracks.push_back(crack_of(assembly, open, std::move(members), joints));
  std::ranges::stable_sort(cracks, std::ranges::greater(), &ShellCrack::width);
  return cracks;
}

}  // namespace cupola

#include "postproc/mechanics/cuts.hpp"

#include <cmath>
#include <map>
#include <numbers>

#include "assembly/base/error.hpp"
#include "postproc/mechanics/chain_forces.hpp"

namespace cupola {

std::vector<CutPolygon> cut_by_plane(const Assembly& assembly, const Plane& plane,
                                     const std::vector<bool>& left_out) {
  CUPOLA_ASSERT(std::abs(plane.normal.norm() - 1.0) < 1e-9);
  std::vector<CutPolygon> polygons;
  std::vector<Vec3> crossings;
  for (size_t p = 0; p < assembly.parts.size(); ++p) {
    const Part& part = assembly.parts[p];
    if (!left_out.empty() && left_out[part.block]) continue;
    crossings.clear();
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f) {
      const auto face = assembly.face(f);
      for (size_t i = 0; i < face.size(); ++i) {
        const Vec3& a = assembly.vertices[face[i]];
        const Vec3& b = assembly.vertices[face[(i + 1) % face.size()]];
        const double s = plane.normal.dot(a) - plane.offset, t = plane.normal.dot(b) - plane.offset;
        // Two faces share every edge and run along it in opposite directions; count the one that rises.
        if (s < 0.0 && t >= 0.0) crossings.push_back(a + s / (s - t) * (b - a));
      }
    }
    if (crossings.size() < 3) continue;
    const PlanarHull hull = planar_hull(crossings, plane.normal);
    if (hull.outline.size() < 3) continue;
    CutPolygon polygon{static_cast<int>(p), part.block, part.ring, {}};
    for (const Eigen::Vector2d& corner : hull.outline) polygon.outline.push_back(hull.position(corner));
    polygons.push_back(std::move(polygon));
  }
  return polygons;
}

std::vector<HoopRow> hoop_forces(const Assembly& assembly, const JointWrenches& joints, double azimuth_deg,
                                 const TieTable& ties, int ring) {
  const double angle = azimuth_deg * std::numbers::pi / 180.0;
  const Sheet axis = assembly.axis_of(ring);
  const auto [first, end] = assembly.stack_of(ring);
  const Vec3 outwards = axis.towards(angle), along(-outwards.y(), outwards.x(), 0.0);
  const Vec3 foot(axis.origin.x(), axis.origin.y(), 0.0);
  const double on_plane = on_plane_tolerance(assembly);
  const double in_turn = std::remainder(azimuth_deg, 360.0);
  const bool is_opposite = in_turn < 0.0 || in_turn == 180.0;
  const auto positive = [&](int block) {
    const double distance = along.dot(assembly.blocks[block].centroid - foot);
    return std::abs(distance) <= on_plane ? is_opposite : distance > 0.0;
  };
  // Share of a force at a point that crosses this half-plane, not the opposite one: half at the axis.
  const auto on_this_side = [&](const Vec3& at) {
    const double distance = outwards.dot(at - foot);
    return std::abs(distance) <= on_plane ? 0.5 : distance > 0.0 ? 1.0 : 0.0;
  };
  const auto is_of_stack = [&, first = first, end = end](int block) {
    return assembly.blocks[block].ring >= first && assembly.blocks[block].ring < end;
  };
  std::map<int, HoopRow> rows;
  std::map<int, int> counts;
  for (const JointWrench& joint : joints.wrenches) {
    const int a = joint.block_a, b = joint.block_b;
    if (assembly.blocks[a].fixed || assembly.blocks[b].fixed || positive(a) == positive(b)) continue;
    if (!is_of_stack(a) || !is_of_stack(b)) continue;
    const double share = on_this_side(joint.patch.centroid);
    if (share == 0.0) continue;
    const double force = share * along.dot(wrench_on(joint, positive(b) ? b : a).force);
    HoopRow& row = rows[joint.ring];
    row.ring = joint.ring;
    row.height += joint.patch.centroid.z();
    ++counts[joint.ring];
    (joint.kind == JointKind::head ? row.head_force : row.bed_force) += force;
  }
  for (int i = 0; i < ties.size(); ++i) {
    const int a = ties.block_a[i], b = ties.block_b[i];
    if (positive(a) == positive(b) || !is_of_stack(a) || ties.force[i] == 0.0) continue;
    const Vec3 from = ties.point_a[i] - foot, to = ties.point_b[i] - foot;
    const double s = along.dot(from), t = along.dot(to);
    const double share = s * t < 0.0 ? s / (s - t) : 0.5;  // else the bar ends in a block that the plane cuts
    const Vec3 at = (1.0 - share) * from + share * to;
    const double share_here = on_this_side(foot + at);
    if (share_here == 0.0) continue;
    const Vec3 on_b = tie_force_on_b(ties, i);
    const int course = assembly.blocks[a].ring;
    // In a motion a course that is cracked through has no joint here.
    const auto [row, is_alone] = rows.try_emplace(course, HoopRow{.ring = course, .height = at.z()});
    counts[course] += is_alone ? 1 : 0;
    row->second.tie_force += share_here * along.dot(positive(b) ? on_b : Vec3(-on_b));
  }
  std::vector<HoopRow> out;
  for (auto& [number, row] : rows) {
    row.height /= counts[number];
    for (double* force : {&row.head_force, &row.bed_force, &row.tie_force})
      *force = above(*force, joints.floor.force);
    out.push_back(row);
  }
  return out;
}

}  // namespace cupola

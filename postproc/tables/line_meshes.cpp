#include <utility>

#include "postproc/tables/mesh_output.hpp"
#include "postproc/tables/mesh_parts.hpp"

namespace cupola {
namespace {

using CellType = Mesh::CellType;

}  // namespace

Mesh thrust_lines_mesh(const Evaluation& e) {
  const double scale = common_scale(e);
  Mesh mesh;
  MeshInts what, meridian;
  MeshDoubles resultant;
  const auto add_line = [&](const std::vector<Vec3>& points, int kind, int index, double r) {
    if (points.size() < 2) return;
    std::vector<int> ids;
    for (const Vec3& p : points) ids.push_back(add_point(&mesh, p));
    mesh.add_cell(CellType::polyline, ids);
    what.push_back(kind);
    meridian.push_back(index);
    resultant.push_back(r);
  };
  for (size_t m = 0; m < e.meridians.size(); ++m) {
    const ThrustLine& line = e.meridians[m].thrust;
    const int index = static_cast<int>(m);
    std::vector<Vec3> thrust, intrados, extrados;
    for (const ThrustPoint& p : line.points) {
      intrados.push_back(p.intrados);
      extrados.push_back(p.extrados);
      if (p.is_placed()) {
        thrust.push_back(p.point);
        add_line({p.point, p.point + scale * p.force}, 2, index, p.r);
      } else {  // the line is interrupted
        add_line(std::exchange(thrust, {}), 0, index, 0.0);
      }
    }
    add_line(thrust, 0, index, 0.0);
    add_line(line.envelope, 1, index, 0.0);
    add_line(intrados, 3, index, 0.0);
    add_line(extrados, 4, index, 0.0);
  }
  mesh.cell_data = {{"what", 1, std::move(what)},
                    {"meridian", 1, std::move(meridian)},
                    {"resultant_N", 1, std::move(resultant)}};
  mesh.field_data = about(e, scale);
  return mesh;
}

Mesh sections_mesh(const Evaluation& e) {
  const double scale = common_scale(e);
  Mesh mesh;
  MeshInts what, cut, block;
  MeshDoubles height, resultant;
  int index = 0;  // sections first, then planes
  const auto note = [&](int kind, int b, double z, double r) {
    what.push_back(kind);
    cut.push_back(index);
    block.push_back(b);
    height.push_back(z);
    resultant.push_back(r);
  };
  const auto add_segment = [&](const Vec3& from, const Vec3& force, int b, double z) {
    const int start = add_point(&mesh, from);
    mesh.add_cell(CellType::polyline, {start, add_point(&mesh, from + scale * force)});
    note(0, b, z, force.norm());
  };
  // Lines come before polygons in a file of this kind.
  for (const SectionEvaluation& section : e.sections) {
    for (const BedResultant& r : section.resultants)
      add_segment(r.point, r.wrench.force, r.block, section.height);
    ++index;
  }
  for (const PlaneCut& plane : e.planes) {
    for (const int j : plane.joints) {
      const JointWrench& joint = e.last.joints.wrenches[j];
      add_segment(joint.wrench.point, force_beyond(plane, e.assembly, joint), joint.block_b, plane.point.z());
    }
    ++index;
  }
  const auto add_outlines = [&](const std::vector<CutPolygon>& polygons, double z) {
    for (const CutPolygon& polygon : polygons) {
      std::vector<int> ids;
      for (const Vec3& p : polygon.outline) ids.push_back(add_point(&mesh, p));
      mesh.add_cell(CellType::polygon, ids);
      note(1, polygon.block, z, 0.0);
    }
    ++index;
  };
  index = 0;
  for (const SectionEvaluation& section : e.sections) add_outlines(section.polygons, section.height);
  for (const PlaneCut& plane : e.planes) add_outlines(plane.polygons, plane.point.z());
  mesh.cell_data = {{"what", 1, std::move(what)},
                    {"cut", 1, std::move(cut)},
                    {"block", 1, std::move(block)},
                    {"height_m", 1, std::move(height)},
                    {"resultant_N", 1, std::move(resultant)}};
  mesh.field_data = about(e, scale);
  return mesh;
}

Mesh cracks_mesh(const Evaluation& e) {
  const ContactTable& c = e.last.frame.contacts;
  Mesh mesh;
  MeshInts joint_id, kind;
  MeshDoubles opening, slip;
  for (size_t j = 0; j < e.last.joints.wrenches.size(); ++j) {
    const JointWrench& joint = e.last.joints.wrenches[j];
    std::vector<Vec3> open;
    for (int i = joint.contact_start; i < joint.contact_start + joint.num_contacts; ++i) {
      const int row = e.last.joints.contacts[i];
      if (c.normal_force[row] <= 0.0 && c.gap[row] > 0.0) open.push_back(c.point[row]);
    }
    if (open.size() < 2) continue;
    const PlanarHull hull = planar_hull(open, joint.patch.plane.normal);
    if (hull.outline.size() < 2) continue;
    std::vector<int> ids;
    for (const Eigen::Vector2d& corner : hull.outline) ids.push_back(add_point(&mesh, hull.position(corner)));
    if (ids.size() > 2) ids.push_back(ids.front());
    mesh.add_cell(CellType::polyline, ids);
    joint_id.push_back(static_cast<int>(j));
    kind.push_back(static_cast<int>(joint.kind));
    opening.push_back(joint.opening);
    slip.push_back(joint.slip);
  }
  mesh.cell_data = {{"opening_m", 1, std::move(opening)},
                    {"slip_m", 1, std::move(slip)},
                    {"joint", 1, std::move(joint_id)},
                    {"kind", 1, std::move(kind)}};
  mesh.field_data = about(e, 0.0);
  return mesh;
}

}  // namespace cupola

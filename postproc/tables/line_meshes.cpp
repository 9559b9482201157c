#include <functional>
#include <utility>

#include "postproc/tables/mesh_output.hpp"
#include "postproc/tables/mesh_parts.hpp"
#include "postproc/tables/result_columns.hpp"

namespace cupola {
namespace {

using CellType = Mesh::CellType;

}  // namespace

Mesh thrust_lines_mesh(const Evaluation& e) {
  const double scale = common_scale(e);
  Mesh mesh;
  std::vector<LineCell> cells;
  const auto add_line = [&](const std::vector<Vec3>& points, LineCell::What what, int meridian,
                            double resultant = 0.0) {
    if (points.size() < 2) return;
    std::vector<int> ids;
    for (const Vec3& p : points) ids.push_back(add_point(&mesh, p));
    mesh.add_cell(CellType::polyline, ids);
    cells.push_back({what, meridian, resultant});
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
        add_line({p.point, p.point + scale * p.force}, LineCell::line_of_action, index, p.r);
      } else {  // the line is interrupted
        add_line(std::exchange(thrust, {}), LineCell::line_of_thrust, index);
      }
    }
    add_line(thrust, LineCell::line_of_thrust, index);
    add_line(line.envelope, LineCell::envelope, index);
    add_line(intrados, LineCell::intrados, index);
    add_line(extrados, LineCell::extrados, index);
    for (const ThrustLine& wythe : e.meridians[m].wythes)
      for (const std::vector<Vec3>& run : wythe.runs()) add_line(run, LineCell::line_of_wythe, index);
  }
  mesh.cell_data = mesh_arrays(line_cell_columns(), cells, kLineCellKeys);
  mesh.field_data = about(e, scale);
  return mesh;
}

Mesh ties_mesh(const Evaluation& e) {
  const TieTable& ties = e.last.frame.ties;
  Mesh mesh;
  MeshInts chain;
  for (int i = 0; i < ties.size(); ++i) {
    const int start = add_point(&mesh, ties.point_a[i]);
    mesh.add_cell(CellType::polyline, {start, add_point(&mesh, ties.point_b[i])});
    chain.push_back(ties.chain[i]);
  }
  mesh.cell_data = mesh_arrays(tie_columns(), tie_rows(e), kTieKeys);
  mesh.cell_data.push_back({"chain", 1, std::move(chain)});
  mesh.field_data = about(e, 0.0);
  return mesh;
}

Mesh sections_mesh(const Evaluation& e) {
  const double scale = common_scale(e);
  Mesh mesh;
  std::vector<SectionCell> cells;
  int index = 0;  // of the cut: sections first, then planes
  const auto add_segment = [&](const Vec3& from, const Vec3& force, int block, double height) {
    const int start = add_point(&mesh, from);
    mesh.add_cell(CellType::polyline, {start, add_point(&mesh, from + scale * force)});
    cells.push_back({SectionCell::segment, index, block, height, force.norm()});
  };
  // In a .vtp file, lines come before polygons.
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
  const auto add_outlines = [&](const std::vector<CutPolygon>& polygons, double height) {
    for (const CutPolygon& polygon : polygons) {
      std::vector<int> ids;
      for (const Vec3& p : polygon.outline) ids.push_back(add_point(&mesh, p));
      mesh.add_cell(CellType::polygon, ids);
      cells.push_back({SectionCell::outline, index, polygon.block, height});
    }
    ++index;
  };
  index = 0;
  for (const SectionEvaluation& section : e.sections) add_outlines(section.polygons, section.height);
  for (const PlaneCut& plane : e.planes) add_outlines(plane.polygons, plane.point.z());
  mesh.cell_data = mesh_arrays(section_cell_columns(), cells, kSectionCellKeys);
  mesh.field_data = about(e, scale);
  return mesh;
}

Mesh cracks_mesh(const Evaluation& e) {
  Mesh mesh;
  MeshInts joint_id, crack_id;
  std::vector<int> crack_of(e.last.joints.wrenches.size(), -1);
  for (const CrackRow& row : crack_rows(e))
    for (const int joint : row.crack.joints) crack_of[joint] = row.number;
  std::vector<std::reference_wrapper<const JointWrench>> cracked;
  for (const Crack& crack : e.joint_cracks) {
    std::vector<int> ids;
    for (const Eigen::Vector2d& corner : crack.open.outline)
      ids.push_back(add_point(&mesh, crack.open.position(corner)));
    if (ids.size() != 2) ids.push_back(ids.front());  // a single point makes a line of no length
    mesh.add_cell(CellType::polyline, ids);
    joint_id.push_back(crack.joint);
    crack_id.push_back(crack_of[crack.joint]);
    cracked.emplace_back(e.last.joints.wrenches[crack.joint]);
  }
  mesh.cell_data = mesh_arrays(joint_columns(), cracked, kCrackKeys);
  mesh.cell_data.insert(mesh.cell_data.end() - 1, {"joint", 1, std::move(joint_id)});
  mesh.cell_data.push_back({kCrackNumberKeys[0], 1, std::move(crack_id)});
  mesh.field_data = about(e, 0.0);
  return mesh;
}

}  // namespace cupola

#include "postproc/tables/mesh_output.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "assembly/files/part_cells.hpp"
#include "postproc/tables/mesh_parts.hpp"
#include "postproc/tables/range_values.hpp"
#include "postproc/tables/result_columns.hpp"

namespace cupola {
namespace {

using CellType = Mesh::CellType;

/// The array `relative_range` of a range analysis of joints; NaN for joints without a range.
void add_relative_ranges(const Evaluation& e, Mesh* mesh) {
  MeshDoubles values = relative_ranges(e.summary.ranges, e.last.joints.wrenches);
  if (values.empty()) return;
  mesh->point_data.push_back({"relative_range", 1, std::move(values)});
}

/// The force that is drawn: on the upper block of a bed joint, on the second block of any other.
Vec3 drawn_force(const JointWrench& joint) {
  return joint.upper >= 0 ? wrench_on(joint, joint.upper).force : joint.wrench.force;
}

}  // namespace

DisplacedBlocks::DisplacedBlocks(const Evaluation& evaluation) : evaluation_(evaluation) {
  const Assembly& assembly = evaluation.assembly;
  Assembly split;  // the topology, in which blocks share no vertices
  split.parts = assembly.parts;
  split.face_kinds = assembly.face_kinds;
  split.face_vertex_start = assembly.face_vertex_start;
  split.face_vertices.resize(assembly.face_vertices.size());
  const size_t most = assembly.face_vertices.size() / 3;  // three faces of a part meet at a vertex
  vertices_.reserve(most);
  vertex_block_.reserve(most);
  std::vector<int> new_id(assembly.vertices.size(), -1);
  int first = 0, block = -1;  // new ids from `first` on are the current block's
  for (const Part& part : assembly.parts) {
    if (part.block != block) first = static_cast<int>(vertices_.size());
    block = part.block;
    const int start = assembly.face_vertex_start[part.face_start];
    const int end = assembly.face_vertex_start[part.face_start + part.num_faces];
    for (int i = start; i < end; ++i) {
      const int old_id = assembly.face_vertices[i];
      if (new_id[old_id] < first) {
        new_id[old_id] = static_cast<int>(vertices_.size());
        vertices_.push_back(assembly.vertices[old_id]);
        vertex_block_.push_back(block);
      }
      split.face_vertices[i] = new_id[old_id];
    }
  }
  add_part_cells(split, &mesh_);
}

Mesh& DisplacedBlocks::at(const FrameEvaluation& e) {
  const Assembly& assembly = evaluation_.assembly;
  mesh_.points.clear();
  mesh_.points.reserve(3 * vertices_.size());
  MeshDoubles displacement;
  displacement.reserve(3 * vertices_.size());
  std::vector<Mat3> rotation;
  for (const Eigen::Vector4d& q : e.frame.blocks.quaternion_wxyz)
    rotation.push_back(Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix());
  for (size_t v = 0; v < vertices_.size(); ++v) {
    const int b = vertex_block_[v];
    const Vec3 moved =
        e.frame.blocks.position[b] + rotation[b] * (vertices_[v] - assembly.blocks[b].centroid);
    add_point(&mesh_, moved);
    append(moved - vertices_[v], &displacement);
  }
  mesh_.point_data.clear();
  mesh_.point_data.push_back({"displacement_m", 3, std::move(displacement)});

  const std::vector<BlockRow> blocks = block_rows(evaluation_, e);
  std::vector<BlockRow> parts;
  parts.reserve(assembly.parts.size());
  for (const Part& part : assembly.parts) {
    parts.push_back(blocks[part.block]);
    parts.back().ring = part.ring;
  }
  mesh_.cell_data = mesh_arrays(block_columns(), parts, kBlockMeshKeys);
  if (is_stage(e.frame.role)) {
    MeshInts laid;
    for (const BlockRow& part : parts) laid.push_back(part.laid ? 1 : 0);
    mesh_.cell_data.push_back({"laid", 1, std::move(laid)});
  }
  mesh_.field_data = {{"time_s", 1, MeshDoubles{e.frame.time}}};
  return mesh_;
}

double round_down(double value) {
  CUPOLA_ASSERT(value > 0.0);
  const double power = std::pow(10.0, std::floor(std::log10(value)));
  for (const double digit : {5.0, 2.0})
    if (digit * power <= value) return digit * power;
  return power;
}

double segment_scale(const Assembly& assembly, double largest_force) {
  if (largest_force <= 0.0) return 0.0;
  return round_down(0.1 * model_size(assembly) / largest_force);
}

Mesh joints_mesh(const Evaluation& e) {
  const auto& joints = e.last.joints.wrenches;
  Mesh mesh;
  for (const JointWrench& joint : joints)
    mesh.add_cell(CellType::vertex, {add_point(&mesh, joint.wrench.point)});
  mesh.point_data = mesh_arrays(joint_columns(), joints, kJointKeys);
  add_relative_ranges(e, &mesh);
  mesh.field_data = about(e, 0.0);
  return mesh;
}

Mesh joint_forces_mesh(const Evaluation& e) {
  const auto& joints = e.last.joints.wrenches;
  const double scale = common_scale(e);
  Mesh mesh;
  for (const JointWrench& joint : joints) {
    const int start = add_point(&mesh, joint.wrench.point);
    mesh.add_cell(CellType::polyline,
                  {start, add_point(&mesh, joint.wrench.point + scale * drawn_force(joint))});
  }
  mesh.cell_data = mesh_arrays(joint_columns(), joints, kJointKeys);
  mesh.field_data = about(e, scale);
  return mesh;
}

Mesh wrenches_mesh(const Evaluation& e) {
  const double scale = common_scale(e);
  Mesh mesh;
  std::vector<BlockRow> segments, points;
  MeshInts tip;
  for (const BlockRow& row : block_rows(e, e.last)) {
    if (row.block.fixed || !row.axis.exists) continue;
    const int start = add_point(&mesh, row.axis.point);
    const int end = add_point(&mesh, row.axis.point + scale * row.from_below.force);
    mesh.add_cell(CellType::polyline, {start, end});
    segments.push_back(row);
    for (const int at_tip : {0, 1}) {
      points.push_back(row);
      tip.push_back(at_tip);
    }
  }
  mesh.point_data = mesh_arrays(block_columns(), points, kWrenchPointKeys);
  mesh.point_data.push_back({"tip", 1, std::move(tip)});
  mesh.cell_data = mesh_arrays(block_columns(), segments, kWrenchCellKeys);
  mesh.field_data = about(e, scale);
  return mesh;
}

}  // namespace cupola

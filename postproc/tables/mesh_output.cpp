#include "postproc/tables/mesh_output.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <Eigen/Geometry>

#include "assembly/files/part_cells.hpp"
#include "postproc/tables/mesh_parts.hpp"

namespace cupola {
namespace {

using CellType = Mesh::CellType;

/// The force as it is drawn: on the upper block of a bed, on the second block elsewhere.
Vec3 drawn_force(const JointWrench& joint) {
  return joint.upper >= 0 ? wrench_on(joint, joint.upper).force : joint.wrench.force;
}

}  // namespace

DisplacedBlocks::DisplacedBlocks(const Assembly& assembly) : assembly_(assembly), split_(assembly) {
  split_.vertices.clear();
  std::map<int, int> new_id;  // of the current block's vertices
  int block = -1;
  for (const Part& part : assembly.parts) {
    if (part.block != block) new_id.clear();
    block = part.block;
    const int start = assembly.face_vertex_start[part.face_start];
    const int end = assembly.face_vertex_start[part.face_start + part.num_faces];
    for (int i = start; i < end; ++i) {
      const int old_id = assembly.face_vertices[i];
      const auto [entry, is_new] = new_id.try_emplace(old_id, static_cast<int>(split_.vertices.size()));
      if (is_new) {
        split_.vertices.push_back(assembly.vertices[old_id]);
        vertex_block_.push_back(block);
      }
      split_.face_vertices[i] = entry->second;
    }
  }
  add_part_cells(split_, &cells_);
}

Mesh DisplacedBlocks::at(const FrameEvaluation& e) const {
  Mesh mesh = cells_;
  MeshDoubles displacement;
  displacement.reserve(3 * split_.vertices.size());
  std::vector<Mat3> rotation;
  for (const Eigen::Vector4d& q : e.frame.blocks.quaternion_wxyz)
    rotation.push_back(Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix());
  for (size_t v = 0; v < split_.vertices.size(); ++v) {
    const int b = vertex_block_[v];
    const Vec3 moved =
        e.frame.blocks.position[b] + rotation[b] * (split_.vertices[v] - assembly_.blocks[b].centroid);
    add_point(&mesh, moved);
    append(moved - split_.vertices[v], &displacement);
  }
  mesh.point_data = {{"displacement_m", 3, std::move(displacement)}};

  const auto ints = [&](const char* name, auto get) {
    MeshInts values;
    for (const Part& part : assembly_.parts) values.push_back(get(part));
    mesh.cell_data.push_back({name, 1, std::move(values)});
  };
  const auto doubles = [&](const char* name, auto get) {
    MeshDoubles values;
    for (const Part& part : assembly_.parts) values.push_back(get(e.fields[part.block]));
    mesh.cell_data.push_back({name, 1, std::move(values)});
  };
  doubles("meridional_force_N_per_m", [](const BlockFields& f) { return f.meridional_force; });
  doubles("hoop_force_N_per_m", [](const BlockFields& f) { return f.hoop_force; });
  doubles("resultant_N", [](const BlockFields& f) { return f.resultant; });
  doubles("couple_length_m", [](const BlockFields& f) { return f.couple_length; });
  doubles("friction_use", [](const BlockFields& f) { return f.friction_use; });
  doubles("kern_use", [](const BlockFields& f) { return f.kern; });
  doubles("opening_m", [](const BlockFields& f) { return f.opening; });
  doubles("slip_m", [](const BlockFields& f) { return f.slip; });
  ints("mechanism_group", [&](const Part& p) { return e.groups[p.block]; });
  ints("block", [](const Part& p) { return p.block; });
  ints("ring", [](const Part& p) { return p.ring; });
  ints("kind", [&](const Part& p) { return static_cast<int>(assembly_.blocks[p.block].kind); });
  mesh.field_data = {{"time_s", 1, MeshDoubles{e.frame.time}}};
  return mesh;
}

double segment_scale(const Assembly& assembly, double largest_force) {
  if (largest_force <= 0.0) return 0.0;
  Eigen::AlignedBox3d box;
  for (const Block& block : assembly.blocks)
    if (!block.fixed) box.extend(block.centroid);
  const double longest = 0.1 * std::max(box.diagonal().norm(), std::cbrt(assembly.blocks.front().volume));
  const double exact = longest / largest_force;
  const double power = std::pow(10.0, std::floor(std::log10(exact)));
  for (const double digit : {5.0, 2.0})
    if (digit * power <= exact) return digit * power;
  return power;
}

Mesh joints_mesh(const Evaluation& e) {
  const auto& joints = e.last.joints.wrenches;
  const double scale = common_scale(e);
  Mesh mesh;
  for (const JointWrench& joint : joints) add_point(&mesh, joint.wrench.point);
  for (const JointWrench& joint : joints) add_point(&mesh, joint.wrench.point + scale * drawn_force(joint));
  const int n = static_cast<int>(joints.size());
  for (int i = 0; i < n; ++i) mesh.add_cell(CellType::vertex, {i});
  for (int i = 0; i < n; ++i) mesh.add_cell(CellType::polyline, {i, n + i});

  // Points and tips carry the same values, and so do the two cells of a joint.
  const auto ints = [&](const char* name, auto get) {
    MeshInts values;
    for (int repeat = 0; repeat < 2; ++repeat)
      for (const JointWrench& joint : joints) values.push_back(get(joint));
    mesh.point_data.push_back({name, 1, std::move(values)});
  };
  const auto doubles = [&](const char* name, auto get, int components = 1) {
    MeshDoubles values;
    for (int repeat = 0; repeat < 2; ++repeat)
      for (const JointWrench& joint : joints) {
        if constexpr (std::is_same_v<decltype(get(joint)), double>)
          values.push_back(get(joint));
        else
          append(get(joint), &values);
      }
    mesh.point_data.push_back({name, components, std::move(values)});
  };
  doubles("force_magnitude_N", [](const JointWrench& j) { return j.wrench.force.norm(); });
  mesh.cell_data = mesh.point_data;
  doubles(
      "force_N", [](const JointWrench& j) { return j.wrench.force; }, 3);
  doubles(
      "moment_Nm", [](const JointWrench& j) { return j.wrench.moment; }, 3);
  doubles(
      "normal", [](const JointWrench& j) { return j.patch.plane.normal; }, 3);
  doubles("couple_length_m", [](const JointWrench& j) { return j.axis.couple_length; });
  doubles("eccentricity_m", [](const JointWrench& j) { return j.eccentricity; });
  doubles("kern_use", [](const JointWrench& j) { return j.kern; });
  doubles("friction_use", [](const JointWrench& j) { return j.friction_use; });
  doubles("opening_m", [](const JointWrench& j) { return j.opening; });
  doubles("slip_m", [](const JointWrench& j) { return j.slip; });
  ints("block_a", [](const JointWrench& j) { return j.block_a; });
  ints("block_b", [](const JointWrench& j) { return j.block_b; });
  ints("kind", [](const JointWrench& j) { return static_cast<int>(j.kind); });
  ints("ring", [](const JointWrench& j) { return j.ring; });
  MeshInts tip(static_cast<size_t>(2 * n), 0);
  std::fill(tip.begin() + n, tip.end(), 1);
  mesh.point_data.push_back({"tip", 1, std::move(tip)});
  mesh.field_data = about(e, scale);
  return mesh;
}

Mesh wrenches_mesh(const Evaluation& e) {
  const double scale = common_scale(e);
  Mesh mesh;
  MeshInts block, ring, kind, tip;
  MeshDoubles force, couple, magnitude, couple_length;
  for (size_t b = 0; b < e.assembly.blocks.size(); ++b) {
    const Wrench& w = e.last.from_below[b];
    const CentralAxis axis = central_axis(w);
    if (e.assembly.blocks[b].fixed || !axis.exists) continue;
    const int start = add_point(&mesh, axis.point);
    const int end = add_point(&mesh, axis.point + scale * w.force);
    mesh.add_cell(CellType::polyline, {start, end});
    for (const int at_tip : {0, 1}) {
      tip.push_back(at_tip);
      append(w.force, &force);
      append(axis.couple, &couple);
    }
    block.push_back(static_cast<int>(b));
    ring.push_back(e.assembly.blocks[b].ring);
    kind.push_back(static_cast<int>(e.assembly.blocks[b].kind));
    magnitude.push_back(w.force.norm());
    couple_length.push_back(axis.couple_length);
  }
  mesh.point_data = {
      {"force_N", 3, std::move(force)}, {"couple_Nm", 3, std::move(couple)}, {"tip", 1, std::move(tip)}};
  mesh.cell_data = {{"block", 1, std::move(block)},
                    {"ring", 1, std::move(ring)},
                    {"kind", 1, std::move(kind)},
                    {"resultant_N", 1, std::move(magnitude)},
                    {"couple_length_m", 1, std::move(couple_length)}};
  mesh.field_data = about(e, scale);
  return mesh;
}

}  // namespace cupola

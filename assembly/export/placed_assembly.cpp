#include "assembly/export/placed_assembly.hpp"

#include <map>
#include <utility>

namespace cupola {

namespace {

std::vector<Eigen::Isometry3d> poses_at(const Assembly& assembly, const std::vector<Vec3>& position,
                                        const std::vector<Eigen::Vector4d>& quaternion_wxyz) {
  std::vector<Eigen::Isometry3d> poses;
  for (size_t b = 0; b < position.size(); ++b) {
    const Eigen::Vector4d& q = quaternion_wxyz[b];
    poses.push_back(Eigen::Translation3d(position[b]) * Eigen::Quaterniond(q[0], q[1], q[2], q[3]) *
                    Eigen::Translation3d(-assembly.blocks[b].centroid));
  }
  return poses;
}

}  // namespace

std::vector<Eigen::Isometry3d> poses_of(const Assembly& assembly, const BlockTable& blocks) {
  return poses_at(assembly, blocks.position, blocks.quaternion_wxyz);
}

std::vector<Eigen::Isometry3d> contact_poses_of(const Assembly& assembly, const BlockTable& blocks) {
  return poses_at(assembly, blocks.contact_position, blocks.contact_quaternion_wxyz);
}

std::vector<double> yielded_of(const Assembly& assembly, const TieTable& ties, size_t first) {
  std::vector<double> bars;  // a rod is a bar and a strut
  for (size_t k = 0; k < ties.yielded.size(); ++k)
    if (!ties.strut[k]) bars.push_back(ties.yielded[k]);
  if (bars.size() < first + assembly.ties.size()) return {};
  const auto begin = bars.begin() + static_cast<std::ptrdiff_t>(first);
  return {begin, begin + std::ssize(assembly.ties)};
}

Assembly placed_assembly(const ExportModel& model) {
  const Assembly& built = model.assembly;
  Assembly placed = built;
  if (model.poses.empty()) return placed;
  placed.vertices.clear();
  placed.vertex_layers.clear();
  placed.vertex_depths.clear();
  std::map<std::pair<int, int>, int> own_vertex;  // of a block and a vertex as built
  for (const Part& part : placed.parts)
    for (int i = placed.face_vertex_start[part.face_start];
         i < placed.face_vertex_start[part.face_start + part.num_faces]; ++i) {
      int& vertex = placed.face_vertices[i];
      const auto [known, is_new] =
          own_vertex.try_emplace({part.block, vertex}, static_cast<int>(placed.vertices.size()));
      if (is_new) {
        placed.vertices.push_back(model.placed(part.block, built.vertices[vertex]));
        if (!built.vertex_layers.empty()) {
          placed.vertex_layers.push_back(built.vertex_layers[vertex]);
          placed.vertex_depths.push_back(built.vertex_depths[vertex]);
        }
      }
      vertex = known->second;
    }
  for (size_t i = 0; i < placed.ties.size(); ++i) {
    BuiltTie& tie = placed.ties[i];
    tie.point_a = model.placed(tie.block_a, tie.point_a);
    tie.point_b = model.placed(tie.block_b, tie.point_b);
    if (!model.yielded.empty()) tie.length += model.yielded[i];
  }
  compute_mass_properties(&placed);
  return placed;
}

}  // namespace cupola

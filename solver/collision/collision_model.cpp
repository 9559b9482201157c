#include "solver/collision/collision_model.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

#include <fcl/math/bv/OBB.h>
#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/model/joint_rule.hpp"
#include "solver/collision/open_pieces.hpp"
#include "solver/runtime/threads.hpp"

namespace cupola {
namespace {

void add_face(const Assembly& assembly, int f, const Vec3& origin, int block, CollisionModel* model) {
  CollisionFace face;
  face.id = f;
  face.kind = assembly.face_kinds[f];
  face.corner_start = static_cast<int>(model->corners.size());
  for (int v : assembly.face(f)) model->corners.push_back(assembly.vertices[v] - origin);
  face.num_corners = static_cast<int>(model->corners.size()) - face.corner_start;
  const auto corners = model->face_corners(face);
  if (!(polygon_area(corners) > 0.0))
    throw InputError(fmt::format("block {}: face {} has no area", block, f));
  face.normal = polygon_plane(corners).normal;
  face.centroid = polygon_centroid(corners);
  for (const Vec3& corner : corners) face.radius = std::max(face.radius, (corner - face.centroid).norm());
  model->faces.push_back(face);
}

std::vector<int> vertices_of_part(const Assembly& assembly, const Part& part) {
  std::vector<int> ids;
  for (int f = part.face_start; f < part.face_start + part.num_faces; ++f)
    for (int v : assembly.face(f)) ids.push_back(v);
  std::sort(ids.begin(), ids.end());
  ids.erase(std::unique(ids.begin(), ids.end()), ids.end());
  return ids;
}

/// Each edge once, as the positions of its ends in the sorted vertex ids.
std::vector<std::pair<int, int>> edges_of_part(const Assembly& assembly, const Part& part,
                                               const std::vector<int>& vertex_ids) {
  const auto position = [&](int v) {
    return static_cast<int>(std::lower_bound(vertex_ids.begin(), vertex_ids.end(), v) - vertex_ids.begin());
  };
  std::vector<std::pair<int, int>> edges;
  for (int f = part.face_start; f < part.face_start + part.num_faces; ++f) {
    const auto ids = assembly.face(f);
    for (std::size_t i = 0; i < ids.size(); ++i)
      edges.push_back(std::minmax(position(ids[i]), position(ids[(i + 1) % ids.size()])));
  }
  std::sort(edges.begin(), edges.end());
  edges.erase(std::unique(edges.begin(), edges.end()), edges.end());
  return edges;
}

void add_part(const Assembly& assembly, const Part& part, CollisionModel* model) {
  const Block& block = assembly.blocks[part.block];
  CollisionPart shape;
  shape.block = part.block;
  shape.ring = part.ring;
  shape.fixed = block.fixed;
  shape.face_start = static_cast<int>(model->faces.size());
  for (int f = part.face_start; f < part.face_start + part.num_faces; ++f)
    add_face(assembly, f, block.centroid, part.block, model);
  shape.num_faces = static_cast<int>(model->faces.size()) - shape.face_start;
  shape.vertex_start = static_cast<int>(model->vertices.size());
  const std::vector<int> ids = vertices_of_part(assembly, part);
  shape.num_vertices = static_cast<int>(ids.size());
  double& radius = model->block_radius[part.block];
  for (int v : ids) {
    const Vec3 r = assembly.vertices[v] - block.centroid;
    model->vertices.push_back(r);
    shape.center += r / static_cast<double>(ids.size());
    radius = std::max(radius, r.norm());
  }
  shape.edge_start = static_cast<int>(model->edges.size());
  for (const auto& [i, k] : edges_of_part(assembly, part, ids))
    model->edges.push_back({shape.vertex_start + i, shape.vertex_start + k});
  shape.num_edges = static_cast<int>(model->edges.size()) - shape.edge_start;
  model->parts.push_back(shape);
}

/// Room for all faces, and for the edges and vertices of closed parts whose corners join three edges. Growing
/// arrays would write each number twice.
void reserve(const Assembly& assembly, CollisionModel* model) {
  std::size_t faces = 0, corners = 0;
  for (const Part& part : assembly.parts) {
    faces += part.num_faces;
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f)
      corners += assembly.face(f).size();
  }
  model->faces.reserve(faces);
  model->corners.reserve(corners);
  model->vertices.reserve(corners / 3);
  model->edges.reserve(corners / 2);
  model->parts.reserve(assembly.parts.size());
}

/// Smallest among the enclosing boxes whose axes are the normal and the longest edge of an outer face. Exact
/// for a brick.
OrientedBox smallest_box(const CollisionModel& model, int block) {
  if (model.part_start[block] == model.part_start[block + 1]) return {};
  const CollisionPart& first = model.parts[model.part_start[block]];
  const CollisionPart& last = model.parts[model.part_start[block + 1] - 1];
  OrientedBox best;
  double smallest = std::numeric_limits<double>::infinity();
  for (int f = first.face_start; f < last.face_start + last.num_faces; ++f) {
    const CollisionFace& face = model.faces[f];
    if (face.kind == FaceKind::internal) continue;
    const auto corners = model.face_corners(face);
    Vec3 longest = Vec3::Zero();
    for (std::size_t i = 0; i < corners.size(); ++i) {
      const Vec3 edge = corners[(i + 1) % corners.size()] - corners[i];
      if (edge.squaredNorm() > longest.squaredNorm()) longest = edge;
    }
    Mat3 axes;
    axes.col(0) = face.normal;
    axes.col(1) = (longest - longest.dot(face.normal) * face.normal).normalized();
    axes.col(2) = axes.col(0).cross(axes.col(1));
    Eigen::AlignedBox3d extent;
    for (int k = 0; k < 3; ++k) {  // axis by axis, in registers: half the time of `extend` by points
      const Vec3 axis = axes.col(k);
      double lower = extent.min()[k], upper = extent.max()[k];
      for (int v = first.vertex_start; v < last.vertex_start + last.num_vertices; ++v) {
        const double x = axis.dot(model.vertices[v]);
        lower = std::min(lower, x);
        upper = std::max(upper, x);
      }
      extent.min()[k] = lower;
      extent.max()[k] = upper;
    }
    if (!(extent.volume() < smallest)) continue;
    smallest = extent.volume();
    best = {axes, axes * extent.center(), 0.5 * extent.sizes()};
  }
  return best;
}

}  // namespace

OrientedBox CollisionModel::box_at(int block, const Pose& pose, double padding) const {
  CUPOLA_ASSERT(block >= 0 && block < num_blocks() && padding >= 0.0);
  const Mat3 R_WB = pose.q_WB.toRotationMatrix();
  const OrientedBox& box = block_box[block];
  return {R_WB * box.axes, R_WB * box.center + pose.p_WB, box.half_sizes.array() + padding};
}

CollisionModel make_collision_model(const Assembly& assembly) {
  CollisionModel model;
  reserve(assembly, &model);
  model.block_radius.resize(assembly.blocks.size(), 0.0);
  model.part_start.resize(assembly.blocks.size() + 1, 0);
  for (const Part& part : assembly.parts) {
    CUPOLA_ASSERT(part.block >= 0 && part.block < model.num_blocks());
    CUPOLA_ASSERT(model.parts.empty() || part.block >= model.parts.back().block);
    add_part(assembly, part, &model);
    ++model.part_start[part.block + 1];
  }
  std::partial_sum(model.part_start.begin(), model.part_start.end(), model.part_start.begin());
  find_open_pieces(&model);
  constexpr double kOperationsPerBox = 2000.0;
  model.block_box.resize(assembly.blocks.size());
  share_loop(kOperationsPerBox * model.num_blocks(), model.num_blocks(),
             [&](int block) { model.block_box[block] = smallest_box(model, block); });
  model.faces.shrink_to_fit();
  model.corners.shrink_to_fit();
  model.vertices.shrink_to_fit();
  model.edges.shrink_to_fit();
  model.smallest_block = smallest_block_size(assembly);
  double largest_coordinate = 0.0;
  for (const Vec3& x : assembly.vertices)
    largest_coordinate = std::max(largest_coordinate, x.cwiseAbs().maxCoeff());
  model.rounding = std::numeric_limits<double>::epsilon() * largest_coordinate;
  return model;
}

std::vector<int> collision_groups(const CollisionModel& model) {
  std::vector<int> groups(model.num_blocks());
  std::iota(groups.begin(), groups.end(), 0);
  for (const CollisionPart& part : model.parts)
    if (part.fixed) groups[part.block] = -1;
  return groups;
}

std::vector<Pose> initial_poses(const Assembly& assembly) {
  std::vector<Pose> poses;
  for (const Block& block : assembly.blocks)
    poses.push_back({block.centroid, Eigen::Quaterniond::Identity()});
  return poses;
}

Eigen::AlignedBox3d bounding_box(const OrientedBox& box) {
  const Vec3 half = box.axes.cwiseAbs() * box.half_sizes;
  return {box.center - half, box.center + half};
}

bool overlap(const OrientedBox& a, const OrientedBox& b) {
  return !fcl::obbDisjoint<double>(a.axes.transpose() * b.axes, a.axes.transpose() * (b.center - a.center),
                                   a.half_sizes, b.half_sizes);
}

}  // namespace cupola

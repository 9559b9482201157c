#pragma once

#include <span>
#include <vector>

#include <Eigen/Geometry>

#include "assembly/model/assembly.hpp"
#include "solver/collision/contact_set.hpp"

namespace cupola {

/// Box with arbitrary axes. It encloses a slender, inclined brick much more tightly than an axis-aligned box.
struct OrientedBox {
  Mat3 axes = Mat3::Identity();    ///< columns: unit vectors along its edges
  Vec3 center = Vec3::Zero();      ///< m
  Vec3 half_sizes = Vec3::Zero();  ///< m, along the axes
};

/// Smallest axis-aligned box that contains it.
Eigen::AlignedBox3d bounding_box(const OrientedBox& box);

/// True if two boxes overlap or are so close that rounding leaves the answer open (FCL).
bool overlap(const OrientedBox& a, const OrientedBox& b);

/// Multithreaded loops over blocks: chunk size, small enough to balance the load, and cost per block in
/// floating-point operations. Finding the joints of one block takes some tens of microseconds.
constexpr int kBlocksPerChunk = 64;
constexpr double kOperationsPerBlock = 1e5;

/// Face of a convex part. Coordinates in the axes of its block, relative to the block's centroid.
struct CollisionFace {
  int id = 0;  ///< index of the face in the assembly; pieces follow behind all faces
  FaceKind kind = FaceKind::free;
  Vec3 normal = Vec3::UnitZ();   ///< unit, outward
  Vec3 centroid = Vec3::Zero();  ///< m
  double radius = 0.0;           ///< m, largest distance of a corner from the centroid
  int corner_start = 0;          ///< into CollisionModel::corners
  int num_corners = 0;
  int piece_start = 0;  ///< into CollisionModel::pieces
  int num_pieces = 0;   ///< 0: no other part of the block covers any of it
};

/// Straight edge of a convex part, between two of its vertices.
struct CollisionEdge {
  int start = 0, end = 0;  ///< into CollisionModel::vertices
};

/// Convex part: a range of faces, of vertices and of edges.
struct CollisionPart {
  int block = 0;
  int ring = 0;
  bool fixed = false;
  int face_start = 0;  ///< into CollisionModel::faces
  int num_faces = 0;
  int vertex_start = 0;  ///< into CollisionModel::vertices
  int num_vertices = 0;
  int edge_start = 0;  ///< into CollisionModel::edges
  int num_edges = 0;
  Vec3 center = Vec3::Zero();  ///< m, mean of the vertices, axes of the block
};

/// Geometry of an assembly for contact detection. Each block is stored in its own axes, so that neither
/// motion nor a position far from the origin loses precision.
struct CollisionModel {
  std::vector<CollisionPart> parts;  ///< in the order of the assembly; the parts of a block are contiguous
  std::vector<CollisionFace> faces;
  std::vector<CollisionFace> pieces;  ///< of faces that other parts of their block cover in part
  std::vector<Vec3> corners;          ///< m, of the faces, counter-clockwise seen from outside
  std::vector<CollisionEdge> edges;
  std::vector<Vec3> vertices;          ///< m, of the parts, each stored once
  std::vector<int> part_start;         ///< first part of each block, then the end (num_blocks + 1)
  std::vector<double> block_radius;    ///< m, largest distance of a vertex from the centroid
  std::vector<OrientedBox> block_box;  ///< around all parts of the block, in its axes
  double smallest_block = 0.0;         ///< m, cube root of the smallest volume of a free block
  double rounding = 0.0;               ///< m, rounding error of the assembly's coordinates

  std::span<const Vec3> face_corners(const CollisionFace& face) const {
    return {corners.data() + face.corner_start, static_cast<std::size_t>(face.num_corners)};
  }
  /// What other parts of the block leave open of a face that is not internal: convex pieces, or the face.
  std::span<const CollisionFace> open_pieces(const CollisionFace& face) const {
    if (face.num_pieces == 0) return {&face, 1};
    return {pieces.data() + face.piece_start, static_cast<std::size_t>(face.num_pieces)};
  }
  std::span<const CollisionFace> faces_of(const CollisionPart& part) const {
    return {faces.data() + part.face_start, static_cast<std::size_t>(part.num_faces)};
  }
  std::span<const Vec3> vertices_of(const CollisionPart& part) const {
    return {vertices.data() + part.vertex_start, static_cast<std::size_t>(part.num_vertices)};
  }
  int num_blocks() const { return static_cast<int>(block_radius.size()); }
  /// The box of a block at a pose, enlarged by `padding` (m) on all sides. Two blocks whose boxes do not
  /// overlap are farther apart than the sum of their paddings.
  OrientedBox box_at(int block, const Pose& pose, double padding) const;
  std::span<const CollisionEdge> edges_of(const CollisionPart& part) const {
    return {edges.data() + part.edge_start, static_cast<std::size_t>(part.num_edges)};
  }
};

/// Throws InputError with block and face when a face has no area.
CollisionModel make_collision_model(const Assembly& assembly);

/// Group of each block for the broad phase, which never pairs blocks of one group. All fixed blocks form one
/// group; every free block is a group of its own.
std::vector<int> collision_groups(const CollisionModel& model);

/// Poses of all blocks in the assembly as generated.
std::vector<Pose> initial_poses(const Assembly& assembly);

}  // namespace cupola

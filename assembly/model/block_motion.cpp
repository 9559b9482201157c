#include "assembly/model/block_motion.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/Geometry>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

/// Motion of a rigid body: the point x, as built, is displaced by shift + turn (x - center).
struct Motion {
  Mat3 turn = Mat3::Zero();
  Vec3 shift = Vec3::Zero();
  Vec3 center = Vec3::Zero();

  Vec3 of(const Vec3& x) const { return shift + turn * (x - center); }

  /// What is left of this motion less a part of another.
  Motion without(const Motion& other, double part) const {
    return {turn - part * other.turn, shift - part * other.of(center), center};
  }
};

Motion motion_of(const Block& block, const Vec3& displacement, const Eigen::Vector4d& q) {
  return {Eigen::Quaterniond(q[0], q[1], q[2], q[3]).normalized().toRotationMatrix() - Mat3::Identity(),
          displacement, block.centroid};
}

/// Calls visit(vertex) with the vertices of consecutive parts, those of several faces more than once.
template <class Visit>
void for_each_vertex(const Assembly& assembly, std::span<const Part> parts, const Visit& visit) {
  const Part &first = parts.front(), &last = parts.back();
  for (int f = first.face_start; f < last.face_start + last.num_faces; ++f)
    for (const int vertex : assembly.face(f)) visit(assembly.vertices[vertex]);
}

/// The part of `followed`, between none and all, that fits the own motion of the vertices best.
double part_followed(const Assembly& assembly, std::span<const Part> parts, const Motion& own,
                     const Motion& followed) {
  double along = 0.0, square = 0.0;
  for_each_vertex(assembly, parts, [&](const Vec3& x) {
    const Vec3 u = followed.of(x);
    along += u.dot(own.of(x));
    square += u.squaredNorm();
  });
  return square > 0.0 ? std::clamp(along / square, 0.0, 1.0) : 0.0;
}

/// The largest distance by which a motion displaces the vertices.
double farthest_way(const Assembly& assembly, std::span<const Part> parts, const Motion& motion) {
  double farthest = 0.0;
  for_each_vertex(assembly, parts,
                  [&](const Vec3& x) { farthest = std::max(farthest, motion.of(x).squaredNorm()); });
  return std::sqrt(farthest);
}

/// Those of supports that have moved, supports that were only shifted by the same way once.
std::vector<Motion> moves_of_supports(const Assembly& assembly, std::span<const Vec3> displacement,
                                      std::span<const Eigen::Vector4d> quaternion_wxyz) {
  constexpr double kSlight = 1e-6;  // of the size of a support: rounding of the motion of the ground
  std::vector<Motion> moves;
  for (size_t b = 0; b < assembly.blocks.size(); ++b) {
    const Block& block = assembly.blocks[b];
    if (!block.fixed) continue;
    const Motion move = motion_of(block, displacement[b], quaternion_wxyz[b]);
    const double size = std::cbrt(block.volume);
    if (move.shift.norm() + size * move.turn.norm() <= kSlight * size) continue;
    const auto is_same = [&move](const Motion& other) {
      return move.turn.isZero(0.0) && other.turn.isZero(0.0) && other.shift == move.shift;
    };
    if (std::none_of(moves.begin(), moves.end(), is_same)) moves.push_back(move);
  }
  return moves;
}

}  // namespace

std::vector<double> distances_moved(const Assembly& assembly, std::span<const Vec3> displacement,
                                    std::span<const Eigen::Vector4d> quaternion_wxyz) {
  CUPOLA_ASSERT(displacement.size() == assembly.blocks.size() &&
                quaternion_wxyz.size() == assembly.blocks.size());
  const std::vector<Motion> moves = moves_of_supports(assembly, displacement, quaternion_wxyz);
  std::vector<double> distances(assembly.blocks.size(), 0.0);
  for (auto first = assembly.parts.begin(); first != assembly.parts.end();) {
    const int b = first->block;
    const auto last = std::find_if(first, assembly.parts.end(), [b](const Part& p) { return p.block != b; });
    if (!assembly.blocks[b].fixed) {
      const std::span<const Part> parts{first, last};
      const Motion own = motion_of(assembly.blocks[b], displacement[b], quaternion_wxyz[b]);
      distances[b] = farthest_way(assembly, parts, own);
      for (const Motion& move : moves) {
        const Motion left = own.without(move, part_followed(assembly, parts, own, move));
        distances[b] = std::min(distances[b], farthest_way(assembly, parts, left));
      }
    }
    first = last;
  }
  return distances;
}

}  // namespace cupola

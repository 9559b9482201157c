#include "solver/analysis/motion/farthest_point.hpp"

#include <algorithm>
#include <span>

namespace cupola {
namespace {

std::span<const Vec3> vertices_of(const CollisionModel& shapes, int block) {
  const CollisionPart &first = shapes.parts[shapes.part_start[block]],
                      &last = shapes.parts[shapes.part_start[block + 1] - 1];
  return {shapes.vertices.data() + first.vertex_start, shapes.vertices_of(last).data() + last.num_vertices};
}

/// The largest |way + turn r| of the vertices r of a block, but at least `known`.
double largest(const CollisionModel& shapes, int block, const Vec3& way, const Mat3& turn, double known) {
  if (way.norm() + shapes.block_radius[block] * turn.norm() <= known) return known;
  for (const Vec3& r : vertices_of(shapes, block)) known = std::max(known, (way + turn * r).norm());
  return known;
}

}  // namespace

double fastest_point(const CollisionModel& shapes, const Model& model, const State& state) {
  double speed = 0.0;
  for (int i = 0; i < model.num_free(); ++i) {
    const int block = model.free_blocks[i];
    const Vec3 omega = state.v.segment<3>(6 * i + 3);
    Mat3 turn = state.poses[block].q_WB.toRotationMatrix();
    for (int k = 0; k < 3; ++k) turn.col(k) = omega.cross(Vec3(turn.col(k)));
    speed = largest(shapes, block, state.v.segment<3>(6 * i), turn, speed);
  }
  return speed;
}

double farthest_point(const CollisionModel& shapes, const Model& model, const std::vector<Pose>& from,
                      const std::vector<Pose>& to) {
  double distance = 0.0;
  for (const int block : model.free_blocks) {
    const Pose &a = from[block], &b = to[block];
    distance = largest(shapes, block, b.p_WB - a.p_WB, b.q_WB.toRotationMatrix() - a.q_WB.toRotationMatrix(),
                       distance);
  }
  return distance;
}

}  // namespace cupola

#include "solver/collision/perturbed_gjk.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

#include <fmt/format.h>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

/// SplitMix64 (Steele, Lea and Flood 2014), which gives the same numbers on every machine.
class Random {
 public:
  explicit Random(std::uint64_t seed) : state_(seed) {}
  std::uint64_t next() {
    std::uint64_t z = (state_ += 0x9e3779b97f4a7c15u);
    z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9u;
    z = (z ^ (z >> 27)) * 0x94d049bb133111ebu;
    return z ^ (z >> 31);
  }
  double uniform() { return static_cast<double>(next() >> 11) * 0x1.0p-53; }  ///< in [0, 1)

 private:
  std::uint64_t state_;
};

/// Rotation by at most `angle` (rad) about a random axis through `center`.
Eigen::Isometry3d small_turn(Random* random, double angle, const Vec3& center) {
  const double z = 2.0 * random->uniform() - 1.0;
  const double azimuth = 2.0 * std::numbers::pi * random->uniform();
  const double radius = std::sqrt(1.0 - z * z);
  const Vec3 axis(radius * std::cos(azimuth), radius * std::sin(azimuth), z);
  Eigen::Isometry3d turn = Eigen::Isometry3d::Identity();
  turn.translate(center);
  turn.rotate(Eigen::AngleAxisd(angle * random->uniform(), axis));
  turn.translate(-center);
  return turn;
}

ConvexBody make_core(const CollisionModel& model, const CollisionPart& part, double margin) {
  std::vector<Plane> planes;
  for (const CollisionFace& face : model.faces_of(part)) {
    const bool known = std::ranges::any_of(
        planes, [&](const Plane& plane) { return plane.normal.dot(face.normal) > 1.0 - 1e-12; });
    if (!known) planes.push_back({face.normal, face.normal.dot(face.centroid)});
  }
  const Polytope core = inset_polytope(planes, margin, 1e-9 * model.smallest_block + 16.0 * model.rounding);
  if (core.vertices.empty())
    throw InputError(
        fmt::format("block {}: a part is thinner than twice contact.margin = {} m; reduce the margin",
                    part.block, margin));
  return ConvexBody(core);
}

/// The face of a part whose outward normal is closest to the direction.
const CollisionFace& face_along(const CollisionModel& model, const CollisionPart& part,
                                const Vec3& direction) {
  const auto faces = model.faces_of(part);
  return *std::max_element(faces.begin(), faces.end(), [&](const CollisionFace& p, const CollisionFace& q) {
    return p.normal.dot(direction) < q.normal.dot(direction);
  });
}

double hull_area(const std::vector<Vec2>& points) {
  std::vector<Vec2> hull;
  for (int i : convex_hull(points, 0.0)) hull.push_back(points[i]);
  return hull.size() < 3 ? 0.0 : polygon_area(hull);
}

struct Query {
  LiftedPoint point;
  Vec3 normal = Vec3::UnitZ();
};

}  // namespace

PerturbedGjk::PerturbedGjk(const CollisionModel& model, const PerturbedGjkOptions& options)
    : options_(options) {
  if (options_.margin == 0.0) options_.margin = 0.01 * model.smallest_block;
  for (const CollisionPart& part : model.parts) cores_.push_back(make_core(model, part, options_.margin));
}

std::optional<JointPatch> PerturbedGjk::find(const CollisionModel& model, int part_a, int part_b,
                                             const Eigen::Isometry3d& pose_ab, double reach) const {
  const CollisionPart& shape_a = model.parts[part_a];
  const CollisionPart& shape_b = model.parts[part_b];
  Random random(options_.seed * 0x9e3779b97f4a7c15u + (static_cast<std::uint64_t>(part_a) << 32) +
                static_cast<std::uint64_t>(part_b));
  std::vector<Query> queries;
  for (int i = 0; i <= options_.perturbations; ++i) {
    const Eigen::Isometry3d turn = i == 0 ? Eigen::Isometry3d::Identity()
                                          : small_turn(&random, options_.angle, pose_ab * shape_b.center);
    const auto nearest = cores_[part_a].nearest_points(cores_[part_b], turn * pose_ab);
    if (!nearest) continue;
    const double distance = (nearest->on_b - nearest->on_a).norm();
    Query query;
    query.normal = (nearest->on_b - nearest->on_a) / distance;
    query.point.on_a = nearest->on_a + options_.margin * query.normal;
    query.point.on_b = turn.inverse(Eigen::Isometry) * nearest->on_b - options_.margin * query.normal;
    query.point.gap = (query.point.on_b - query.point.on_a).dot(query.normal);
    if (i == 0 && query.point.gap > 0.5 * options_.margin + reach) return std::nullopt;
    queries.push_back(query);
  }
  if (queries.empty()) return std::nullopt;

  JointPatch patch;
  patch.part_a = part_a;
  patch.part_b = part_b;
  patch.origin = queries[0].point.on_a;
  patch.set_normal(queries[0].normal);
  const CollisionFace& face_a = face_along(model, shape_a, patch.normal);
  const CollisionFace& face_b = face_along(model, shape_b, -(pose_ab.linear().transpose() * patch.normal));
  if (face_a.kind == FaceKind::internal || face_b.kind == FaceKind::internal) return std::nullopt;
  classify(shape_a, face_a.kind, shape_b, face_b.kind, &patch);

  std::vector<Vec2> positions;
  for (const Query& query : queries) positions.push_back(patch.project(query.point.on_a));
  std::vector<Vec2> kept;
  patch.min_gap = std::numeric_limits<double>::infinity();
  for (int i : largest_patch(positions, options_.keep, options_.margin)) {
    patch.corners.push_back({positions[i], {queries[i].normal, 0.5}});
    patch.touching.push_back(queries[i].point);
    patch.min_gap = std::min(patch.min_gap, queries[i].point.gap);
    kept.push_back(positions[i]);
  }
  patch.point_area = hull_area(kept) / static_cast<double>(kept.size());
  return patch;
}

std::vector<int> largest_patch(std::span<const Vec2> points, int keep, double tolerance) {
  std::vector<int> chosen;
  const auto near_chosen = [&](int i) {
    return std::ranges::any_of(chosen, [&](int k) { return (points[k] - points[i]).norm() <= tolerance; });
  };
  const auto gain = [&](int i) {
    if (chosen.size() == 1) return (points[chosen[0]] - points[i]).norm();
    std::vector<Vec2> polygon;
    for (int k : chosen) polygon.push_back(points[k]);
    polygon.push_back(points[i]);
    return hull_area(polygon);
  };
  int first = 0;  // one of the two points farthest apart
  double farthest = -1.0;
  for (std::size_t i = 0; i < points.size(); ++i)
    for (std::size_t k = i + 1; k < points.size(); ++k)
      if ((points[i] - points[k]).norm() > farthest) {
        farthest = (points[i] - points[k]).norm();
        first = static_cast<int>(i);
      }
  if (!points.empty()) chosen.push_back(first);
  while (static_cast<int>(chosen.size()) < keep) {
    int best = -1;
    double best_gain = 0.0;
    for (int i = 0; i < static_cast<int>(points.size()); ++i) {
      if (near_chosen(i)) continue;
      const double gained = gain(i);
      if (best < 0 || gained > best_gain) {
        best = i;
        best_gain = gained;
      }
    }
    if (best < 0) break;
    chosen.push_back(best);
  }
  return chosen;
}

}  // namespace cupola

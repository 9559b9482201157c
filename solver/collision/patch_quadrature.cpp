#include "solver/collision/patch_quadrature.hpp"

#include <array>
#include <map>
#include <utility>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

bool is_parallelogram(std::span<const Vec2> polygon) {
  if (polygon.size() != 4) return false;
  const Vec2 diagonal_mismatch = polygon[0] + polygon[2] - polygon[1] - polygon[3];
  const double size = (polygon[2] - polygon[0]).norm() + (polygon[3] - polygon[1]).norm();
  // The error of the rule is proportional to the mismatch. 1e-9 allows for rounding far from the origin.
  return diagonal_mismatch.norm() <= 1e-9 * size;
}

std::vector<PatchPoint> corners_with_area(std::span<const Vec2> polygon, double area) {
  std::vector<PatchPoint> points;
  for (std::size_t i = 0; i < polygon.size(); ++i) points.push_back({polygon[i], area, static_cast<int>(i)});
  return points;
}

/// Nodes of a subdivided polygon, by integer coordinates. The corners of the polygon come first.
class Nodes {
 public:
  using Key = std::array<int, 3>;
  Nodes(std::span<const Vec2> corners, const std::vector<Key>& keys)
      : points_(corners_with_area(corners, 0.0)) {
    for (std::size_t i = 0; i < keys.size(); ++i) index_.emplace(keys[i], i);
  }
  void add(const Key& key, const Vec2& position, double area) {
    const auto [at, is_new] = index_.emplace(key, points_.size());
    if (is_new) points_.push_back({position, 0.0, --last_});
    points_[at->second].area += area;
  }
  std::vector<PatchPoint> take() { return std::move(points_); }

 private:
  std::vector<PatchPoint> points_;
  std::map<Key, std::size_t> index_;
  int last_ = 0;  // number of the last inner point
};

/// The rule of the parallelogram on n x n parallelograms.
std::vector<PatchPoint> divided_parallelogram(std::span<const Vec2> polygon, int n) {
  const Vec2 along = polygon[1] - polygon[0], up = polygon[3] - polygon[0];
  const double area = polygon_area(polygon) / (n * n);
  const auto at = [&](double i, double j) { return Vec2(polygon[0] + i / n * along + j / n * up); };
  Nodes nodes(polygon, {{0, 0, 0}, {n, 0, 0}, {n, n, 0}, {0, n, 0}});
  for (int i = 0; i < n; ++i)
    for (int j = 0; j < n; ++j) {
      for (const auto& [a, b] : {std::pair(i, j), {i + 1, j}, {i + 1, j + 1}, {i, j + 1}})
        nodes.add({a, b, 0}, at(a, b), area / 12.0);
      nodes.add({i, j, 1}, n == 1 ? polygon_centroid(polygon) : at(i + 0.5, j + 0.5), area / 1.5);
    }
  return nodes.take();
}

/// Adds the triangle rule on the n x n similar triangles of a triangle. key(a, b): of the node at
/// ((n - a - b) t[0] + a t[1] + b t[2]) / n. `centroid`: of the whole triangle.
template <class KeyOf>
void add_triangle(const Vec2 (&t)[3], const Vec2& centroid, int n, int number, const KeyOf& key,
                  Nodes* nodes) {
  const double area = polygon_area(t) / (n * n);
  const auto at = [&](int a, int b) {
    return Vec2(t[0] + static_cast<double>(a) / n * (t[1] - t[0]) +
                static_cast<double>(b) / n * (t[2] - t[0]));
  };
  int small = 0;
  const auto add = [&](std::array<std::pair<int, int>, 3> corners) {
    Vec2 sum = Vec2::Zero();
    for (const auto& [a, b] : corners) {
      nodes->add(key(a, b), at(a, b), area / 12.0);
      sum += at(a, b);
    }
    nodes->add({-2 - number, small++, 0}, n == 1 ? centroid : Vec2(sum / 3.0), 0.75 * area);
  };
  for (int a = 0; a < n; ++a)
    for (int b = 0; a + b < n; ++b) {
      add({{{a, b}, {a + 1, b}, {a, b + 1}}});
      if (a + b + 1 < n) add({{{a + 1, b}, {a, b + 1}, {a + 1, b + 1}}});
    }
}

/// The triangles between the centroid and each edge, each divided. Nodes on a line from the centroid to a
/// corner belong to two triangles.
std::vector<PatchPoint> divided_fan(std::span<const Vec2> polygon, int n) {
  const int sides = static_cast<int>(polygon.size());
  std::vector<Nodes::Key> corners;
  for (int i = 0; i < sides; ++i) corners.push_back({i, n, 0});
  Nodes nodes(polygon, corners);
  const Vec2 centroid = polygon_centroid(polygon);
  for (int i = 0; i < sides; ++i) {
    const int next = (i + 1) % sides;
    const auto key = [&](int a, int b) -> Nodes::Key {
      if (a == 0 && b == 0) return {-1, 0, 0};
      if (b == 0) return {i, a, 0};
      return a == 0 ? Nodes::Key{next, b, 0} : Nodes::Key{i, a, b};
    };
    const Vec2 t[] = {centroid, polygon[i], polygon[next]};
    add_triangle(t, (t[0] + t[1] + t[2]) / 3.0, n, i, key, &nodes);
  }
  return nodes.take();
}

std::vector<PatchPoint> divided_triangle(std::span<const Vec2> polygon, int n) {
  Nodes nodes(polygon, {{0, 0, 0}, {n, 0, 0}, {0, n, 0}});
  const Vec2 t[] = {polygon[0], polygon[1], polygon[2]};
  add_triangle(
      t, polygon_centroid(polygon), n, 0,
      [](int a, int b) {
        return Nodes::Key{a, b, 0};
      },
      &nodes);
  return nodes.take();
}

}  // namespace

std::vector<PatchPoint> corner_points(std::span<const Vec2> polygon) {
  return corners_with_area(polygon, polygon_area(polygon) / static_cast<double>(polygon.size()));
}

std::vector<PatchPoint> quadrature_points(std::span<const Vec2> polygon, int subdivide) {
  CUPOLA_ASSERT(polygon.size() >= 3 && subdivide >= 1);
  if (polygon.size() == 3) return divided_triangle(polygon, subdivide);
  return is_parallelogram(polygon) ? divided_parallelogram(polygon, subdivide)
                                   : divided_fan(polygon, subdivide);
}

std::vector<PatchPoint> patch_points(std::span<const Vec2> polygon, const PatchSampling& sampling) {
  return sampling.points == PatchPoints::corners ? corner_points(polygon)
                                                 : quadrature_points(polygon, sampling.subdivide);
}

}  // namespace cupola

#include <cmath>
#include <numbers>
#include <set>

#include <gtest/gtest.h>

#include "solver/collision/convex_polygon.hpp"
#include "solver/collision/patch_quadrature.hpp"

namespace cupola::polygon_test {
namespace {

constexpr double kTolerance = 1e-10;  // m, corners nearer than this are merged

std::vector<Vec2> box(double x0, double y0, double x1, double y1) {
  return {{x0, y0}, {x1, y0}, {x1, y1}, {x0, y1}};
}

std::vector<Vec2> regular_polygon(int n, double radius, double phase = 0.0) {
  std::vector<Vec2> polygon;
  for (int i = 0; i < n; ++i) {
    const double angle = phase + 2.0 * std::numbers::pi * i / n;
    polygon.emplace_back(radius * std::cos(angle), radius * std::sin(angle));
  }
  return polygon;
}

std::vector<Vec2> positions(const std::vector<ClipCorner>& corners) {
  std::vector<Vec2> xs;
  for (const ClipCorner& c : corners) xs.push_back(c.position);
  return xs;
}

std::vector<Vec2> overlap(const std::vector<Vec2>& a, const std::vector<Vec2>& b) {
  return positions(clip_convex_polygon(a, b, kTolerance));
}

TEST(ClipConvexPolygon, OverlapOfTwoRectangles) {
  const auto polygon = overlap(box(0, 0, 2, 1), box(1.5, -1, 3, 0.25));
  ASSERT_EQ(polygon.size(), 4u);
  EXPECT_DOUBLE_EQ(polygon_area(polygon), 0.5 * 0.25);
}

TEST(ClipConvexPolygon, EqualPolygonsGiveThatPolygon) {
  for (int n : {3, 4, 5, 8}) {
    const auto polygon = regular_polygon(n, 1.0, 0.3);
    EXPECT_EQ(overlap(polygon, polygon), polygon);
  }
}

TEST(ClipConvexPolygon, RoundingErrorsMakeNoSlivers) {
  std::vector<Vec2> perturbed = box(0, 0, 1, 1);
  for (std::size_t i = 0; i < perturbed.size(); ++i)
    perturbed[i] += 1e-14 * Vec2(i % 2 ? 1 : -1, i % 3 ? -1 : 1);
  const auto polygon = overlap(box(0, 0, 1, 1), perturbed);
  EXPECT_EQ(polygon.size(), 4u);
  EXPECT_NEAR(polygon_area(polygon), 1.0, 1e-12);  // perturbation 1e-14 along four sides of length 1
}

TEST(ClipConvexPolygon, SmallRotationsAddNoCorners) {
  // If the unit square turns by `angle` about its centre, each side crosses the fixed one near its middle,
  // between angle^2 / 4 and angle / 4 from the chord. The overlap has eight corners, or the four of one
  // square.
  std::vector<Vec2> turned = box(-0.5, -0.5, 0.5, 0.5);
  const double angle = 1e-4;
  for (Vec2& x : turned) x = Vec2(x.x() - angle * x.y(), x.y() + angle * x.x());
  const auto square = box(-0.5, -0.5, 0.5, 0.5);
  EXPECT_EQ(clip_convex_polygon(square, turned, kTolerance).size(), 8u);
  const auto flattened = clip_convex_polygon(square, turned, kTolerance, 1e-3);
  EXPECT_EQ(flattened.size(), 4u);
  EXPECT_NEAR(polygon_area(positions(flattened)), 1.0, 2.0 * angle);
  // Corners of a single polygon are kept, however flat.
  EXPECT_EQ(clip_convex_polygon(regular_polygon(64, 1.0), box(-2, -2, 2, 2), kTolerance, 0.1).size(), 64u);
}

TEST(ClipConvexPolygon, PolygonInsideTheOther) {
  EXPECT_EQ(overlap(box(1, 1, 2, 2), box(0, 0, 3, 3)), box(1, 1, 2, 2));
  EXPECT_DOUBLE_EQ(polygon_area(overlap(box(0, 0, 3, 3), box(1, 1, 2, 2))), 1.0);
}

TEST(ClipConvexPolygon, CollinearCornersAreRemoved) {
  const std::vector<Vec2> with_middle = {{0, 0}, {0.5, 0}, {1, 0}, {1, 1}, {0, 1}};
  EXPECT_EQ(overlap(with_middle, box(-1, -1, 2, 2)).size(), 4u);
}

TEST(ClipConvexPolygon, IsEmptyWhenApartOrTouching) {
  EXPECT_TRUE(overlap(box(0, 0, 1, 1), box(2, 0, 3, 1)).empty());
  for (const double offset : {-1e-9, 0.0}) {  // along an edge, at a corner
    EXPECT_TRUE(overlap(box(0, 0, 1, 1), box(1 - offset, 0, 2, 1)).empty());
    EXPECT_TRUE(overlap(box(0, 0, 1, 1), box(1 - offset, 1 - offset, 2, 2)).empty());
  }
  EXPECT_NEAR(polygon_area(overlap(box(0, 0, 1, 1), box(1 - 1e-6, 0, 2, 1))), 1e-6, 1e-15);
}

// Area of the overlap of two regular polygons from grid points that satisfy all half-plane inequalities:
// slow, but independent of clipping.
TEST(ClipConvexPolygon, AgreesWithSampledArea) {
  const auto a = regular_polygon(5, 1.0, 0.1);
  const auto b = regular_polygon(7, 0.8, 0.4);
  const auto inside = [](const std::vector<Vec2>& polygon, const Vec2& x) {
    for (std::size_t i = 0; i < polygon.size(); ++i) {
      const Vec2 e = polygon[(i + 1) % polygon.size()] - polygon[i];
      const Vec2 r = x - polygon[i];
      if (e.x() * r.y() - e.y() * r.x() < 0) return false;
    }
    return true;
  };
  const Vec2 shift(0.6, 0.3);
  std::vector<Vec2> moved;
  for (const Vec2& x : b) moved.push_back(x + shift);
  const int n = 1000;
  const double cell = 2.0 / n;
  int hits = 0;
  for (int i = 0; i < n; ++i)
    for (int k = 0; k < n; ++k) {
      const Vec2 x(-1 + (i + 0.5) * cell, -1 + (k + 0.5) * cell);
      hits += inside(a, x) && inside(moved, x);
    }
  // The boundary, about 4 long, cuts about 4 / cell cells. Each adds an error of half a cell of random sign.
  EXPECT_NEAR(polygon_area(overlap(a, moved)), hits * cell * cell, 5 * cell * cell * std::sqrt(4 / cell));
}

TEST(ClipConvexPolygon, LabelsIdentifyTheEdgesAtEachCorner) {
  const auto corners = clip_convex_polygon(box(0, 0, 2, 2), box(1, 1, 3, 3), kTolerance);
  ASSERT_EQ(corners.size(), 4u);
  for (const ClipCorner& c : corners) {
    if (c.position.isApprox(Vec2(2, 2))) {
      EXPECT_EQ(c.edge_in, 1);  // right side of the subject
      EXPECT_EQ(c.edge_out, 2);
    } else if (c.position.isApprox(Vec2(1, 1))) {
      EXPECT_EQ(c.edge_in, 4 + 3);  // left side of the clip polygon
      EXPECT_EQ(c.edge_out, 4 + 0);
    } else {
      EXPECT_NE(c.edge_in < 4, c.edge_out < 4);  // crossing of one edge of each
    }
  }
}

TEST(ConvexHull, OmitsInnerRepeatedAndCollinearPoints) {
  const std::vector<Vec2> points = {{1, 1}, {0, 0}, {2, 0},     {1, 0}, {2, 2},
                                    {0, 2}, {2, 2}, {0.5, 0.7}, {0, 1}};
  std::vector<Vec2> hull;
  for (int i : convex_hull(points, kTolerance)) hull.push_back(points[i]);
  EXPECT_EQ(hull.size(), 4u);
  EXPECT_DOUBLE_EQ(polygon_area(hull), 4.0);
}

TEST(ConvexHull, OfCollinearPointsIsEmpty) {
  const std::vector<Vec2> points = {{0, 0}, {1, 1}, {2, 2}, {3, 3}};
  EXPECT_TRUE(convex_hull(points, kTolerance).empty());
}

TEST(PolygonWidth, OfRectangleAndTriangle) {
  EXPECT_DOUBLE_EQ(polygon_width(box(0, 0, 3, 0.5)), 0.5);
  EXPECT_NEAR(polygon_width(regular_polygon(3, 1.0)), 1.5, 1e-15);  // its height
}

/// Moments of a polygon up to second order, from the closed formula over its edges. Independent of the
/// triangles of the quadrature.
Eigen::Matrix3d exact_moments(const std::vector<Vec2>& p) {
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (std::size_t i = 0; i < p.size(); ++i) {
    const Vec2& a = p[i];
    const Vec2& b = p[(i + 1) % p.size()];
    const double cross = a.x() * b.y() - a.y() * b.x();
    const Eigen::Vector3d A(a.x(), a.y(), 0), B(b.x(), b.y(), 0);
    const Eigen::Vector3d S = A + B;
    moments += cross / 24.0 * (S * S.transpose() + A * A.transpose() + B * B.transpose());
    moments.col(2) += cross / 6.0 * S;
    moments.row(2) += cross / 6.0 * S.transpose();
    moments(2, 2) += cross / 2.0;
  }
  return moments;
}

Eigen::Matrix3d summed_moments(const std::vector<PatchPoint>& points) {
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  for (const PatchPoint& p : points) {
    const Eigen::Vector3d X(p.position.x(), p.position.y(), 1.0);
    moments += p.area * X * X.transpose();
  }
  return moments;
}

TEST(PatchQuadrature, IsExactForSecondMoments) {
  const std::vector<std::vector<Vec2>> polygons = {
      {{0, 0}, {2, 0.1}, {0.3, 1}},          // triangle
      box(1, 2, 3, 2.5),                     // rectangle
      {{0, 0}, {2, 0}, {2.5, 1}, {0.5, 1}},  // parallelogram
      {{0, 0}, {4, 0}, {3, 1}, {1, 1}},      // trapezoid
      {{0, 0}, {4, -1}, {5, 3}, {1, 1}},     // general quadrilateral
      regular_polygon(5, 2.0, 0.2),
      regular_polygon(8, 0.5, 0.7)};
  for (const int subdivide : {1, 2, 5})
    for (const auto& polygon : polygons) {
      const auto points = quadrature_points(polygon, subdivide);
      const Eigen::Matrix3d exact = exact_moments(polygon);
      // Rounding errors of sums over at most some hundred points.
      EXPECT_LT((summed_moments(points) - exact).norm(), 1e-13 * exact.norm())
          << polygon.size() << " corners";
      for (const PatchPoint& p : points) EXPECT_GT(p.area, 0.0);
    }
}

// Points of neighbouring pieces that coincide are one point, and the corners keep their numbers.
TEST(PatchQuadrature, DividedPatchesShareTheirPoints) {
  const auto check = [](const std::vector<Vec2>& polygon, int subdivide, std::size_t count) {
    const auto points = quadrature_points(polygon, subdivide);
    EXPECT_EQ(points.size(), count);
    std::set<int> numbers;
    for (std::size_t i = 0; i < points.size(); ++i) {
      numbers.insert(points[i].corner);
      if (i < polygon.size()) {
        EXPECT_EQ(points[i].position, polygon[i]);
        EXPECT_EQ(points[i].corner, static_cast<int>(i));
      }
      for (std::size_t k = 0; k < i; ++k) EXPECT_GT((points[i].position - points[k].position).norm(), 1e-3);
    }
    EXPECT_EQ(numbers.size(), points.size());
  };
  check(box(0, 0, 2, 1), 3, 16 + 9);                       // nodes of a 4 x 4 grid and 9 centres
  check(regular_polygon(3, 1.0), 3, 10 + 9);               // 10 nodes and 9 triangles
  check({{0, 0}, {4, 0}, {3, 1}, {1, 1}}, 2, 13 + 4 * 4);  // 1 + 4 + 4 + 4 nodes and 4 triangles each
}

TEST(PatchQuadrature, HasTheDocumentedNumberOfPoints) {
  EXPECT_EQ(quadrature_points(regular_polygon(3, 1.0)).size(), 4u);
  EXPECT_EQ(quadrature_points(box(0, 0, 2, 1)).size(), 5u);
  EXPECT_EQ(corner_points(box(0, 0, 2, 1)).size(), 4u);
}

TEST(PatchQuadrature, HasTheDocumentedWeightsOnASquare) {
  for (const PatchPoint& p : quadrature_points(box(0, 0, 1, 1)))
    EXPECT_NEAR(p.area, p.corner < 0 ? 2.0 / 3.0 : 1.0 / 12.0, 1e-15);
}

}  // namespace
}  // namespace cupola::polygon_test

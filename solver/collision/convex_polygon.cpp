#include "solver/collision/convex_polygon.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace cupola {
namespace {

/// Positive when b points to the left of a.
double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Clips a polygon to the left side of the line from p to q. `edge` is the label of that line; `heights` and
/// `kept` are memory that all lines use.
void clip_by_line(std::vector<ClipCorner>* polygon, const Vec2& p, const Vec2& q, int edge, double tolerance,
                  std::vector<double>* heights, std::vector<ClipCorner>* kept) {
  const double length = (q - p).norm();
  if (length <= tolerance) return;
  const Vec2 direction = (q - p) / length;
  const auto inside = [&](double height) { return height >= -tolerance; };
  heights->clear();
  for (const ClipCorner& c : *polygon) heights->push_back(cross(direction, c.position - p));
  if (std::ranges::all_of(*heights, inside)) return;
  kept->clear();
  for (std::size_t i = 0; i < polygon->size(); ++i) {
    const std::size_t next = (i + 1) % polygon->size();
    const ClipCorner& start = (*polygon)[i];
    const double start_height = (*heights)[i], end_height = (*heights)[next];
    const bool start_inside = inside(start_height);
    if (start_inside) kept->push_back(start);
    if (start_inside == inside(end_height)) continue;
    const double fraction = std::clamp(start_height / (start_height - end_height), 0.0, 1.0);
    const Vec2 crossing = start.position + fraction * ((*polygon)[next].position - start.position);
    kept->push_back({crossing, 0, start_inside ? edge : start.edge_out});
  }
  polygon->swap(*kept);
}

/// Removes redundant corners, then sets `edge_in` of the others.
void simplify(std::vector<ClipCorner>* polygon, double tolerance) {
  std::vector<Vec2> positions;
  positions.reserve(polygon->size());
  for (const ClipCorner& corner : *polygon) positions.push_back(corner.position);
  std::vector<ClipCorner> kept;
  for (int i : essential_corners(positions, tolerance)) kept.push_back((*polygon)[i]);
  for (std::size_t i = 0; i < kept.size(); ++i)
    kept[i].edge_in = kept[(i + kept.size() - 1) % kept.size()].edge_out;
  *polygon = std::move(kept);
}

/// Distance of corner i from the chord of its neighbours.
double height_over_chord(const std::vector<ClipCorner>& polygon, std::size_t i) {
  const std::size_t n = polygon.size();
  const Vec2& previous = polygon[(i + n - 1) % n].position;
  const Vec2 chord = polygon[(i + 1) % n].position - previous;
  return std::abs(cross(chord, polygon[i].position - previous)) / chord.norm();
}

/// Removes crossings of a subject edge with a clip edge that lie within `height` of the chord of their
/// neighbours, flattest first. The edge labels of the other corners do not change.
void drop_flat_crossings(std::vector<ClipCorner>* polygon, int num_subject, double height) {
  while (polygon->size() > 3) {
    std::size_t flattest = polygon->size();
    double smallest = height;
    for (std::size_t i = 0; i < polygon->size(); ++i) {
      const ClipCorner& corner = (*polygon)[i];
      if ((corner.edge_in < num_subject) == (corner.edge_out < num_subject)) continue;
      const double here = height_over_chord(*polygon, i);
      if (here >= smallest) continue;
      smallest = here;
      flattest = i;
    }
    if (flattest == polygon->size()) return;
    polygon->erase(polygon->begin() + static_cast<std::ptrdiff_t>(flattest));
  }
}

}  // namespace

std::vector<ClipCorner> clip_convex_polygon(std::span<const Vec2> subject, std::span<const Vec2> clip,
                                            double tolerance, double crossing_height) {
  std::vector<ClipCorner> polygon;
  polygon.reserve(subject.size() + clip.size());
  for (std::size_t i = 0; i < subject.size(); ++i) polygon.push_back({subject[i], 0, static_cast<int>(i)});
  const int num_subject = static_cast<int>(subject.size());
  std::vector<double> heights;
  std::vector<ClipCorner> kept;
  for (std::size_t i = 0; i < clip.size() && !polygon.empty(); ++i)
    clip_by_line(&polygon, clip[i], clip[(i + 1) % clip.size()], num_subject + static_cast<int>(i), tolerance,
                 &heights, &kept);
  simplify(&polygon, tolerance);
  drop_flat_crossings(&polygon, num_subject, crossing_height);
  return polygon;
}

std::vector<int> essential_corners(std::span<const Vec2> polygon, double tolerance) {
  std::vector<int> kept(polygon.size());
  std::iota(kept.begin(), kept.end(), 0);
  for (std::size_t i = 0; i < kept.size() && kept.size() >= 3;) {
    const std::size_t n = kept.size();
    const Vec2& previous = polygon[kept[(i + n - 1) % n]];
    const Vec2& here = polygon[kept[i]];
    const Vec2& next = polygon[kept[(i + 1) % n]];
    const Vec2 chord = next - previous;
    const bool repeated = (next - here).norm() <= tolerance;
    const bool straight = std::abs(cross(chord, here - previous)) <= tolerance * chord.norm();
    if (repeated || straight) {
      kept.erase(kept.begin() + static_cast<std::ptrdiff_t>(i));
      i = i > 0 ? i - 1 : 0;  // the previous corner may be collinear now
    } else {
      ++i;
    }
  }
  if (kept.size() < 3) kept.clear();
  return kept;
}

std::vector<int> convex_hull(std::span<const Vec2> points, double tolerance) {
  std::vector<int> order(points.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(), [&](int i, int k) {
    return std::pair(points[i].x(), points[i].y()) < std::pair(points[k].x(), points[k].y());
  });
  // Andrew's monotone chain: lower side from left to right, upper side from right to left.
  std::vector<int> hull;
  const auto add_side = [&](auto first, auto last) {
    const std::size_t start = hull.size();
    for (auto it = first; it != last; ++it) {
      while (hull.size() >= start + 2 && cross(points[hull.back()] - points[hull[hull.size() - 2]],
                                               points[*it] - points[hull.back()]) <= 0.0)
        hull.pop_back();
      hull.push_back(*it);
    }
    if (!hull.empty()) hull.pop_back();
  };
  add_side(order.begin(), order.end());
  add_side(order.rbegin(), order.rend());
  std::vector<Vec2> outline;
  for (int i : hull) outline.push_back(points[i]);
  std::vector<int> corners;
  for (int i : essential_corners(outline, tolerance)) corners.push_back(hull[i]);
  return corners;
}

double polygon_area(std::span<const Vec2> polygon) {
  double twice = 0.0;
  for (std::size_t i = 2; i < polygon.size(); ++i)
    twice += cross(polygon[i - 1] - polygon[0], polygon[i] - polygon[0]);
  return 0.5 * twice;
}

Vec2 polygon_centroid(std::span<const Vec2> polygon) {
  Vec2 first_moment = Vec2::Zero();
  double twice_area = 0.0;
  for (std::size_t i = 2; i < polygon.size(); ++i) {
    const Vec2 a = polygon[i - 1] - polygon[0];
    const Vec2 b = polygon[i] - polygon[0];
    twice_area += cross(a, b);
    first_moment += cross(a, b) / 3.0 * (a + b);
  }
  if (twice_area == 0.0) return polygon[0];
  return polygon[0] + first_moment / twice_area;
}

double polygon_width(std::span<const Vec2> polygon) {
  // One border of the narrowest strip contains an edge.
  double width = std::numeric_limits<double>::infinity();
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const Vec2 edge = polygon[(i + 1) % polygon.size()] - polygon[i];
    const double length = edge.norm();
    if (length == 0.0) continue;
    double height = 0.0;
    for (const Vec2& corner : polygon)
      height = std::max(height, std::abs(cross(edge, corner - polygon[i])) / length);
    width = std::min(width, height);
  }
  return polygon.size() < 3 ? 0.0 : width;
}

}  // namespace cupola

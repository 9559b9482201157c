#include "solver/collision/polygon_clipping.hpp"

#include <algorithm>
#include <limits>

namespace cupola {
namespace {

/// Positive when b lies to the left of a.
double cross(const Vec2& a, const Vec2& b) {
  return a.x() * b.y() - a.y() * b.x();
}

/// Keeps what lies to the left of the line from p to q. `edge` is the label of that line.
std::vector<ClipCorner> clip_by_line(const std::vector<ClipCorner>& polygon, const Vec2& p, const Vec2& q,
                                     int edge, double tolerance) {
  std::vector<ClipCorner> kept;
  const double length = (q - p).norm();
  if (length <= tolerance) return polygon;
  const Vec2 direction = (q - p) / length;
  const auto height = [&](const ClipCorner& c) { return cross(direction, c.position - p); };
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    const ClipCorner& start = polygon[i];
    const ClipCorner& end = polygon[(i + 1) % polygon.size()];
    const double start_height = height(start);
    const double end_height = height(end);
    const bool start_inside = start_height >= -tolerance;
    const bool end_inside = end_height >= -tolerance;
    if (start_inside) kept.push_back(start);
    if (start_inside == end_inside) continue;
    const double fraction = std::clamp(start_height / (start_height - end_height), 0.0, 1.0);
    const Vec2 crossing = start.position + fraction * (end.position - start.position);
    kept.push_back({crossing, 0, start_inside ? edge : start.edge_out});
  }
  return kept;
}

/// Drops corners that coincide with the next one or lie on the chord of their neighbours, then tells each
/// corner which edge ends there.
void simplify(std::vector<ClipCorner>* polygon, double tolerance) {
  for (std::size_t i = 0; i < polygon->size() && polygon->size() >= 3;) {
    const std::size_t n = polygon->size();
    const Vec2& previous = (*polygon)[(i + n - 1) % n].position;
    const Vec2& here = (*polygon)[i].position;
    const Vec2& next = (*polygon)[(i + 1) % n].position;
    const Vec2 chord = next - previous;
    const bool repeated = (next - here).norm() <= tolerance;
    const bool straight = std::abs(cross(chord, here - previous)) <= tolerance * chord.norm();
    if (repeated || straight) {
      polygon->erase(polygon->begin() + static_cast<std::ptrdiff_t>(i));
      i = i > 0 ? i - 1 : 0;  // the neighbour before may lie straight now
    } else {
      ++i;
    }
  }
  if (polygon->size() < 3) polygon->clear();
  for (std::size_t i = 0; i < polygon->size(); ++i)
    (*polygon)[i].edge_in = (*polygon)[(i + polygon->size() - 1) % polygon->size()].edge_out;
}

}  // namespace

std::vector<ClipCorner> clip_convex_polygon(std::span<const Vec2> subject, std::span<const Vec2> clip,
                                            double tolerance) {
  std::vector<ClipCorner> polygon;
  polygon.reserve(subject.size() + clip.size());
  for (std::size_t i = 0; i < subject.size(); ++i) polygon.push_back({subject[i], 0, static_cast<int>(i)});
  const int num_subject = static_cast<int>(subject.size());
  for (std::size_t i = 0; i < clip.size() && !polygon.empty(); ++i)
    polygon = clip_by_line(polygon, clip[i], clip[(i + 1) % clip.size()], num_subject + static_cast<int>(i),
                           tolerance);
  simplify(&polygon, tolerance);
  return polygon;
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
  // The narrowest strip has one of the edges on its border.
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

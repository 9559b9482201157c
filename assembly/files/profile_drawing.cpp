#include "assembly/files/profile_drawing.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <fmt/format.h>
#include <pugixml.hpp>
#include <svgpp/parser/path_data.hpp>
#include <svgpp/parser/transform_list.hpp>
#include <svgpp/policy/error.hpp>

#include "assembly/base/error.hpp"
#include "assembly/files/atomic_file.hpp"

namespace cupola {
namespace {

using Vec2 = Eigen::Vector2d;
constexpr double kPi = std::numbers::pi;

/// From one point to the next: a line, an arc of signed radius (positive to the left), or a cubic curve.
struct Stroke {
  Vec2 from, to;
  double radius = 0.0;
  std::optional<CurveControls> curve;

  Vec2 at(double t) const {
    const double s = 1.0 - t;
    if (curve)
      return s * s * s * from + 3.0 * s * s * t * curve->first + 3.0 * s * t * t * curve->second +
             t * t * t * to;
    const Vec2 chord = to - from;
    if (radius == 0.0) return from + t * chord;
    const double half = 0.5 * chord.norm(), turn = 2.0 * std::asin(std::min(half / std::abs(radius), 1.0));
    const Vec2 left = Vec2(-chord.y(), chord.x()) / (2.0 * half);
    const double sign = radius > 0.0 ? 1.0 : -1.0;
    const Vec2 centre =
        0.5 * (from + to) + sign * std::sqrt(std::max(radius * radius - half * half, 0.0)) * left;
    return centre + Eigen::Rotation2Dd(sign * turn * t) * (from - centre);
  }
  Stroke part(double a, double b) const {
    if (!curve) return {at(a), at(b), radius, {}};
    const auto derivative = [&](double t) -> Vec2 {
      const double s = 1.0 - t;
      return 3.0 * (s * s * (curve->first - from) + 2.0 * s * t * (curve->second - curve->first) +
                    t * t * (to - curve->second));
    };
    const double third = (b - a) / 3.0;
    return {at(a), at(b), 0.0, CurveControls{at(a) + third * derivative(a), at(b) - third * derivative(b)}};
  }
  Stroke reversed() const {
    Stroke back{to, from, -radius, curve};
    if (curve) back.curve = CurveControls{curve->second, curve->first};
    return back;
  }
  Stroke mapped(const Eigen::Affine2d& map) const {  // a similarity, but for curves
    const double size = std::sqrt(std::abs(map.linear().determinant()));
    Stroke out{map * from, map * to, radius * size * (map.linear().determinant() < 0.0 ? -1.0 : 1.0), curve};
    if (curve) out.curve = CurveControls{map * curve->first, map * curve->second};
    return out;
  }
};

/// Collects the strokes of one path in its own coordinates; the names are those that SVG++ calls.
class PathReader {
 public:
  std::vector<Stroke> strokes;
  bool is_closed = false, is_broken = false;
  bool arcs_as_curves = false;  ///< for maps that make ellipses of circles

  template <class Absolute>
  void path_move_to(double x, double y, Absolute) {
    is_broken = is_broken || !strokes.empty();
    last_ = {x, y};
  }
  template <class Absolute>
  void path_line_to(double x, double y, Absolute) {
    add({last_, {x, y}, 0.0, {}});
  }
  template <class Absolute>
  void path_cubic_bezier_to(double x1, double y1, double x2, double y2, double x, double y, Absolute) {
    add({last_, {x, y}, 0.0, CurveControls{{x1, y1}, {x2, y2}}});
  }
  /// SVG 1.1, appendix F.6.5 and F.6.6: centre, start angle and turn from the end points.
  template <class Absolute>
  void path_elliptical_arc_to(double rx, double ry, double rotation_deg, bool large, bool sweep, double x,
                              double y, Absolute) {
    const Vec2 end(x, y);
    rx = std::abs(rx);
    ry = std::abs(ry);
    if (rx == 0.0 || ry == 0.0) return add({last_, end, 0.0, {}});
    const Eigen::Rotation2Dd turned(rotation_deg * kPi / 180.0);
    const Vec2 half = turned.inverse() * (0.5 * (last_ - end));
    const double beyond = std::hypot(half.x() / rx, half.y() / ry);
    if (beyond > 1.0) {
      rx *= beyond;
      ry *= beyond;
    }
    const Vec2 scaled(half.x() / rx, half.y() / ry);  // the chord in the unit circle
    const double distance =
        std::sqrt(std::max(1.0 / scaled.squaredNorm() - 1.0, 0.0)) * (large == sweep ? -1.0 : 1.0);
    const Vec2 centre = distance * Vec2(scaled.y(), -scaled.x());
    const Vec2 a = scaled - centre, b = -scaled - centre;
    const double from = std::atan2(a.y(), a.x());
    double turn = std::atan2(b.y(), b.x()) - from;
    if (sweep && turn < 0.0) turn += 2.0 * kPi;
    if (!sweep && turn > 0.0) turn -= 2.0 * kPi;
    const Vec2 middle = 0.5 * (last_ + end) + turned * Vec2(rx * centre.x(), ry * centre.y());
    const bool is_circle = !arcs_as_curves && std::abs(rx - ry) <= 1e-9 * rx;
    const double most = is_circle ? 0.9 * kPi : kPi / 16.0;
    const int n = static_cast<int>(std::ceil(std::abs(turn) / most));
    const auto on_ellipse = [&](double angle, double along) -> Vec2 {  // the point, moved along the tangent
      const Vec2 p(std::cos(angle) - along * std::sin(angle), std::sin(angle) + along * std::cos(angle));
      return middle + turned * Vec2(rx * p.x(), ry * p.y());
    };
    const double step = turn / n, reach = 4.0 / 3.0 * std::tan(step / 4.0);
    for (int i = 0; i < n; ++i) {
      const double start = from + i * step, stop = start + step;
      Stroke stroke{last_, i + 1 < n ? on_ellipse(stop, 0.0) : end, step > 0.0 ? rx : -rx, {}};
      if (!is_circle) {
        stroke.radius = 0.0;
        stroke.curve = CurveControls{on_ellipse(start, reach), on_ellipse(stop, -reach)};
      }
      add(stroke);
    }
  }
  void path_close_subpath() { is_closed = true; }
  void path_exit() {}

 private:
  void add(const Stroke& stroke) {
    if (stroke.from != stroke.to || stroke.curve) strokes.push_back(stroke);
    last_ = stroke.to;
  }
  Vec2 last_ = Vec2::Zero();
};

struct AbsolutePath : svgpp::policy::path::minimal {
  static const bool arc_as_cubic_bezier = false;
};

struct TransformReader {
  Eigen::Affine2d map = Eigen::Affine2d::Identity();
  void transform_matrix(const boost::array<double, 6>& m) {
    Eigen::Affine2d next = Eigen::Affine2d::Identity();
    next.matrix().topRows<2>() << m[0], m[2], m[4], m[1], m[3], m[5];
    map = map * next;
  }
};

/// Errors of one file.
class Drawing {
 public:
  explicit Drawing(const std::string& path) : path_(path), text_(read_text(path)) {
    const pugi::xml_parse_result result = document_.load_buffer(text_.data(), text_.size());
    if (!result) fail(result.offset, fmt::format("no SVG drawing: {}", result.description()));
  }

  std::vector<Stroke> strokes() const {
    const pugi::xpath_node_set paths =
        document_.select_nodes("//*[local-name()='path' and not(ancestor::*[local-name()='defs'])]");
    if (paths.size() != 1)
      fail(0, fmt::format(
                  "has {} paths; expected one, the line of the section (Inkscape: Path > Object to Path)",
                  paths.size()));
    const pugi::xml_node node = paths.first().node();
    const Eigen::Affine2d map = map_of(node);
    const Eigen::Matrix2d square = map.linear().transpose() * map.linear();
    PathReader reader;
    reader.arcs_as_curves =
        (square - 0.5 * square.trace() * Eigen::Matrix2d::Identity()).norm() > 1e-9 * square.norm();
    const std::string data = node.attribute("d").value();
    try {
      svgpp::value_parser<svgpp::tag::type::path_data, svgpp::path_policy<AbsolutePath>>::parse(
          svgpp::tag::attribute::d(), reader, data, svgpp::tag::source::attribute());
    } catch (const std::exception&) {
      fail(node.offset_debug(), "its path cannot be read");
    }
    if (reader.is_closed)
      fail(node.offset_debug(),
           "its path is closed: draw the line from springing to crown, without the rest of the outline");
    if (reader.is_broken) fail(node.offset_debug(), "its path has several lines: draw the section in one");
    if (reader.strokes.empty()) fail(node.offset_debug(), "its path is empty");
    std::vector<Stroke> strokes;
    for (const Stroke& stroke : reader.strokes) strokes.push_back(stroke.mapped(map));
    return strokes;
  }

  [[noreturn]] void fail(std::ptrdiff_t offset, const std::string& message) const {
    const auto end = text_.begin() + std::clamp<std::ptrdiff_t>(offset, 0, std::ssize(text_));
    throw InputError({path_, 1 + static_cast<int>(std::count(text_.begin(), end, '\n')), 1}, message);
  }

 private:
  /// To coordinates whose second one points upwards.
  Eigen::Affine2d map_of(pugi::xml_node node) const {
    Eigen::Affine2d map = Eigen::Affine2d::Identity();
    for (; node; node = node.parent()) {
      const std::string text = node.attribute("transform").value();
      if (text.empty()) continue;
      TransformReader reader;
      try {
        svgpp::value_parser<svgpp::tag::type::transform_list>::parse(
            svgpp::tag::attribute::transform(), reader, text, svgpp::tag::source::attribute());
      } catch (const std::exception&) {
        fail(node.offset_debug(), fmt::format("the transform {} cannot be read", text));
      }
      map = reader.map * map;
    }
    return Eigen::Scaling(1.0, -1.0) * map;
  }

  std::string path_, text_;
  pugi::xml_document document_;
};

/// The strokes up to the plane x = axis, which they approach from the right.
std::vector<Stroke> up_to_axis(const std::vector<Stroke>& strokes, double axis) {
  constexpr double kRounding = 1e-9;  // of half the width
  const double near = axis + kRounding * (strokes.front().from.x() - axis);
  std::vector<Stroke> out;
  for (const Stroke& stroke : strokes) {
    if (stroke.to.x() > near) {
      out.push_back(stroke);
      continue;
    }
    if (stroke.to.x() >= axis) {
      out.push_back(stroke);
      break;
    }
    double low = 0.0, high = 1.0;
    for (int i = 0; i < 60; ++i) {
      const double middle = 0.5 * (low + high);
      (stroke.at(middle).x() > axis ? low : high) = middle;
    }
    out.push_back(high > 1.0 - kRounding ? stroke : stroke.part(0.0, high));
    break;
  }
  return out;
}

/// Largest distance of the points of some strokes from others.
double farthest(const std::vector<Stroke>& strokes, const std::vector<Stroke>& others) {
  constexpr int kSamples = 64;
  double most = 0.0;
  for (const Stroke& stroke : strokes)
    for (int i = 0; i <= kSamples; ++i) {
      const Vec2 p = stroke.at(static_cast<double>(i) / kSamples);
      double nearest = std::numeric_limits<double>::infinity();
      for (const Stroke& other : others)
        for (int j = 0; j < kSamples; ++j) {
          const Vec2 a = other.at(static_cast<double>(j) / kSamples),
                     along = other.at((j + 1.0) / kSamples) - a;
          const double t = std::clamp((p - a).dot(along) / along.squaredNorm(), 0.0, 1.0);
          nearest = std::min(nearest, (p - a - t * along).norm());
        }
      most = std::max(most, nearest);
    }
  return most;
}

std::vector<Stroke> reversed(std::vector<Stroke> strokes) {
  std::ranges::reverse(strokes);
  for (Stroke& stroke : strokes) stroke = stroke.reversed();
  return strokes;
}

std::vector<Stroke> mapped(std::vector<Stroke> strokes, const Eigen::Affine2d& map) {
  for (Stroke& stroke : strokes) stroke = stroke.mapped(map);
  return strokes;
}

double highest_of(const std::vector<Stroke>& strokes) {
  constexpr int kSamples = 64;
  double highest = -std::numeric_limits<double>::infinity();
  for (const Stroke& stroke : strokes)
    for (int i = 0; i <= kSamples; ++i)
      highest = std::max(highest, stroke.at(static_cast<double>(i) / kSamples).y());
  return highest;
}

/// The half on the right of the axis x = 0, from the springing at z = 0 to the crown.
std::vector<Stroke> half_section(std::vector<Stroke> strokes, const Drawing& drawing) {
  if (strokes.back().to.y() < strokes.front().from.y()) strokes = reversed(std::move(strokes));
  const Vec2 foot = strokes.front().from, head = strokes.back().to;
  constexpr double kLevel = 1e-3, kEqual = 2e-3;  // of the width, as drawn by hand with snapping off
  const Vec2 middle = 0.5 * (foot + head);
  const bool whole = std::abs(head.y() - foot.y()) < kLevel * std::abs(head.x() - foot.x());
  const Vec2 origin(whole ? middle.x() : head.x(), foot.y());
  strokes = mapped(std::move(strokes), Eigen::Affine2d(Eigen::Translation2d(-origin)));
  const Eigen::Affine2d mirror(Eigen::Scaling(-1.0, 1.0));
  if (strokes.front().from.x() < 0.0) strokes = mapped(std::move(strokes), mirror);
  if (!whole) {
    const double width = std::abs(head.x() - foot.x()), highest = highest_of(strokes);
    if (highest > head.y() - foot.y() + kEqual * width)
      drawing.fail(0, fmt::format("it ends {:.2g} of its width below its highest point, as an arch between "
                                  "springings at two heights: give that as a `chain` of points from x > 0 to "
                                  "x < 0; a half section ends at the crown",
                                  (highest - head.y() + foot.y()) / width));
    return strokes;
  }
  const std::vector<Stroke> right = up_to_axis(strokes, 0.0),
                            left = up_to_axis(mapped(reversed(strokes), mirror), 0.0);
  const double width = std::abs(head.x() - foot.x()), most = farthest(left, right);
  if (most > kEqual * width)
    drawing.fail(
        0, fmt::format("its halves differ by {:.2g} of the width; draw one half, from springing to crown",
                       most / width));
  return right;
}

}  // namespace

bool is_drawing(const std::string& path) {
  return path.ends_with(".svg") || path.ends_with(".SVG");
}

ProfileTable read_profile_drawing(const std::string& path, double span) {
  const Drawing drawing(path);
  const std::vector<Stroke> half = half_section(drawing.strokes(), drawing);
  ProfileTable table;
  for (const Stroke& stroke : half) {
    table.r.push_back(stroke.from.x());
    table.z.push_back(stroke.from.y());
    table.radius.push_back(stroke.radius);
    table.curves.push_back(stroke.curve);
  }
  if (!(table.r.front() > 0.0))
    drawing.fail(0, "its path begins on the axis, below its end: the span would be 0");
  table.r.push_back(0.0);
  table.z.push_back(half.back().to.y());
  table.radius.push_back(0.0);
  scale_to_span(span, &table);
  return table;
}

}  // namespace cupola

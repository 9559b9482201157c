#include "generators/surface/drawings.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <optional>

#include <fmt/format.h>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

using std::numbers::pi;
constexpr double kRadians = pi / 180.0;

/// The arc of a dome or vault, from the springing to the crown angle.
ProfilePiece arc_to_crown(double R, double e, double crown_angle_deg) {
  if (R * std::cos(crown_angle_deg * kRadians) <= e)
    throw InputError(fmt::format(
        "geometry.surface.crown_angle_deg = {}: the intrados meets the axis at {:.6g} deg; choose a "
        "smaller angle",
        crown_angle_deg, std::acos(e / R) / kRadians));
  return arc_piece({-e, 0.0}, R, 0.0, crown_angle_deg * kRadians);
}

Plan circle_plan() {
  Plan plan;
  plan.kind = Plan::Kind::circle;
  return plan;
}

Plan polygon_plan(int sides) {
  Plan plan;
  plan.kind = Plan::Kind::polygon;
  plan.sides = sides;
  return plan;
}

Plan line_plan(double length, Plan::Axis axis) {
  Plan plan;
  plan.kind = Plan::Kind::line;
  plan.length = length;
  plan.axis = axis;
  return plan;
}

/// Least radius of curvature of the drawn line where it turns inwards, m; infinity without one.
double least_radius(const ProfilePiece& piece) {
  double least = std::numeric_limits<double>::infinity();
  constexpr double kStep = 1e-4;
  for (int i = 0; i <= 200; ++i) {
    const double t = i / 200.0;
    const Vec2 d = piece.derivative(t), change = piece.derivative(t + kStep) - piece.derivative(t - kStep);
    const double turn = (d.x() * change.y() - d.y() * change.x()) / (2.0 * kStep);
    if (turn > 0.0) least = std::min(least, std::pow(d.norm(), 3) / turn);
  }
  return least;
}

/// The part of a profile outside the eye, whose edge becomes the last bed. A horseshoe may begin inside.
std::vector<ProfilePiece> outside_eye(std::vector<ProfilePiece> pieces, double eye, double rounding) {
  constexpr int kSteps = 200;
  double widest = 0.0;
  for (size_t i = 0; i < pieces.size(); ++i) {
    std::optional<double> outside;  // the first place
    for (int k = 0; k < kSteps; ++k) {
      const double t = k / static_cast<double>(kSteps), r = pieces[i].at(t).x();
      widest = std::max(widest, r);
      if (r > eye && !outside) outside = t;
    }
    if (!outside || pieces[i].at(1.0).x() > eye + rounding) continue;
    double low = *outside, high = 1.0;
    for (int k = 0; k < 60; ++k) {  // to rounding
      const double middle = 0.5 * (low + high);
      (pieces[i].at(middle).x() > eye ? low : high) = middle;
    }
    pieces.resize(i + 1);
    pieces[i] = piece_up_to(pieces[i], high);
    return pieces;
  }
  const double end = pieces.back().at(1.0).x();
  std::string reason = fmt::format("must be below {:.6g} m, the largest r of the profile", widest);
  if (widest <= end + rounding)
    reason = fmt::format(
        "the profile is nowhere wider than at its end, r = {:.10g} m; leave out `eye` and key_stone", end);
  else if (widest > eye)
    reason = fmt::format(
        "the profile ends at r = {:.10g} m, outside the eye; give that r, or draw the profile up to the eye",
        end);
  throw InputError(fmt::format("geometry.surface.eye = {}: {}", eye, reason));
}

/// The part of a profile above the last place where `is_above` does not hold; empty if that is its end. A
/// horseshoe may be above at its springing, too.
template <class Test>
std::vector<ProfilePiece> part_above(std::vector<ProfilePiece> pieces, const Test& is_above) {
  constexpr int kSteps = 200;
  for (size_t i = pieces.size(); i-- > 0;)
    for (int k = kSteps; k >= 0; --k) {
      double low = k / static_cast<double>(kSteps), high = std::min(1.0, low + 1.0 / kSteps);
      if (is_above(pieces[i], low)) continue;
      for (int n = 0; n < 60; ++n) {  // to rounding
        const double middle = 0.5 * (low + high);
        (is_above(pieces[i], middle) ? high : low) = middle;
      }
      pieces.erase(pieces.begin(), pieces.begin() + static_cast<std::ptrdiff_t>(k == kSteps ? i + 1 : i));
      if (k < kSteps) pieces.front() = piece_from(pieces.front(), high);
      return pieces;
    }
  return pieces;
}

/// Draws one web of a groin vault, from its first bed over the crown to the last. A bed at the half-width r
/// is (s / 2 - r) cot(pi / n) long, s the side.
void draw_web(const VaultSurface& vault, double rounding, Drawing* drawing) {
  const Plan& plan = vault.plan;
  const Vec2 crown = drawing->profile.back().at(1.0);
  if (std::abs(crown.x()) > rounding)
    throw InputError(fmt::format(
        "geometry.surface.profile: ends {:.6g} m from the axis; the webs of a groin vault meet at "
        "a crown, where r = 0",
        crown.x()));
  const double half_side = 0.5 * vault.profile.width(), slope = 1.0 / std::tan(pi / plan.sides);
  const double to_back = vault.thickness - drawing->drawn_depth;  // m, from the drawn line
  const auto is_above = [&](const ProfilePiece& piece, double t) {
    const Vec2 p = piece.at(t), d = piece.derivative(t);
    if (plan.from_height) return p.y() >= *plan.from_height;
    return (half_side - p.x() - to_back * d.y() / d.norm()) * slope >= 0.5 * vault.thickness;
  };
  const auto has_length = [&](const ProfilePiece& piece, double t) {  // on the intrados
    const Vec2 d = piece.derivative(t);
    return half_side - piece.at(t).x() + drawing->drawn_depth * d.y() / d.norm() > rounding;
  };
  const std::vector<ProfilePiece> long_part = part_above(drawing->profile, has_length);
  drawing->profile = part_above(std::move(drawing->profile), is_above);
  if (drawing->profile.empty())
    throw InputError(
        plan.from_height
            ? fmt::format("geometry.surface.plan.from_height = {}: must be below the crown, {:.6g} m above "
                          "the springing",
                          *plan.from_height, crown.y())
            : "geometry.surface.plan: the shell is so thick that no bed reaches the extrados; give "
              "from_height");
  if (plan.from_height && !has_length(drawing->profile.front(), 0.0))
    throw InputError(fmt::format(
        "geometry.surface.plan.from_height = {}: must be above {:.3g} m, up to where a web has no length",
        *plan.from_height, long_part.front().at(0.0).y()));
  drawing->plan.length = half_side * slope;
  drawing->mirrored = true;
  drawing->profile = with_mirror_image(std::move(drawing->profile));
}

/// Throws where the shell would fold over itself.
void check_curvature(const std::vector<ProfilePiece>& pieces, const VaultSurface& vault, double inside) {
  for (const ProfilePiece& piece : pieces) {
    const double radius = least_radius(piece);
    if (inside >= radius)
      throw InputError(fmt::format(
          "geometry.surface.thickness = {}: the profile from ({:.6g}, {:.6g}) to ({:.6g}, {:.6g}) m has a "
          "radius of {:.3g} m, so that the intrados, {:.3g} m inside the drawn line, would fold",
          vault.thickness, piece.at(0.0).x(), piece.at(0.0).y(), piece.at(1.0).x(), piece.at(1.0).y(), radius,
          inside));
  }
}

/// Two arcs that meet smoothly: the haunch of radius r, and the crown.
std::vector<ProfilePiece> basket(double a, double h, double r) {
  if (r >= h || r >= a)
    throw InputError(fmt::format(
        "geometry.surface.profile.haunch_radius = {}: must be below the rise and half the span", r));
  const double k = ((a - r) * (a - r) - (h - r) * (h - r)) / (2.0 * (h - r));
  const double R = h + k, meet = std::atan2(k, a - r);
  if (k <= 0.0)
    throw InputError(
        fmt::format("geometry.surface.profile.rise = {}: a basket arch rises less than half its span", h));
  return {arc_piece({a - r, 0.0}, r, 0.0, meet), arc_piece({0.0, -k}, R, meet, pi / 2)};
}

/// z = rise - c (cosh(r / c) - 1) with the c that meets the springing.
ProfilePiece catenary(double a, double h) {
  double low = 1e-3 * a, high = low;
  const auto rise = [&](double c) { return c * (std::cosh(a / c) - 1.0); };
  while (rise(high) > h) high *= 2.0;
  while (rise(low) < h) low *= 0.5;
  for (int i = 0; i < 200 && low < high; ++i) {
    const double middle = 0.5 * (low + high);
    if (middle == low || middle == high) break;
    (rise(middle) > h ? low : high) = middle;
  }
  const double c = high;
  // By its length s from the crown, r = c asinh(s / c), so that courses are equal.
  const double length = c * std::sinh(a / c);
  return smooth_piece(
      [=](double t) -> Vec2 {
        const double s = length * (1.0 - t);
        return {c * std::asinh(s / c), h - (std::hypot(c, s) - c)};
      },
      [=](double t) -> Vec2 {
        const double s = length * (1.0 - t), q = std::hypot(c, s);
        return {-length * c / q, length * s / q};
      });
}

/// Throws where a chain crosses itself: two of its chords that are not neighbours meet.
void check_crossings(const std::vector<double>& r, const std::vector<double>& z) {
  const auto point = [&](size_t i) { return Vec2(r[i], z[i]); };
  for (size_t i = 0; i + 1 < r.size(); ++i)
    for (size_t j = i + 2; j + 1 < r.size(); ++j) {
      const Vec2 a = point(i), along = point(i + 1) - a, b = point(j), other = point(j + 1) - b;
      const double sine = cross(along, other);
      if (sine == 0.0) continue;
      const double s = cross(b - a, other) / sine, t = cross(b - a, along) / sine;
      if (s < 0.0 || s > 1.0 || t < 0.0 || t > 1.0) continue;
      const Vec2 meet = a + s * along;
      throw InputError(
          fmt::format("geometry.surface.profile: crosses itself at ({:.6g}, {:.6g}) m, between the points {} "
                      "and {} and the points {} and {}, counted from 0",
                      meet.x(), meet.y(), i, i + 1, j, j + 1));
    }
}

/// A cubic curve from a to b.
ProfilePiece cubic_piece(const Vec2& a, const CurveControls& inner, const Vec2& b) {
  const Vec2 c = inner.first, d = inner.second;
  return smooth_piece(
      [=](double t) -> Vec2 {
        const double s = 1.0 - t;
        return s * s * s * a + 3.0 * s * s * t * c + 3.0 * s * t * t * d + t * t * t * b;
      },
      [=](double t) -> Vec2 {
        const double s = 1.0 - t;
        return 3.0 * (s * s * (c - a) + 2.0 * s * t * (d - c) + t * t * (b - d));
      });
}

std::vector<ProfilePiece> polyline(const ProfileTable& points) {
  const auto& [r, z, radius, curves] = points;
  if (r.back() > r.front() && z.back() < z.front())
    throw InputError(
        fmt::format("geometry.surface.profile: ends at ({:.6g}, {:.6g}) m, lower and farther from the axis "
                    "than it begins, at ({:.6g}, {:.6g}) m: give its points from the springing upwards",
                    r.back(), z.back(), r.front(), z.front()));
  check_crossings(r, z);
  std::vector<ProfilePiece> pieces;
  for (size_t i = 0; i + 1 < r.size(); ++i) {
    const Vec2 a(r[i], z[i]), b(r[i + 1], z[i + 1]);
    const double R = i < radius.size() ? radius[i] : 0.0, half = 0.5 * (b - a).norm();
    if (half == 0.0)
      throw InputError(
          fmt::format("geometry.surface.profile: points {} and {} at ({:.6g}, {:.6g}) m coincide", i, i + 1,
                      a.x(), a.y()));
    if (i < curves.size() && curves[i]) {
      pieces.push_back(cubic_piece(a, *curves[i], b));
      continue;
    }
    if (R == 0.0) {
      pieces.push_back(line_piece(a, b));
      continue;
    }
    if (std::abs(R) < half)
      throw InputError(
          fmt::format("geometry.surface.profile.radius[{}] = {}: must be at least half the distance of its "
                      "ends, {:.6g} m",
                      i, R, half));
    const Vec2 along = (b - a) / (2.0 * half), left(-along.y(), along.x());
    const double sign = R > 0.0 ? 1.0 : -1.0;  // positive: turns left, as a vault does
    const Vec2 centre = 0.5 * (a + b) + sign * std::sqrt(R * R - half * half) * left;
    const double from = std::atan2(a.y() - centre.y(), a.x() - centre.x());
    const double turn = 2.0 * std::asin(half / std::abs(R));
    pieces.push_back(arc_piece(centre, std::abs(R), from, from + sign * turn));
  }
  return pieces;
}

}  // namespace

std::vector<ProfilePiece> profile_pieces(const Profile& p) {
  using enum Profile::Kind;
  const double a = 0.5 * p.span, h = p.rise;
  switch (p.kind) {
    case semicircle:
      return {arc_piece({0.0, 0.0}, a, 0.0, pi / 2)};
    case segmental: {
      const double R = (a * a + h * h) / (2.0 * h);
      return {arc_piece({0.0, h - R}, R, std::asin((R - h) / R), pi / 2)};
    }
    case pointed: {
      const double R = p.radius_ratio * p.span, e = R - a;
      return {arc_piece({-e, 0.0}, R, 0.0, std::acos(e / R))};
    }
    case basket:
      return cupola::basket(a, h, p.haunch_radius);
    case horseshoe:
      return {arc_piece({0.0, 0.0}, a, -p.below_deg * kRadians, pi / 2)};
    case ellipse:
      return {smooth_piece(
          [=](double t) -> Vec2 {
            return {a * std::cos(t * pi / 2), h * std::sin(t * pi / 2)};
          },
          [=](double t) -> Vec2 {
            return {-pi / 2 * a * std::sin(t * pi / 2), pi / 2 * h * std::cos(t * pi / 2)};
          })};
    case parabola:
      return {smooth_piece(
          [=](double t) -> Vec2 {
            return {a * (1.0 - t), h * t * (2.0 - t)};
          },
          [=](double t) -> Vec2 {
            return {-a, 2.0 * h * (1.0 - t)};
          })};
    case catenary:
      return {cupola::catenary(a, h)};
    case straight:
      return {line_piece({a, 0.0}, {a - p.batter * p.height, p.height})};
    case chain:
      return polyline(p.points);
  }
  return {};
}

Drawing drawing_of(const DomeSurface& dome) {
  return {.profile = {arc_to_crown(dome.radius(), dome.center_offset(), dome.crown_angle_deg)},
          .plan = circle_plan(),
          .thickness = dome.thickness};
}

Drawing drawing_of(const OctagonalVault& vault) {
  using enum OctagonalVault::Construction;
  if (vault.extrados == OctagonalVault::Extrados::bed && vault.construction != planar_horizontal)
    throw InputError("geometry.surface.extrados = bed: requires construction: planar_horizontal");
  const bool level = vault.construction == planar_horizontal;
  return {.profile = {arc_to_crown(vault.radius(), vault.center_offset(), vault.crown_angle_deg)},
          .plan = polygon_plan(vault.sails),
          .beds = vault.construction == circular ? VaultSurface::Beds::conical
                  : level                        ? VaultSurface::Beds::level
                                                 : VaultSurface::Beds::normal,
          .courses = level ? VaultSurface::Courses::height : VaultSurface::Courses::length,
          .extrados = vault.extrados,
          .thickness = vault.thickness};
}

Drawing drawing_of(const ArchSurface& arch) {
  const double R = arch.radius(), e = arch.center_offset(), crown = std::acos(e / R);
  const double springing = pi / 2 - arch.half_embrace_deg * kRadians;
  if (springing >= crown)
    throw InputError(fmt::format(
        "geometry.surface.half_embrace_deg = {}: must be > {:.6g}, where the arc reaches the crown",
        arch.half_embrace_deg, 90.0 - crown / kRadians));
  const double opening = 2.0 * (R * std::cos(springing) - e);
  if (opening < arch.thickness)
    throw InputError(
        fmt::format("geometry.surface.half_embrace_deg = {}: the springings are {:.3g} m apart, less than "
                    "the thickness of {} m, which is "
                    "no vault. The angle counts at the centre of each arc, from the vertical to the "
                    "springing: 90 for a semicircle",
                    arch.half_embrace_deg, std::max(opening, 0.0), arch.thickness));
  return {.profile = with_mirror_image({arc_piece({-e, 0.0}, R, springing, crown)}),
          .plan = line_plan(arch.width, Plan::Axis::y),
          .thickness = arch.thickness,
          .rows_per_ring = arch.voussoir_segments,
          .mirrored = true};
}

Drawing drawing_of(const WallSurface& wall) {
  return {.profile = {line_piece({0.0, 0.0}, {0.0, wall.height})},
          .plan = line_plan(wall.length, Plan::Axis::x),
          .drawn_depth = wall.thickness,
          .thickness = wall.thickness};
}

Drawing drawing_of(const VaultSurface& vault) {
  const bool is_line = vault.plan.kind == Plan::Kind::line;
  const bool is_groin = vault.plan.kind == Plan::Kind::groin;
  Drawing drawing{.profile = profile_pieces(vault.profile),
                  .plan = vault.plan,
                  .beds = vault.beds,
                  .bed_angles_deg = vault.bed_angles_deg,
                  .courses = vault.courses,
                  .thickness = vault.thickness,
                  .rows_per_ring = vault.voussoir_segments,
                  .key_stone = vault.key_stone};
  drawing.drawn_depth = vault.line == VaultSurface::Line::intrados ? 0.0
                        : vault.line == VaultSurface::Line::middle ? 0.5 * vault.thickness
                                                                   : vault.thickness;
  const double top = drawing.profile.back().at(1.0).x();
  const double rounding = 1e-9 * vault.profile.width();
  if (is_groin) {
    draw_web(vault, rounding, &drawing);
  } else if (is_line) {
    drawing.mirrored = vault.profile.kind != Profile::Kind::straight && std::abs(top) < rounding;
    if (drawing.mirrored) drawing.profile = with_mirror_image(std::move(drawing.profile));
  } else {
    if (vault.eye > 0.0) drawing.profile = outside_eye(std::move(drawing.profile), vault.eye, rounding);
    const Vec2 last = drawing.profile.back().at(1.0);
    if (last.x() < rounding)
      throw InputError(
          fmt::format("geometry.surface.eye = {}: the profile reaches the axis at z = {:.6g} m; give the "
                      "radius of an eye, or of the key stone that closes it (key_stone: true); a solid tip "
                      "on level beds is loads.lantern: {{weight: N}}",
                      vault.eye, last.y()));
  }
  check_curvature(drawing.profile, vault, drawing.drawn_depth);
  return drawing;
}

}  // namespace cupola

#include "generators/surface/drawn_surface.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <numbers>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "generators/surface/sail_section.hpp"

namespace cupola {
namespace {

using std::numbers::pi;
using Beds = VaultSurface::Beds;

/// A convex polygon whose sides move inwards by equal distances.
class MovingPolygon {
 public:
  explicit MovingPolygon(std::vector<Vec2> corners) : corners_(std::move(corners)) {
    const size_t n = corners_.size();
    for (size_t i = 0; i < n; ++i) {
      const Vec2 a = normal(i), b = normal((i + n - 1) % n);
      moves_.push_back((a + b) / (1.0 + a.dot(b)));
    }
  }
  Vec2 corner(size_t i, double inwards) const {
    const size_t k = i % corners_.size();
    return corners_[k] + inwards * moves_[k];
  }
  Vec2 point(size_t side, double share, double inwards) const {
    return (1.0 - share) * corner(side, inwards) + share * corner(side + 1, inwards);
  }
  size_t size() const { return corners_.size(); }
  /// m, of side i after the move; negative if it has turned round.
  double side(size_t i, double inwards) const {
    const Vec2 along = corners_[(i + 1) % size()] - corners_[i];
    return (corner(i + 1, inwards) - corner(i, inwards)).dot(along.normalized());
  }

 private:
  Vec2 normal(size_t i) const {
    const Vec2 along = corners_[(i + 1) % corners_.size()] - corners_[i];
    return Vec2(-along.y(), along.x()).normalized();
  }
  std::vector<Vec2> corners_;  // counter-clockwise
  std::vector<Vec2> moves_;    // of each corner per m
};

std::vector<Vec2> corners_of(const Plan& plan, const Vec2& first) {
  std::vector<Vec2> corners;
  if (plan.kind == Plan::Kind::corners) {
    for (size_t i = 0; i < plan.x.size(); ++i) corners.emplace_back(plan.x[i], plan.y[i]);
    return corners;
  }
  for (int i = 0; i < plan.sides; ++i)
    corners.emplace_back(first.x() * std::cos(2.0 * pi * i / plan.sides),
                         first.x() * std::sin(2.0 * pi * i / plan.sides));
  return corners;
}

/// Abscissae of the corners: equal for a regular polygon, otherwise in proportion to the sides.
std::vector<double> abscissae_of(const Plan& plan, const MovingPolygon& polygon) {
  const size_t n = polygon.size();
  std::vector<double> at{0.0};
  double whole = 0.0, before = 0.0;
  for (size_t i = 0; i < n; ++i) whole += polygon.side(i, 0.0);
  for (size_t i = 0; i + 1 < n; ++i) {
    before += polygon.side(i, 0.0);
    at.push_back(2.0 * pi *
                 (plan.kind == Plan::Kind::polygon ? (i + 1.0) / static_cast<double>(n) : before / whole));
  }
  return at;
}

SurfaceMap along_line(const Drawing& drawing, const SailSection& section, SurfaceMap surface) {
  surface.extent = drawing.plan.length;
  surface.flat_slices = true;
  surface.shell_volume = section_integral(section, drawing.beds, drawing.thickness, drawing.plan.length, 0.0);
  const bool along_x = drawing.plan.axis == Plan::Axis::x;
  surface.at = [=, beds = drawing.beds](double bed, double abscissa, double depth) {
    const Vec2 p = plane_bed_point(section, beds, bed, depth);
    return along_x ? Vec3(abscissa, -p.x(), p.y()) : Vec3(p.x(), abscissa, p.y());
  };
  return surface;
}

SurfaceMap round_circle(const Drawing& drawing, const SailSection& section, SurfaceMap surface) {
  surface.shell_volume = section_integral(section, drawing.beds, drawing.thickness, 0.0, 2.0 * pi);
  surface.at = [=, beds = drawing.beds](double bed, double azimuth, double depth) {
    const Vec2 p = plane_bed_point(section, beds, bed, depth);
    return Vec3(p.x() * std::cos(azimuth), p.x() * std::sin(azimuth), p.y());
  };
  return surface;
}

/// True for a vertical wall, on which conical beds are level and all facets plane.
bool is_upright(const Drawing& drawing) {
  return std::ranges::all_of(drawing.profile, [](const ProfilePiece& piece) {
    return piece.even && piece.turn == 0.0 && piece.derivative(0.5).x() == 0.0;
  });
}

/// A cone through a kink at the corners meets the sails above or below it.
void refuse_kinks(const SailSection& section) {
  for (int bed = 1; bed < section.num_rows; ++bed) {
    if (!section.beds->is_kink(bed)) continue;
    const Vec2 kink = section.point(bed, section.beds->place(bed), section.corner);
    throw InputError(
        fmt::format("geometry.surface.beds = conical: the profile has a kink at ({:.6g}, {:.6g}) m, which "
                    "cones about the axis leave between the corners; use beds: normal",
                    kink.x(), kink.y()));
  }
}

SurfaceMap over_polygon(const Drawing& drawing, const SailSection& section, SurfaceMap surface) {
  const Plan& plan = drawing.plan;
  const MovingPolygon polygon(corners_of(plan, section.point(0.0, 0.0, section.corner)));
  surface.corners = abscissae_of(plan, polygon);
  if (plan.kind == Plan::Kind::polygon) surface.sail_width = 2.0 * pi / plan.sides;
  if (drawing.beds == Beds::conical) {
    refuse_kinks(section);
    surface.flat_skins = surface.flat_slices = is_upright(drawing);
    surface.at = [=, sail = surface.sail_width](double bed, double azimuth, double depth) {
      const double psi = azimuth - (std::floor(azimuth / sail) + 0.5) * sail;
      const Vec2 p = conical_bed_point(section, bed, depth, 1.0 / std::cos(psi));
      return Vec3(p.x() * std::cos(azimuth), p.x() * std::sin(azimuth), p.y());
    };
    return surface;
  }
  const double first = section.point(0.0, 0.0, section.middle).x();
  const auto inwards = [=, beds = drawing.beds](double bed, double depth) {
    return first - plane_bed_point(section, beds, bed, depth).x();
  };
  const double most = inwards(surface.num_rows, 0.0);
  for (size_t i = 0; i < polygon.size(); ++i)
    if (polygon.side(i, most) <= 0.0)
      throw InputError(fmt::format(
          "geometry.surface.plan: side {} vanishes before the last bed, which lies {:.6g} m inside the plan; "
          "choose a larger eye",
          i, most));
  surface.flat_slices = true;
  double around = 0.0, less = 0.0;  // m, the circumference, and per m inwards
  for (size_t i = 0; i < polygon.size(); ++i) {
    around += polygon.side(i, 0.0);
    less += polygon.side(i, 0.0) - polygon.side(i, 1.0);
  }
  surface.shell_volume =
      section_integral(section, drawing.beds, drawing.thickness, around - less * first, less);
  surface.at = [=, corners = surface.corners, beds = drawing.beds](double bed, double abscissa,
                                                                   double depth) {
    const double a = abscissa - 2.0 * pi * std::floor(abscissa / (2.0 * pi));
    const auto above = std::ranges::upper_bound(corners, a);
    const auto side = static_cast<size_t>(above - corners.begin()) - 1;
    const double end = above == corners.end() ? 2.0 * pi : *above;
    const Vec2 section_point = plane_bed_point(section, beds, bed, depth);
    const Vec2 p =
        polygon.point(side, (a - corners[side]) / (end - corners[side]), first - section_point.x());
    return Vec3(p.x(), p.y(), section_point.y());
  };
  return surface;
}

/// Throws where the intrados has reached the axis on the last bed; m, from the axis.
void refuse_eye(double of_line, double of_intrados, bool upright) {
  if (of_intrados >= 1e-9 * of_line) return;
  throw InputError(fmt::format(
      "geometry.surface.{}: on the last bed the drawn line lies at r = {:.6g} m, the intrados at r = {:.6g} "
      "m, on the axis or beyond; choose {}",
      upright ? "thickness" : "eye", of_line, of_intrados,
      upright ? "less thickness; a solid shaft is a wall with `cuts` (docs/my_vault.md)"
              : "a larger eye or less thickness"));
}

}  // namespace

SurfaceMap drawn_surface(const Drawing& drawing, int rings) {
  const Plan& plan = drawing.plan;
  const bool is_line = !plan.closed(), is_round = plan.kind == Plan::Kind::circle;
  SailSection section;
  section.beds = std::make_shared<ProfileBeds>(drawing.profile, rings, drawing.rows_per_ring, drawing.courses,
                                               drawing.mirrored);
  section.extrados = drawing.extrados;
  section.drawn_depth = drawing.drawn_depth;
  section.num_rows = rings * drawing.rows_per_ring;
  section.mirrored = drawing.mirrored;
  for (const double angle : drawing.bed_angles_deg) section.bed_angles.push_back(angle * pi / 180.0);
  if (!section.bed_angles.empty() && drawing.mirrored && rings % 2 == 0 &&
      drawing.bed_angles_deg.back() != 90.0)
    throw InputError(
        fmt::format("geometry.surface.bed_angles_deg: ends with {}, but must end with 90, because an "
                    "even number of courses has a bed at the crown",
                    drawing.bed_angles_deg.back()));
  if (plan.kind == Plan::Kind::polygon)
    (plan.measured_at == Plan::MeasuredAt::corner ? section.middle : section.corner) =
        plan.measured_at == Plan::MeasuredAt::corner ? std::cos(pi / plan.sides)
                                                     : 1.0 / std::cos(pi / plan.sides);
  if (drawing.beds == Beds::level &&
      drawing.profile.front().derivative(0.0).y() * drawing.profile.back().derivative(1.0).y() < 0.0)
    throw InputError(
        "geometry.surface.beds = level: a stone between the level beds on both sides of a crown has no "
        "height; "
        "use beds: normal, or given with bed_angles_deg");
  SurfaceMap surface;
  surface.rows_per_ring = drawing.rows_per_ring;
  surface.num_rows = rings * drawing.rows_per_ring;
  surface.extent = 2.0 * pi;
  surface.last_bed_held = is_line && (drawing.mirrored || drawing.profile.back().derivative(1.0).y() < 0.0);
  surface.key_stone = drawing.key_stone;
  surface.smooth_beds = drawing.bed_angles_deg.size() <= 2;
  if (plan.kind == Plan::Kind::groin) {
    surface.webs = plan.sides;
    surface.groins = plan.groins;
    surface.springers = plan.springers;
  }
  surface.carries = surface.last_bed_held || surface.key_stone;
  surface.flat_rings = drawing.profile.size() == 1 && drawing.profile.front().even &&
                       drawing.profile.front().turn == 0.0 &&
                       (is_upright(drawing) || (!is_round && drawing.beds != Beds::conical));
  surface = is_line    ? along_line(drawing, section, std::move(surface))
            : is_round ? round_circle(drawing, section, std::move(surface))
                       : over_polygon(drawing, section, std::move(surface));
  const double last = surface.num_rows;
  if (is_round || plan.kind == Plan::Kind::polygon)
    refuse_eye(drawing.profile.back().at(1.0).x(), surface.at(last, 0.0, 0.0).x(), is_upright(drawing));
  constexpr double kFlattest = 0.05;  // rise of the sides of a key stone over the thickness
  if (drawing.key_stone && surface.at(last, 0.0, drawing.thickness).z() - surface.at(last, 0.0, 0.0).z() <
                               kFlattest * drawing.thickness)
    throw InputError(
        "geometry.surface.key_stone = true: the last bed is level there, so that nothing would hold the "
        "stone; give beds: normal, or leave out key_stone and give what lies on the last bed as "
        "loads.lantern: {weight: N}");
  return surface;
}

}  // namespace cupola

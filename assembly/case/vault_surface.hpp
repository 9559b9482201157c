#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "assembly/base/named_enum.hpp"
#include "assembly/files/profile_table.hpp"
#include "assembly/model/sheet.hpp"

namespace cupola {

/// What a kind of surface is, for code that must not know the kinds: the reader and the stereotomy. Each kind
/// states its own traits and nothing else asks for a kind by name.
struct SurfaceTraits {
  bool closed = false;  ///< courses are rings about the z axis; their last block meets the first
  Sheet::ThrustLines thrust_lines = Sheet::ThrustLines::none;
};

/// The line over which a surface stands, seen from above.
struct Plan {
  enum class Kind : std::uint8_t { line, circle, polygon, corners, groin };
  /// Section of a regular polygon that the profile draws: through a corner, or through the middle of a side.
  enum class MeasuredAt : std::uint8_t { corner, side };
  enum class Axis : std::uint8_t { y, x };
  /// Stones of two webs of a groin vault that meet at the groin: one stone in every course, or in every other
  /// one, or two stones with a joint in the plane of the groin.
  enum class Groins : std::uint8_t { bonded, alternate, mitred };

  Kind kind = Kind::circle;
  double length = 1.0;  ///< m, > 0, of a line
  Axis axis = Axis::y;  ///< of a line; with x the profile lies in the y-z plane, its outside towards -y
  int sides = 8;        ///< >= 3, of a regular polygon or a groin vault over one
  MeasuredAt measured_at = MeasuredAt::corner;
  std::vector<double> x, y;  ///< m, corners of a convex polygon, counter-clockwise
  Groins groins = Groins::bonded;
  /// m, of a groin vault: its first beds, on the drawn line above the springing; none: where their extrados
  /// is half as long as the shell is thick.
  std::optional<double> from_height;
  /// >= 0, courses of a groin vault above its supports that are one stone at each corner, on a level bed.
  int springers = 0;

  /// True if courses are rings about the z axis.
  bool closed() const { return kind != Kind::line && kind != Kind::groin; }
};
constexpr auto enum_names(Plan::Groins) {
  return std::array{"bonded", "alternate", "mitred"};
}
constexpr auto enum_names(Plan::MeasuredAt) {
  return std::array{"corner", "side"};
}

/// The section of a surface, from the springing at r = span / 2, z = 0 upwards.
struct Profile {
  enum class Kind : std::uint8_t {
    semicircle,
    segmental,
    pointed,
    basket,
    horseshoe,
    ellipse,
    parabola,
    catenary,
    straight,
    chain
  };

  Kind kind = Kind::semicircle;
  double span = 10.0;          ///< m, > 0
  double rise = 4.0;           ///< m, > 0, of a segmental, basket, elliptic, parabolic or catenary profile
  double radius_ratio = 0.8;   ///< > 0.5, radius over span of a pointed profile
  double haunch_radius = 2.0;  ///< m, > 0, of the lower arcs of a basket profile
  double below_deg = 30.0;     ///< in (0, 90), by which a horseshoe continues below its centre
  double height = 5.0;         ///< m, > 0, of a straight profile
  double batter = 0.0;         ///< by which a straight profile leans inwards per height
  std::string file;            ///< table or drawing of the points of a chain; "": the numbers below
  ProfileTable points;         ///< of a chain

  /// m, about which its coordinates are rounded.
  double width() const { return kind == Kind::chain && !points.r.empty() ? 2.0 * points.r.front() : span; }
};

/// Any profile carried along any plan.
struct VaultSurface {
  /// Plane normal to the profile; cones about the axis; level; at given angles.
  enum class Beds : std::uint8_t { normal, conical, level, given };
  /// What is equal from course to course; the angle is that of the normals.
  enum class Courses : std::uint8_t { length, height, angle };
  /// The line that the profile draws.
  enum class Line : std::uint8_t { intrados, middle, extrados };

  Plan plan;
  Profile profile;
  double thickness = 1.0;  ///< m, > 0, normal to the profile
  Beds beds = Beds::normal;
  /// deg above the horizontal, outwards, of given beds: from the first bed to the last, of an arch to the
  /// crown, at equal numbers of courses; linear between.
  std::vector<double> bed_angles_deg;
  Courses courses = Courses::length;
  Line line = Line::intrados;
  double eye = 0.0;           ///< m, >= 0, r of the last bed on the drawn line; 0: the end of the profile
  bool key_stone = false;     ///< one stone closes the eye
  int voussoir_segments = 1;  ///< >= 1, as of an arch

  // Not inline: GCC 12 takes an inlined destructor of an alternative that a std::variant does not hold for a
  // use of its members.
  VaultSurface();
  VaultSurface(const VaultSurface&);
  VaultSurface(VaultSurface&&) noexcept;
  VaultSurface& operator=(const VaultSurface&);
  VaultSurface& operator=(VaultSurface&&) noexcept;
  ~VaultSurface();

  SurfaceTraits traits() const {
    return {.closed = plan.closed(),
            .thrust_lines = plan.closed()                             ? Sheet::ThrustLines::by_azimuth
                            : plan.kind == Plan::Kind::groin          ? Sheet::ThrustLines::radial
                            : profile.kind == Profile::Kind::straight ? Sheet::ThrustLines::none
                                                                      : Sheet::ThrustLines::one};
  }
};
constexpr auto enum_names(VaultSurface::Beds) {
  return std::array{"normal", "conical", "level", "given"};
}
constexpr auto enum_names(VaultSurface::Courses) {
  return std::array{"length", "height", "angle"};
}
constexpr auto enum_names(VaultSurface::Line) {
  return std::array{"intrados", "middle", "extrados"};
}

}  // namespace cupola

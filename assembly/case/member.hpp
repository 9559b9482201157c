#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "assembly/case/cut.hpp"
#include "assembly/case/masonry.hpp"
#include "assembly/case/surface.hpp"

namespace cupola {

/// Rectangular openings of a closed, upright member, all of one size. Their jambs are head planes of the
/// surface, and a lintel in one block through the whole thickness covers each.
struct Openings {
  int per_ring = 0;             ///< of each position in `at`; 0: one on each side of the plan
  std::vector<double> at{0.5};  ///< middles, in spacings from abscissa 0 (the first corner), in [0, 1)
  double width = 0.0;           ///< m, > 0, on the intrados, at the sill
  double height = 0.0;          ///< m, > 0
  double sill = 0.0;            ///< m, >= 0, height of the lower edge above the first bed
  double lintel = 0.0;          ///< m, >= 0, height of the lintel; 0: one course
  double bearing = 0.5;         ///< m, > 0, of the lintel beyond each jamb, on the intrados
};

/// A map of all points of the masonry, which keeps planes and convexity: elliptic domes, raking barrels.
/// Thicknesses and angles are those before the map.
struct Affine {
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();  ///< along the axes, > 0
  double rake = 0.0;                                ///< rise of z per m of y, of a barrel
  double lean = 0.0;                                ///< move along y per m of z, of a barrel, before that

  Eigen::Vector3d image(const Eigen::Vector3d& point) const {
    Eigen::Vector3d p = scale.cwiseProduct(point);
    p.y() += lean * p.z();
    p.z() += rake * p.y();
    return p;
  }
};

/// Where a member stands.
struct Place {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< m
  double rotate_deg = 0.0;                           ///< about the vertical through the origin
};

/// Next to which other member a member stands: both reach up to a common vertical plane.
struct Beside {
  enum class Side : std::uint8_t { right, left, behind, before };  ///< x, -x, y, -y of the other member

  std::string member;  ///< a member before it in the list, or one of its copies
  Side side = Side::right;
};
constexpr auto enum_names(Beside::Side) {
  return std::array{"x", "-x", "y", "-y"};
}

/// A mirror image of a member, and of what stands on it.
struct Mirror {
  Eigen::Vector3d point = Eigen::Vector3d::Zero();    ///< m, of the plane
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();  ///< horizontal, not 0
};

/// Equal copies of a member, and of what stands on it: each follows from the one before by a turn about the
/// vertical through a point, or by a move, or all stand where they are told to.
struct Copies {
  int count = 0;                                 ///< >= 2, with the member itself; 0 with `at`
  std::optional<Eigen::Vector3d> about = {};     ///< m; the copies stand at equal angles round it
  Eigen::Vector3d by = Eigen::Vector3d::Zero();  ///< m, from one to the next
  std::vector<Place> at = {};                    ///< of all copies but the member itself
};

/// A surface with its bond: a wall, a drum, a dome. Heights of its wythes, bonders and openings count from
/// its springing.
struct Member : Masonry {
  std::string name = "shell";
  std::string on;  ///< name of the member on whose last bed it stands; "": on supports of its own
  std::optional<Beside> beside;
  std::optional<Place> at;  ///< none: at the origin, that of `beside`, or on the axis of the member below
  std::optional<Affine> affine;  ///< none: that of the geometry
  std::optional<Copies> copies;
  std::optional<Mirror> mirror;
  Surface surface = DomeSurface{};
  std::vector<Openings> openings;
  std::vector<Cut> cuts;  ///< in its own coordinates, before `at`

  /// With the member itself.
  int number_of_copies() const {
    if (mirror) return 2;
    if (!copies) return 1;
    return copies->at.empty() ? copies->count : static_cast<int>(copies->at.size()) + 1;
  }
  /// True if its supports are its own, or several copies of another.
  bool begins_stack() const { return on.empty() || at; }
};

}  // namespace cupola

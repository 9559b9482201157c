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
/// vertical through a point, or by a move.
struct Copies {
  int count = 2;                                 ///< >= 2, with the member itself
  std::optional<Eigen::Vector3d> about = {};     ///< m; the copies stand at equal angles round it
  Eigen::Vector3d by = Eigen::Vector3d::Zero();  ///< m, without `about`
};

/// A surface with its bond: a wall, a drum, a dome. Heights of its wythes, bonders and openings count from
/// its springing.
struct Member : Masonry {
  std::string name = "shell";
  std::string on;  ///< name of the member on whose last bed it stands; "": on supports of its own
  std::optional<Beside> beside;
  std::optional<Place> at;  ///< none: at the origin, that of `beside`, or on the axis of the member below
  std::optional<Copies> copies;
  std::optional<Mirror> mirror;
  Surface surface = DomeSurface{};
  std::vector<Openings> openings;
  std::vector<Cut> cuts;  ///< in its own coordinates, before `at`
};

}  // namespace cupola

#pragma once

#include <optional>
#include <variant>

namespace cupola {

/// Dome of revolution with the pointed-fifth profile: two arcs of radius `radius_ratio * span`, centred
/// beyond the axis so that the springing lies `span / 2` from it.
struct DomeSurface {
  double span = 45.0;             ///< m, > 0, clear diameter at the springing
  double radius_ratio = 0.8;      ///< intrados radius over span, >= 0.5 (0.5: hemisphere, 0.8: pointed fifth)
  double thickness = 2.2;         ///< m, > 0
  double crown_angle_deg = 60.0;  ///< angle t of the last bed, in (0, 90)

  double radius() const { return radius_ratio * span; }         ///< R, m
  double center_offset() const { return radius() - span / 2; }  ///< e, m
};

/// Plane wall, x along the length, y across, z up.
struct WallSurface {
  double length = 12.0;    ///< m, > 0
  double height = 6.0;     ///< m, > 0
  double thickness = 1.0;  ///< m, > 0
};

using Surface = std::variant<DomeSurface, WallSurface>;

/// Running bond: every ring has the same number of blocks, odd rings are shifted by half a block. On a wall
/// the odd courses end in half blocks.
struct RunningBond {
  int rings = 40;            ///< courses, >= 1
  int blocks_per_ring = 32;  ///< >= 1 on a wall, >= 3 on a dome
  int slices_per_block = 4;  ///< azimuthal cells per block, even
};

using Bond = std::variant<RunningBond>;

struct Stage {
  int rings = 0;  ///< rings built so far, >= 1
};

struct Geometry {
  Surface surface = DomeSurface{};
  Bond bond = RunningBond{};
  std::optional<Stage> stage;
  double support_width = 1.0;  ///< m, how far the fixed base reaches beyond the shell, > 0
};

}  // namespace cupola

#pragma once

#include <numbers>
#include <vector>

#include "assembly/model/assembly.hpp"

namespace cupola {

/// One facet of a bed: its edges on the intrados and on the extrados, both from side a to side b.
struct BedFacet {
  int block = 0;  ///< block above the bed; block below it for the last bed
  Vec3 intrados_a, intrados_b, extrados_a, extrados_b;  ///< m
  bool internal = false;  ///< the bed runs through a block that spans several rings
};

/// An assembly seen as a shell of rings: bed k lies below ring k, counted from the springing, and bed
/// num_rings closes the last ring. Imported blocks without rings have no beds. The beds of a shell with wythes have no
/// facets, so that thrust lines, sections and unrolled maps leave it out.
struct Shell {
  std::vector<std::vector<BedFacet>> beds;  ///< (num_rings + 1), facets of each bed
  std::vector<Vec3> progress;               ///< (num_rings), unit direction from ring to ring
  Vec3 up = Vec3::UnitZ();                  ///< against gravity
  double block_width_rad = 0.0;             ///< rad, median width in azimuth of the standard blocks; 0: none
  int num_rings() const { return static_cast<int>(progress.size()); }
  /// Unit direction from ring to ring at the given ring; up for a shell without rings.
  const Vec3& direction(int ring) const;
};
Shell shell_of(const Assembly& assembly, const Vec3& up);

/// Local axes of a block in the shell, unit and orthogonal, and its thickness.
struct ShellAxes {
  bool exists = false;     ///< false for a block without intrados and extrados
  Vec3 n = Vec3::Zero();   ///< from intrados to extrados
  Vec3 m = Vec3::Zero();   ///< along the meridian, upwards
  Vec3 t = Vec3::Zero();   ///< along the ring, m x n
  double thickness = 0.0;  ///< m, volume over the mean area of the two skins
};
std::vector<ShellAxes> shell_axes(const Assembly& assembly, const Shell& shell);

inline constexpr double kDegrees = 180.0 / std::numbers::pi;  ///< degrees per radian

/// Size of the model, m: diagonal of the box around the centroids of the free blocks, but at least the cube
/// root of the volume of the first block.
double model_size(const Assembly& assembly);

/// Size of a block, m: cube root of the mean volume of the free blocks; 0 without any.
double block_size(const Assembly& assembly);

/// Azimuth of a point about the z axis, rad, in (-pi, pi].
double azimuth(const Vec3& point);

/// The same angle in [-pi, pi].
double wrapped(double angle);

}  // namespace cupola

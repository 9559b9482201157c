#pragma once

#include <vector>

#include "assembly/model/assembly.hpp"

namespace cupola {

/// One facet of a bed, seen along the shell: its intrados and its extrados edge, from side a to side b.
struct BedFacet {
  int block = 0;  ///< the block above the bed; below it for the last bed
  Vec3 intrados_a, intrados_b, extrados_a, extrados_b;  ///< m
  bool internal = false;                                ///< runs through a block that spans several rings
};

/// What an assembly looks like as a shell: beds 0 .. num_rings from the springing upwards, and local axes of
/// its blocks. Imported blocks without rings have no beds.
struct Shell {
  std::vector<std::vector<BedFacet>> beds;  ///< (num_beds)
  std::vector<Vec3> progress;               ///< unit direction from ring to ring (num_rings)
  Vec3 up = Vec3::UnitZ();                  ///< against gravity
  double block_width_rad = 0.0;  ///< rad, median azimuth width of the standard blocks; 0 where none
  int num_rings() const { return static_cast<int>(progress.size()); }
  /// Unit direction from ring to ring at a course; up where there are no rings.
  const Vec3& direction(int ring) const;
};
Shell shell_of(const Assembly& assembly, const Vec3& up);

/// Axes of a block within the shell: n from intrados to extrados, m along the meridian upwards, t along the
/// ring, with its thickness; `exists` is false where the block has no intrados or extrados.
struct ShellAxes {
  bool exists = false;
  Vec3 n = Vec3::Zero(), m = Vec3::Zero(), t = Vec3::Zero();
  double thickness = 0.0;  ///< m, volume over the mean of the two skins' areas
};
std::vector<ShellAxes> shell_axes(const Assembly& assembly, const Shell& shell);

/// Azimuth of a point about the z axis, rad, in (-pi, pi].
double azimuth(const Vec3& point);

/// The angle's representative in [-pi, pi].
double wrapped(double angle);

}  // namespace cupola

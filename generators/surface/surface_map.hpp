#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "assembly/case/geometry.hpp"
#include "assembly/model/assembly.hpp"

namespace cupola {

enum class Skin : int { intrados = 0, extrados = 1 };

/// What carries the first bed (and the last one of an arch).
enum class Footing {
  ring,             ///< horizontal ring below z = 0, for closed surfaces
  plate,            ///< one box below z = 0, for walls
  both_springings,  ///< one box behind the first and one behind the last bed, for arches
};

/// A masonry surface: where the corner of bed k, abscissa a and skin w lies. On closed surfaces the abscissa
/// runs from 0 to 2 pi with the azimuth (equal to it at the corners of a vault), on the others it is a length
/// in metres. The directions (outwards, along, up) are
/// right-handed. It knows nothing of blocks.
struct SurfaceMap {
  std::function<Vec3(double bed, double abscissa, Skin skin)> point;  ///< m
  int num_rows = 0;       ///< rows of cells; beds count 0 .. num_rows, positions between them are defined
  int rows_per_ring = 1;  ///< more than 1 where the cells follow curved faces within a course
  bool closed = false;    ///< the last slice meets the first one
  double extent = 0.0;    ///< range of the abscissa: 2 pi, or the length in m
  std::vector<double> corners;  ///< ascending abscissae where facets meet, in [0, extent)
  bool flat_slices = false;     ///< cells of one ring and one facet form one convex solid exactly
  bool flat_rings = false;      ///< so do cells of one facet in successive rings
  bool flat_skins = true;       ///< four corners of a cell on one skin are coplanar
  Footing footing = Footing::ring;
  std::optional<double> shell_volume;  ///< m3, of the curved shell, where a closed form is known

  int num_rings() const { return num_rows / rows_per_ring; }
};

}  // namespace cupola

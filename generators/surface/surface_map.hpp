#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "assembly/case/geometry.hpp"
#include "assembly/model/assembly.hpp"

namespace cupola {

/// A masonry surface as a map from (bed, abscissa, layer) to a point. It knows nothing about blocks.
///
/// Layer l lies between wythes l - 1 and l: layer 0 is the intrados and layer num_wythes() the extrados. In a
/// bed, the points of all layers at one abscissa lie on a straight line, so that joints between any two
/// wythes of successive courses are parts of one plane.
///
/// The abscissa of a closed surface is an angle in [0, 2 pi) that follows the azimuth and equals it at the
/// corners of a vault; otherwise it is a length in m. The directions (outwards, along, up) form a
/// right-handed frame.
struct SurfaceMap {
  std::function<Vec3(double bed, double abscissa, double depth)> at;  ///< m; depth: m from the intrados
  std::vector<Thickness> wythes;  ///< inside first; make_surface sets them
  int num_rows = 0;               ///< rows of cells, between beds 0 .. num_rows; `at` accepts fractional beds
  int rows_per_ring = 1;          ///< above 1 where several cells follow the curved faces of one course
  bool closed = false;            ///< the last slice meets the first; make_surface copies it from the traits
  Sheet::ThrustLines thrust_lines = Sheet::ThrustLines::none;  ///< likewise
  double extent = 0.0;          ///< range of the abscissa: 2 pi, or the length in m
  std::vector<double> corners;  ///< ascending abscissae where facets meet, in [0, extent)
  std::vector<double> facets;   ///< likewise, of a round surface made of plane facets; make_surface sets none
  double sail_width = 0.0;      ///< range of the abscissa over a sail; 0: the surface has no sails
  double first_corner = 0.0;    ///< abscissa where sail 0 begins
  double held_end = 0.0;        ///< range of the abscissa of the fixed masonry beyond each end; 0: none
  bool flat_slices = false;     ///< the cells of one ring and one facet form an exactly convex solid
  bool flat_rings = false;      ///< so do the cells of one facet in successive rings
  bool smooth_beds = true;      ///< their directions change smoothly from bed to bed
  bool flat_skins = true;       ///< the four corners of a cell on one skin are coplanar
  bool first_bed_held = true;   ///< a fixed support stands behind the first bed
  bool last_bed_held = false;   ///< and behind the last
  bool first_row_held = false;  ///< the first row of cells is fixed masonry instead, as in a window
  bool key_stone = false;       ///< one stone lies on the whole last bed
  int webs = 0;                 ///< > 0: this is one of the webs of a groin vault, before they are cut
  Plan::Groins groins = Plan::Groins::bonded;  ///< of these webs
  int springers = 0;                           ///< courses of them that are one stone at each corner
  bool carries = false;                ///< a support, a key stone or another surface lies on the last bed
  Vec3 springing = Vec3::Zero();       ///< m, of the intrados at a corner; make_surface sets it
  int rings_below = 0;                 ///< courses of the drum below the first bed
  std::optional<double> shell_volume;  ///< m3, of the smooth shell, if a closed form is known

  int num_wythes() const { return static_cast<int>(wythes.size()); }
  /// m, of a bed above the springing: of its intrados at a corner.
  double height(double bed) const { return at(bed, first_corner, 0.0).z() - springing.z(); }
  /// m, from the intrados to a layer.
  double depth(double bed, int layer) const;
  Vec3 point(double bed, double abscissa, int layer) const { return at(bed, abscissa, depth(bed, layer)); }
  Vec3 intrados(double bed, double abscissa) const { return at(bed, abscissa, 0.0); }
  Vec3 extrados(double bed, double abscissa) const { return point(bed, abscissa, num_wythes()); }
  /// Ring of the first row among those of the surface: -1 if the first row is a support.
  int first_ring() const { return first_row_held ? -1 : 0; }
  int num_rings() const { return num_rows / rows_per_ring + first_ring(); }
};

}  // namespace cupola

#pragma once

#include <numbers>
#include <vector>

#include "assembly/model/assembly.hpp"

namespace cupola {

/// One facet of a bed: its inner and its outer edge, both from side a to side b. They lie on the intrados and
/// the extrados, or on layers between wythes.
struct BedFacet {
  int block = 0;  ///< block above the bed; block below it for a bed that closes a stack
  Vec3 intrados_a, intrados_b, extrados_a, extrados_b;  ///< m
  bool internal = false;        ///< the bed runs through a block that spans several rings
  double from = 0.0, to = 1.0;  ///< shares of the thickness of the shell at the inner and the outer edge
  bool around = false;          ///< a rectangle around a bed without an inner or an outer edge
};

/// The facets of one block on one bed, their range of azimuths and their mean plane.
struct BlockBed {
  int block = 0;
  std::vector<int> facets;      ///< into the bed
  double from = 0.0, to = 0.0;  ///< rad about the axis of the stack, unwrapped
  Plane plane;
};

/// Wythes from .. to - 1 of the thickness, counted from the inside as in Assembly::members; those of a drum
/// come first, with numbers of their own.
struct WytheRange {
  int from = 0, to = 1;
  int count() const { return to - from; }
  bool contains(int wythe) const { return wythe >= from && wythe < to; }
  auto operator<=>(const WytheRange&) const = default;
};

/// An assembly seen as a shell of rings: bed k lies below ring k, counted from the springing, and bed
/// num_rings + i closes stack i: the first bed of the next one lies elsewhere. Imported blocks without rings
/// have no beds.
struct Shell {
  std::vector<std::vector<BedFacet>> beds;    ///< (num_rings + stacks), facets of each bed
  std::vector<std::vector<BlockBed>> blocks;  ///< (num_rings + stacks), those on each bed, by their numbers
  std::vector<int> ends;                      ///< (stacks), the ring behind the last one of each
  std::vector<Vec3> progress;                 ///< (num_rings), unit direction from ring to ring
  Vec3 up = Vec3::UnitZ();                    ///< against gravity
  /// (num_rings), rad, middle width in azimuth of the standard blocks of the stack, of all where none is.
  std::vector<double> block_width_rad;
  int num_wythes = 1;              ///< numbers in use; some may have no blocks
  std::vector<int> innermost;      ///< (num_wythes), number of the innermost wythe of the same drum or shell
  std::vector<WytheRange> wythes;  ///< per block, those that it occupies; all for supports
  /// (num_rings + stacks) x (num_wythes + 1), share of the thickness at each layer of a bed; NaN where no facet
  /// has it.
  std::vector<std::vector<double>> layers;
  int num_rings() const { return static_cast<int>(progress.size()); }
  bool closes(int bed) const { return bed >= num_rings(); }
  int bed_above(int ring) const;
  /// Number of a bed in its stack, which begins with that of the first ring.
  int number_of(int bed) const { return closes(bed) ? ends[bed - num_rings()] : bed; }
  /// Wythes between the innermost one of its drum or shell and the middle of a free block.
  double wythes_inside(int block) const;
  /// True for the only wythe of a drum or shell.
  bool is_alone(int wythe) const;
  /// Largest number of wythes of a drum or shell.
  int most_wythes() const;
  /// Unit direction from ring to ring at the given ring or bed; up for a shell without rings.
  const Vec3& direction(int ring) const;
};
Shell shell_of(const Assembly& assembly, const Vec3& up);

/// Local axes of a block in the shell, unit and orthogonal, and its thickness.
struct ShellAxes {
  bool exists = false;    ///< false for a block without intrados and extrados, and without wythes
  Vec3 n = Vec3::Zero();  ///< from intrados to extrados
  /// Along the meridian, upwards; in a level stone of a crown across its barrel.
  Vec3 m = Vec3::Zero();
  Vec3 t = Vec3::Zero();   ///< along the ring, m x n
  bool pole = false;       ///< level and of no barrel, as a key stone: m may be any direction
  double thickness = 0.0;  ///< m, volume over the mean area of the two skins
};
std::vector<ShellAxes> shell_axes(const Assembly& assembly, const Shell& shell);

/// Per block, wythes_inside() times the unit direction through the thickness: shifts along it pull the wythes
/// apart. Zero for supports and for blocks without a bed of their own.
std::vector<Vec3> shifts_by_wythe(const Assembly& assembly, const Shell& shell);

inline constexpr double kDegrees = 180.0 / std::numbers::pi;  ///< degrees per radian

/// Size of the model, m: diagonal of the box around the centroids of the free blocks, but at least the cube
/// root of the volume of the first block.
double model_size(const Assembly& assembly);

/// Distance, m, up to which a point lies on a plane: far above the rounding of centroids, far below any block.
double on_plane_tolerance(const Assembly& assembly);

/// Size of a block, m: cube root of the mean volume of the free blocks; 0 without any.
double block_size(const Assembly& assembly);

/// Azimuth of a point about the z axis, rad, in (-pi, pi].
double azimuth(const Vec3& point);

/// The same about the axis of the higher of two blocks.
double azimuth(const Assembly& assembly, int block_a, int block_b, const Vec3& point);

/// The same angle in [-pi, pi].
double wrapped(double angle);

}  // namespace cupola

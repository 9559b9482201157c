#pragma once

#include <map>
#include <optional>
#include <tuple>
#include <vector>

#include <Eigen/Geometry>

#include "assembly/model/random_field.hpp"
#include "generators/stereotomy/cell_grid.hpp"

namespace cupola {

/// Seeded pseudo-random numbers, the same on every machine (splitmix64; Steele, Lea and Flood 2014).
class Random {
 public:
  explicit Random(int seed) : state_(static_cast<std::uint64_t>(seed)) {}
  double uniform();  ///< [0, 1)

 private:
  std::uint64_t state_;
};

/// Corner points of the grid, with the imperfections of the case.
///
/// - Without imperfections there is one vertex per bed, cut and layer, shared by all cells around it.
/// - Noise moves each bed and each head plane as a whole, and each corner along the line that joins intrados
///   and extrados there. That line lies in the bed and in the head plane, so both stay plane and joints stay
///   closed. The first bed, and the last bed of an arch or drum, stay where they are.
/// - Gaps give every block its own corners. Its beds and heads move inwards by random fractions of gap / 2,
///   measured on the intrados; heads along the chords of the grid, so that the faces of a curved bed keep the
///   planes that the blocks below and above have.
/// - Courses with cuts of their own have corners of their own.
/// - With a correlation length the random numbers are functions of place: of the middle of a bed or head on
///   the intrados, of its end on the first cut or bed where a whole bed or head plane moves, and of each
///   corner.
class GridPoints {
 public:
  /// `placement`: of the member, for imperfections that are functions of place.
  GridPoints(const CellGrid& grid, const std::optional<Imperfections>& imperfections,
             const Eigen::Isometry3d& placement);

  bool flat_skins() const { return grid_.surface.flat_skins && noise_ == 0.0; }
  /// Where skins are not plane: true if the layers of a cell bulge outwards along the diagonal from its lower
  /// left to its upper right corner, false if along the other.
  bool bulges_along_rising_diagonal(int row, int cut) const;
  /// The cuts of the first course, moved by the noise: the supports meet its blocks there.
  std::vector<double> cuts_at_supports() const;
  /// The plane of a bed over a slice of a row, of a surface on which it is one; its normal points upwards.
  Plane bed_plane(int bed, int row, int slice) const;
  /// Appends the shared vertices; call once, before the first block. If the shell has wythes, the layers of
  /// all vertices are counted from `first_layer`.
  void make_shared(int first_layer, Assembly* assembly);
  /// Call before the vertices of each block.
  void start_block(int bond_block);
  /// Index of a corner of the current block, on a bed of the course of `row`; appends it if the block has its
  /// own corners.
  int vertex(int row, int bed, int cut, int layer, Assembly* assembly);

 private:
  void append(const Vec3& point, int bed, int layer, Assembly* assembly) const;
  /// The plane of the head at a cut, moved by `shift` along the abscissa.
  Plane head_plane(int row, int top, int cut, double shift) const;
  /// At a cut, or where the chord from there to the cut `towards` meets a head that has moved.
  Vec3 point(double bed_shift, const Plane* head, int towards, int row, int bed, int cut, int layer) const;
  double metres_per_bed(int bed, int cut) const;
  double metres_per_abscissa(int bed, int cut) const;
  double uniform(const std::optional<RandomField>& field, const Vec3& place);    ///< [0, 1)
  double symmetric(const std::optional<RandomField>& field, const Vec3& place);  ///< [-1, 1)
  Vec3 corner(int bed, int cut) const;  ///< on the intrados; not of courses with cuts of their own

  const CellGrid& grid_;
  Eigen::Isometry3d placement_;
  double gap_ = 0.0, noise_ = 0.0;  // m
  Random random_;
  std::optional<RandomField> gap_field_, bed_field_, cut_field_;  // none: independent numbers
  std::vector<std::optional<RandomField>> skin_fields_;           // one per layer
  int num_columns_ = 0, num_layers_ = 0, first_vertex_ = 0, first_layer_ = 0;
  std::vector<int> course_start_;  // of courses with cuts of their own: vertices before theirs
  std::vector<double> bed_noise_, cut_noise_, skin_noise_;  // bed units, abscissa units, m

  struct Sides {
    int lower, upper, left, right;  // beds and cuts of the block
    double lower_gap, upper_gap;    // bed units
    Plane left_head, right_head;
  } sides_{};
  std::map<std::tuple<int, int, int>, int> own_;  // corners of the block: (bed, cut, layer) -> vertex
};

}  // namespace cupola

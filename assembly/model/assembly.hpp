#pragma once

#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

#include <Eigen/Core>

#include "assembly/base/named_enum.hpp"
#include "assembly/model/sheet.hpp"

namespace cupola {

using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

enum class BlockKind : std::uint8_t { standard, herringbone, support, imported };
constexpr auto enum_names(BlockKind) {
  return std::array{"standard", "herringbone", "support", "imported"};
}

/// Role of a face of a convex part in the masonry. `top`: free upper bed of the last ring, which carries the
/// top load. `internal`: between two parts of one block, makes no contact. `wythe`: a joint between layers
/// of the thickness. `free`: any other face.
enum class FaceKind : std::uint8_t { bed, head, intrados, extrados, top, internal, free, wythe };
constexpr auto enum_names(FaceKind) {
  return std::array{"bed", "head", "intrados", "extrados", "top", "internal", "free", "wythe"};
}

/// One rigid block. Its mass properties are computed from its convex parts, not from their hull.
struct Block {
  std::string name;  ///< in the imported file; "" for generated blocks, which have numbers only
  BlockKind kind = BlockKind::standard;
  bool fixed = false;            ///< has no unknowns
  bool rib = false;              ///< spans a corner of an octagonal vault
  bool truncated = false;        ///< cut: a shorter upright, or a flat block not as wide as a whole one
  int ring = 0;                  ///< first ring it occupies; -1 for a support
  int num_rings = 1;             ///< rings it spans
  int slot = 0;                  ///< position within the ring, counted along the azimuth
  int sail = 0;                  ///< sail in which its centroid lies; 0 for surfaces without sails
  double sail_position = 0.0;    ///< u in [-1, 1] across the sail, 0 at mid-sail
  int spiral = -1;               ///< herringbone spiral it belongs to; -1 for none
  int member = 0;                ///< index into Assembly::members
  double density = 0.0;          ///< kg/m3
  double volume = 0.0;           ///< m3
  double mass = 0.0;             ///< kg
  Vec3 centroid = Vec3::Zero();  ///< m, world axes
  Mat3 inertia = Mat3::Zero();   ///< kg m2, about the centroid, world axes
};

/// One convex piece of a block: a range of the assembly's faces.
struct Part {
  int block = 0;
  int ring = 0;   ///< course of this piece; -1 for a support
  int slice = 0;  ///< azimuthal (or horizontal) slice
  int face_start = 0;
  int num_faces = 0;
  double volume = 0.0;  ///< m3
  int wythe = 0;        ///< innermost layer of the thickness that it occupies
};

/// A straight tie between points of two blocks: a link of a chain, or a spring or rod of an imported model.
/// Elastic up to its yield force, then perfectly plastic.
struct BuiltTie {
  int block_a = 0, block_b = 0;
  Vec3 point_a = Vec3::Zero(), point_b = Vec3::Zero();           ///< m, world, as built
  double stiffness = 0.0;                                        ///< N/m; infinity for a rigid rod
  double length = 0.0;                                           ///< m, natural length (no force)
  bool pushes = false;                                           ///< also carries compression
  double yield_force = std::numeric_limits<double>::infinity();  ///< N, > 0, largest tension
  int chain = -1;                                                ///< index into Assembly::chains; -1: none
};

/// A closed chain round a dome or vault: its ties have this index.
struct BuiltChain {
  std::string name;
  double height = 0.0;  ///< m, mean z of the ends of its ties
};

/// The model that the generator writes and all programs read: convex parts on one shared vertex table.
///
/// Faces are stored flat: face f has the vertices
/// face_vertices[face_vertex_start[f] .. face_vertex_start[f + 1]), counter-clockwise seen from outside.
/// Mating faces of neighbouring parts use the same vertex ids, so that joints close exactly.
struct Assembly {
  std::vector<Vec3> vertices;          ///< m (num_vertices)
  std::vector<int> face_vertex_start;  ///< (num_faces + 1)
  std::vector<int> face_vertices;      ///< (sum of face sizes)
  std::vector<FaceKind> face_kinds;    ///< (num_faces)
  std::vector<Part> parts;             ///< sorted by block
  std::vector<Block> blocks;
  std::vector<BuiltTie> ties;  ///< those of one chain together, in the order of their azimuth
  std::vector<BuiltChain> chains;

  std::string title;
  std::string geometry_hash;  ///< hash of the case sections that the generator read
  int num_rings = 0;          ///< rings of the complete model; 0 for imported blocks
  std::vector<Sheet> sheets;  ///< by their courses; none for imported blocks
  /// Names of the wythes and, behind them, of the groups of bonders; empty for a shell of one wythe.
  std::vector<std::string> members;
  /// Of each of them the name of that of which it is a copy or mirror image, else its own.
  std::vector<std::string> member_originals;
  /// Of the corners of a shell with wythes (num_vertices): the layer on which they lie, and their share of
  /// the thickness of the shell, 0 on the intrados and 1 on the extrados. Wythe members[l] lies between
  /// layers l and l + 1. -1 and 0 for the corners of supports. Empty for a shell of one wythe.
  std::vector<int> vertex_layers;
  std::vector<double> vertex_depths;
  std::string check_report;  ///< results of the generator's checks, as lines of text; may be empty
  std::vector<std::string> block_warnings;  ///< of the generator about the blocks, one sentence each
  std::vector<std::string> case_warnings;   ///< of the generator about the rest of its case

  int num_faces() const { return static_cast<int>(face_kinds.size()); }
  std::span<const int> face(int f) const {
    return {face_vertices.data() + face_vertex_start[f],
            static_cast<std::size_t>(face_vertex_start[f + 1] - face_vertex_start[f])};
  }
  /// The sheet to which a course belongs; null if there is none.
  const Sheet* sheet_of(int ring) const;
  /// That sheet, whose axis its whole stack has, without courses the first; without sheets the z axis.
  Sheet axis_of(int ring) const;
  /// Rings [first, second) of the stack of sheets to which a course belongs; all rings without sheets.
  std::pair<int, int> stack_of(int ring) const;
  /// The sheet along whose outwards a course pushes: its own; of a wall Sheet::vault, which one vault alone
  /// leaves open: the next in the list, else the one before; of blocks of no course the last. Null if no sheet
  /// has one.
  const Sheet* vault_of(int ring) const;
  /// Horizontal unit vector outwards at a point (m) of a course, see Sheet::outward, or of imported blocks;
  /// NaN without a vault.
  Vec3 outward(int ring, const Vec3& point) const;
  /// Appends a face to the last part. A new part starts with `face_start = num_faces()`.
  void add_face(std::span<const int> vertex_ids, FaceKind kind);
};

/// The plane n.x = offset with unit normal n.
struct Plane {
  Vec3 normal = Vec3::UnitZ();
  double offset = 0.0;  ///< m
};

/// Plane through the mean of the vertices of a polygon, with Newell's normal (outward for counter-clockwise
/// vertices).
Plane polygon_plane(std::span<const Vec3> polygon);
double polygon_area(std::span<const Vec3> polygon);
Vec3 polygon_centroid(std::span<const Vec3> polygon);

std::vector<Vec3> face_points(const Assembly& assembly, int face);

/// Volume, centroid and inertia (per unit density, about the centroid) of a closed polyhedron, summed over
/// the signed tetrahedra between its fan-triangulated faces and one of its vertices. The reference vertex
/// avoids cancellation far from the origin.
struct SolidProperties {
  double volume = 0.0;
  Vec3 centroid = Vec3::Zero();
  Mat3 inertia = Mat3::Zero();
};
SolidProperties solid_properties(const Assembly& assembly, const Part& part);

/// Computes the volume of every part, and the volume, mass, centroid and inertia of every block, from the
/// parts and the densities of the blocks. Throws InputError that names the block if a volume is not positive.
void compute_mass_properties(Assembly* assembly);

/// Weight of the blocks that are not fixed, N, under a gravity of the given magnitude (m/s2).
double free_weight(const Assembly& assembly, double gravity);

}  // namespace cupola

#pragma once

#include <cstdint>
#include <optional>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include <Eigen/Core>

#include "assembly/base/named_enum.hpp"
#include "assembly/files/profile_table.hpp"
#include "assembly/model/sheet.hpp"

namespace cupola {

/// What a kind of surface is, for code that must not know the kinds: the reader and the stereotomy. Each kind
/// states its own traits and nothing else asks for a kind by name.
struct SurfaceTraits {
  bool closed = false;  ///< courses are rings about the z axis; their last block meets the first
  Sheet::ThrustLines thrust_lines = Sheet::ThrustLines::none;
};

/// Dome of revolution with the pointed-fifth profile: two arcs of radius `radius_ratio * span`, centred
/// beyond the axis so that the springing lies `span / 2` from it.
struct DomeSurface {
  SurfaceTraits traits() const { return {.closed = true, .thrust_lines = Sheet::ThrustLines::by_azimuth}; }

  double span = 45.0;             ///< m, > 0, clear diameter at the springing
  double radius_ratio = 0.8;      ///< intrados radius over span, >= 0.5 (0.5: hemisphere, 0.8: pointed fifth)
  double thickness = 2.2;         ///< m, > 0
  double crown_angle_deg = 60.0;  ///< angle t of the last bed, in (0, 90)

  double radius() const { return radius_ratio * span; }         ///< R, m
  double center_offset() const { return radius() - span / 2; }  ///< e, m
};

/// Plane wall, x along the length, y across, z up.
struct WallSurface {
  SurfaceTraits traits() const { return {.closed = false, .thrust_lines = Sheet::ThrustLines::none}; }

  double length = 12.0;    ///< m, > 0
  double height = 6.0;     ///< m, > 0
  double thickness = 1.0;  ///< m, > 0
};

/// Cloister vault over a regular polygon (an octagon by default): each sail is a cylinder, and the section
/// through two opposite corners is the pointed-fifth profile of the dome.
struct OctagonalVault {
  SurfaceTraits traits() const { return {.closed = true, .thrust_lines = Sheet::ThrustLines::by_azimuth}; }

  /// Beds on cones about the axis, as Brunelleschi laid them; in planes normal to each sail; level.
  enum class Construction : std::uint8_t { circular, planar_radial, planar_horizontal };
  /// Where `thickness` is measured: normal to the sail; on the corner section, whose extrados is a second
  /// arc; on the mid-sail section, whose extrados is a second arc; along level beds.
  enum class Extrados : std::uint8_t { normal, corner, midsail, bed };

  int sails = 8;                  ///< >= 3
  double span = 45.0;             ///< m, > 0, clear distance of opposite corners at the springing
  double radius_ratio = 0.8;      ///< radius of the corner arc over span, >= 0.5
  double thickness = 2.2;         ///< m, > 0
  double crown_angle_deg = 60.0;  ///< angle of the last bed at the corner, in (0, 90)
  Construction construction = Construction::circular;
  Extrados extrados = Extrados::normal;

  double radius() const { return radius_ratio * span; }         ///< R, m
  double center_offset() const { return radius() - span / 2; }  ///< e, m
};
constexpr auto enum_names(OctagonalVault::Construction) {
  return std::array{"circular", "planar_radial", "planar_horizontal"};
}
constexpr auto enum_names(OctagonalVault::Extrados) {
  return std::array{"normal", "corner", "midsail", "bed"};
}

/// Barrel arch of two arcs with radial joints, from one springing over the crown (x = 0) to the other; its
/// axis is y. A pointed arch (radius_ratio > 0.5) has a joint in the crown plane.
struct ArchSurface {
  SurfaceTraits traits() const { return {.closed = false, .thrust_lines = Sheet::ThrustLines::one}; }

  double span = 10.0;              ///< m, > 0, clear span of the full arc at z = 0: 2 R when semicircular
  double radius_ratio = 0.5;       ///< intrados radius over span, >= 0.5 (0.5: one circle)
  double thickness = 1.0;          ///< m, > 0
  double width = 1.0;              ///< m, > 0, along the axis
  double half_embrace_deg = 90.0;  ///< at the centre of each arc, from the vertical to the springing
  /// Straight segments that approximate the curved faces of a voussoir. With n segments the relative error of
  /// the volume is (angle/n)^2 / 6; 1 gives polygonal voussoirs.
  int voussoir_segments = 1;

  double radius() const { return radius_ratio * span; }         ///< R, m
  double center_offset() const { return radius() - span / 2; }  ///< e, m
};

/// The line over which a surface stands, seen from above.
struct Plan {
  enum class Kind : std::uint8_t { line, circle, polygon, corners, groin };
  /// Section of a regular polygon that the profile draws: through a corner, or through the middle of a side.
  enum class MeasuredAt : std::uint8_t { corner, side };
  enum class Axis : std::uint8_t { y, x };
  /// Stones of two webs of a groin vault that meet at the groin: one stone in every course, or in every other
  /// one, or two stones with a joint in the plane of the groin.
  enum class Groins : std::uint8_t { bonded, alternate, mitred };

  Kind kind = Kind::circle;
  double length = 1.0;  ///< m, > 0, of a line
  Axis axis = Axis::y;  ///< of a line; with x the profile lies in the y-z plane, its outside towards -y
  int sides = 8;        ///< >= 3, of a regular polygon or a groin vault over one
  MeasuredAt measured_at = MeasuredAt::corner;
  std::vector<double> x, y;  ///< m, corners of a convex polygon, counter-clockwise
  Groins groins = Groins::bonded;
  /// m, of a groin vault: its first beds, on the drawn line above the springing; none: where their extrados
  /// is half as long as the shell is thick.
  std::optional<double> from_height;

  /// True if courses are rings about the z axis.
  bool closed() const { return kind != Kind::line && kind != Kind::groin; }
};
constexpr auto enum_names(Plan::Groins) {
  return std::array{"bonded", "alternate", "mitred"};
}
constexpr auto enum_names(Plan::MeasuredAt) {
  return std::array{"corner", "side"};
}

/// The section of a surface, from the springing at r = span / 2, z = 0 upwards.
struct Profile {
  enum class Kind : std::uint8_t {
    semicircle,
    segmental,
    pointed,
    basket,
    horseshoe,
    ellipse,
    parabola,
    catenary,
    straight,
    chain
  };

  Kind kind = Kind::semicircle;
  double span = 10.0;          ///< m, > 0
  double rise = 4.0;           ///< m, > 0, of a segmental, basket, elliptic, parabolic or catenary profile
  double radius_ratio = 0.8;   ///< > 0.5, radius over span of a pointed profile
  double haunch_radius = 2.0;  ///< m, > 0, of the lower arcs of a basket profile
  double below_deg = 30.0;     ///< in (0, 90), by which a horseshoe continues below its centre
  double height = 5.0;         ///< m, > 0, of a straight profile
  double batter = 0.0;         ///< by which a straight profile leans inwards per height
  std::string file;            ///< table or drawing of the points of a chain; "": the numbers below
  ProfileTable points;         ///< of a chain

  /// m, about which its coordinates are rounded.
  double width() const { return kind == Kind::chain && !points.r.empty() ? 2.0 * points.r.front() : span; }
};

/// Any profile carried along any plan.
struct VaultSurface {
  /// Plane normal to the profile; cones about the axis; level.
  enum class Beds : std::uint8_t { normal, conical, level };
  /// What is equal from course to course.
  enum class Courses : std::uint8_t { length, height };
  /// The line that the profile draws.
  enum class Line : std::uint8_t { intrados, middle, extrados };

  Plan plan;
  Profile profile;
  double thickness = 1.0;  ///< m, > 0, normal to the profile
  Beds beds = Beds::normal;
  Courses courses = Courses::length;
  Line line = Line::intrados;
  double eye = 0.0;           ///< m, >= 0, r of the last bed on the drawn line; 0: the end of the profile
  bool key_stone = false;     ///< one stone closes the eye
  int voussoir_segments = 1;  ///< >= 1, as of an arch

  // Not inline: GCC 12 takes an inlined destructor of an alternative that a std::variant does not hold for a
  // use of its members.
  VaultSurface();
  VaultSurface(const VaultSurface&);
  VaultSurface(VaultSurface&&) noexcept;
  VaultSurface& operator=(const VaultSurface&);
  VaultSurface& operator=(VaultSurface&&) noexcept;
  ~VaultSurface();

  SurfaceTraits traits() const {
    return {.closed = plan.closed(),
            .thrust_lines = plan.closed()                             ? Sheet::ThrustLines::by_azimuth
                            : plan.kind == Plan::Kind::groin          ? Sheet::ThrustLines::radial
                            : profile.kind == Profile::Kind::straight ? Sheet::ThrustLines::none
                                                                      : Sheet::ThrustLines::one};
  }
};
constexpr auto enum_names(VaultSurface::Beds) {
  return std::array{"normal", "conical", "level"};
}
constexpr auto enum_names(VaultSurface::Courses) {
  return std::array{"length", "height"};
}
constexpr auto enum_names(VaultSurface::Line) {
  return std::array{"intrados", "middle", "extrados"};
}

using Surface = std::variant<DomeSurface, OctagonalVault, ArchSurface, WallSurface, VaultSurface>;

inline SurfaceTraits traits_of(const Surface& surface) {
  return std::visit([](const auto& kind) { return kind.traits(); }, surface);
}

// Every bond has `refine`, which splits each course into that many courses and each block into that many
// blocks in the same bond. Counts and default phases below are those before refinement. Blocks stay as thick
// as the shell.

/// Running bond: every ring has the same number of blocks; odd rings are shifted by half a block. On a wall,
/// odd courses end in half blocks.
struct RunningBond {
  int rings = 40;            ///< courses, >= 1
  int blocks_per_ring = 32;  ///< >= 1 on a wall, >= 3 on a dome
  int slices_per_block = 4;  ///< azimuthal cells per block, even
  /// Block widths from the first corner to the first head joint; none: 1/4 on a vault with corners, so that
  /// no joint lies on a corner, else 0.
  std::optional<double> phase = {};
  int refine = 1;  ///< >= 1
};

/// Stack bond: all head joints aligned.
struct StackBond {
  int rings = 40;
  int blocks_per_ring = 32;
  int slices_per_block = 4;
  std::optional<double> phase = {};  ///< as in RunningBond
  int refine = 1;                    ///< >= 1
};

/// Narrow upright blocks ("verticals") that climb through whole blocks laid flat. On closed surfaces they
/// form spirals that advance by the width of one vertical per ring; on a wall, one diagonal from corner to
/// corner.
struct HerringboneBond {
  enum class Chirality : std::uint8_t { right, left, both };
  enum class Path : std::uint8_t { spiral, meridian };
  /// Head joints of the flat blocks: step with the spirals, keep a half bond, or lie on meridians.
  enum class Beside : std::uint8_t { stepped, half, aligned };

  int rings = 40;
  int blocks_per_ring = 32;     ///< whole blocks that would fill a ring
  int spirals = 8;              ///< also the number of meridian strips
  int rings_per_vertical = 3;   ///< height of a vertical
  int verticals_per_block = 3;  ///< width of a whole block over the width of a vertical
  Path path = Path::spiral;     ///< `meridian`: strips that climb straight up
  Chirality chirality =
      Chirality::right;  ///< right: climbs counter-clockwise seen from above; both: they cross
  /// Courses by which the upright of a spiral in the last course stands in the courses below, from 0 to
  /// rings_per_vertical - 1. Each course then crosses one upright of each spiral. -1: one new upright per
  /// spiral and course, so that each course crosses uprights of every embedment.
  int embedment = -1;
  Beside beside = Beside::stepped;
  std::optional<double> phase = {};  ///< block widths from the first corner to the first spiral's start;
                                     ///< none: 1/6 on a vault with corners, else 0
  int slices_per_vertical = 1;       ///< azimuthal cells per vertical
  int refine = 1;                    ///< >= 1; each spiral becomes that many spirals side by side in its band
};
constexpr auto enum_names(HerringboneBond::Chirality) {
  return std::array{"right", "left", "both"};
}
constexpr auto enum_names(HerringboneBond::Path) {
  return std::array{"spiral", "meridian"};
}
constexpr auto enum_names(HerringboneBond::Beside) {
  return std::array{"stepped", "half", "aligned"};
}

/// Whole blocks of unequal width, chosen ring by ring (dynamic programming) so that head joints avoid the
/// joints of the ring below and the corners of the vault.
struct FillBond {
  int rings = 40;
  int blocks_per_ring = 32;  ///< sets the mean width
  int slices_per_block = 8;  ///< head joints lie at multiples of the mean width over this
  double narrowest = 0.75;   ///< of the mean width, in (0, 1]
  double widest = 1.25;      ///< of the mean width, >= 1
  int refine = 1;            ///< >= 1
};

/// A bond drawn in letters. Cell (c, r) of the infinite pattern, r upwards from the first course, has the
/// letter rows[R - 1 - r mod R][(c - shift * floor(r / R)) mod C] of the R rows of C letters, as seen from
/// outside. The cells of one letter that are connected through their faces form a block; `.` is empty.
struct DrawnBond {
  int rings = 40;
  std::vector<std::string> rows;  ///< the uppermost course first, all of one length
  double letter_length = 0.1;     ///< m, > 0, along the intrados of the first bed
  int shift = 0;  ///< letters by which the drawing moves along where it is repeated above itself
  std::optional<double> phase =
      {};          ///< letters from the first corner, or the end of a wall, to the drawing; none: 1/2 on
                   ///< a vault with corners, so that no joint lies on a corner, else 0
  int refine = 1;  ///< >= 1

  char letter(int column, int row) const;  ///< of a cell of the infinite pattern
};

using Bond = std::variant<RunningBond, StackBond, HerringboneBond, FillBond, DrawnBond>;

/// A thickness that varies over the height: values between `heights`, constant beyond both ends.
struct Thickness {
  std::vector<double> heights;      ///< m above the springing, ascending
  std::vector<double> values{1.0};  ///< m, > 0, one per height; one without heights

  bool constant() const { return values.size() == 1; }
  double at(double height) const;  ///< m
};

/// Heights above the springing, m, between which a wythe or its bonders exist. A course belongs to the range
/// in which the middle of its intrados at a corner lies.
struct HeightRange {
  double from = 0.0;              ///< >= 0
  std::optional<double> to = {};  ///< none: to the top

  bool contains(double height) const { return height >= from && (!to || height < *to); }
};

/// One layer of the thickness, as of a wall of two leaves or a dome of two shells.
struct Wythe {
  std::string name;
  Thickness thickness;
  std::optional<Bond> bond = {};  ///< none: a cavity, empty where no bonder crosses it
  HeightRange where;
};

/// Blocks through several wythes, one course high: headers of a wall, ribs, the solid base of two shells. In
/// the courses selected, `per_ring` of them stand at equal spacing and replace what the wythes have there.
struct Bonders {
  std::string name;
  std::string from, to;         ///< the first and the last wythe that they occupy, inside first
  int per_ring = 1;             ///< >= 1, of each position in `at`
  std::vector<double> at{0.5};  ///< middles, in spacings from abscissa 0 (the first corner), in [0, 1)
  double width = 1.0;           ///< over the spacing, in (0, 1]
  double shift = 0.0;           ///< spacings by which every other of these courses is moved, in [0, 1)
  int every = 1;                ///< courses from one to the next, >= 1
  int first = 0;                ///< courses of the height range below the first
  HeightRange where;
};

/// How a wall or shell is built up through its thickness.
struct Masonry {
  Bond bond = RunningBond{};  ///< of the whole thickness
  /// Layers through the thickness, inside first. If there are any, `bond` and a single thickness are ignored.
  std::vector<Wythe> wythes;
  std::vector<Bonders> bonders;
};

/// Rectangular openings of a closed, upright member, all of one size. Their jambs are head planes of the
/// surface, and a lintel in one block through the whole thickness covers each.
struct Openings {
  int per_ring = 0;             ///< of each position in `at`; 0: one on each side of the plan
  std::vector<double> at{0.5};  ///< middles, in spacings from abscissa 0 (the first corner), in [0, 1)
  double width = 0.0;           ///< m, > 0, on the intrados
  double height = 0.0;          ///< m, > 0
  double sill = 0.0;            ///< m, >= 0, height of the lower edge above the first bed
  double lintel = 0.0;          ///< m, >= 0, height of the lintel; 0: one course
  double bearing = 0.5;         ///< m, > 0, of the lintel beyond each jamb, on the intrados
};

/// A convex body that a member loses: a half-space, or a prism.
struct Cut {
  enum class Kind : std::uint8_t { plane, prism, cylinder, under };
  enum class Axis : std::uint8_t { x, y, z };
  /// What lies behind the faces of the cut: nothing, a fixed support, or the same stones, parted by a joint.
  enum class As : std::uint8_t { free, held, joint };
  enum class Face : std::uint8_t { extrados, intrados };

  Kind kind = Kind::plane;
  As as = As::free;
  Eigen::Vector3d point = Eigen::Vector3d::Zero();    ///< m, of a plane
  Eigen::Vector3d normal = Eigen::Vector3d::UnitX();  ///< not 0, into what is lost
  Axis axis = Axis::y;                                ///< along a prism or cylinder
  std::vector<double> u,
      v;  ///< m, corners of the convex outline of a prism: (y, z), (x, z) or (x, y) across its axis
  double centre_u = 0.0, centre_v = 0.0, radius = 1.0;  ///< m, of a cylinder, a prism over a regular polygon
  int sides = 16;                                       ///< >= 3, of that polygon
  std::optional<double> from, to;                       ///< m, along the axis; none: without end
  std::string member;          ///< a barrel: what lies under its `face`, from end to end, is taken away
  Face face = Face::extrados;  ///< of that member
};
constexpr auto enum_names(Cut::Axis) {
  return std::array{"x", "y", "z"};
}
constexpr auto enum_names(Cut::As) {
  return std::array{"free", "held", "joint"};
}
constexpr auto enum_names(Cut::Face) {
  return std::array{"extrados", "intrados"};
}

/// Where a member stands.
struct Place {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< m
  double rotate_deg = 0.0;                           ///< about the vertical through the origin
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
  std::string on;           ///< name of the member on whose last bed it stands; "": on supports of its own
  std::optional<Place> at;  ///< none: at the origin, or on the axis of the member below
  std::optional<Copies> copies;
  Surface surface = DomeSurface{};
  std::vector<Openings> openings;
  std::vector<Cut> cuts;  ///< in its own coordinates, before `at`
};

/// A part of a dome or vault, of which only some courses over a sector are cut: masonry at the scale of
/// bricks.
struct Window {
  /// `held`: fixed masonry stands beyond the two ends, as if the rest of the ring were built.
  enum class Ends : std::uint8_t { free, held };

  double height = 0.0;    ///< m, > 0, on the intrados at a corner: of the bed under the last course built
  double course = 0.06;   ///< m, > 0: height of the courses, along the intrados at a corner
  double from_deg = 0.0;  ///< azimuth of the right end, seen from outside
  double to_deg = 45.0;   ///< azimuth of the other end, above from_deg and at most from_deg + 360
  Ends ends = Ends::free;
};
constexpr auto enum_names(Window::Ends) {
  return std::array{"free", "held"};
}

/// A closed chain round a dome or vault: a level in the masonry, and the bars that go round it there.
struct Chain {
  /// `polygon`: straight bars between anchors in the masonry. `clamps`: a bar across each head joint, as of a
  /// course of stone clamped with iron.
  enum class Type : std::uint8_t { polygon, clamps };

  std::string name;
  Type type = Type::polygon;
  int course = -1;               ///< in whose middle it lies, counted before refinement; -1: at `height`
  std::optional<double> height;  ///< m, z of all anchors
  double place = 0.5;            ///< in the thickness, in (0, 1): 0 intrados, 1 extrados
  int links = 0;  ///< of a polygon, equal in azimuth, the first from a corner; 0: from block to block
  double clamp_length = 0.3;          ///< m, > 0, half on each side of the joint
  int long_blocks = 0;                ///< equal blocks that replace those of the bond in the course; 0: none
  double axial_stiffness = 1e9;       ///< N, > 0, E A of a bar
  std::optional<double> yield_force;  ///< N, > 0; none: elastic without limit
  double slack = 0.0;                 ///< m, >= 0, of each bar; 0 with prestress
  double prestress = 0.0;             ///< N, >= 0, tension as built
};
constexpr auto enum_names(Chain::Type) {
  return std::array{"polygon", "clamps"};
}

/// A map of all points of the masonry, which keeps planes and convexity: elliptic domes, raking barrels.
/// Thicknesses and angles are those before the map.
struct Affine {
  Eigen::Vector3d scale = Eigen::Vector3d::Ones();  ///< along the axes, > 0
  double rake = 0.0;                                ///< rise of z per m of y, of a barrel

  Eigen::Vector3d image(const Eigen::Vector3d& point) const {
    Eigen::Vector3d p = scale.cwiseProduct(point);
    p.z() += rake * p.y();
    return p;
  }
};

struct Stage {
  int rings = 0;  ///< rings built so far, >= 1
};

/// Random deviations from the ideal geometry. All faces stay plane.
struct Imperfections {
  double gap = 0.0;    ///< m, >= 0: every bed and head of every block recedes by up to half of this
  double noise = 0.0;  ///< m, >= 0: beds, head planes and skin corners move by up to this; joints stay closed
  int seed = 1;        ///< >= 0
};

/// Density of some imported blocks.
struct BlockDensity {
  std::vector<std::string> blocks;  ///< names
  double density = 0.0;             ///< kg/m3, > 0
};

/// Imported blocks, instead of a surface and a bond.
struct ImportedBlocks {
  enum class Format : std::uint8_t { automatic, obj, off, stl, ply, compas, bricks };
  enum class UpAxis : std::uint8_t { z, y };
  /// Blocks that are fixed besides those that are named or flagged. `lowest`: with a corner in the lowest
  /// plane of the model. `one_neighbour`: with a single joint, as the ends of an arch have.
  enum class SupportRule : std::uint8_t { none, lowest, one_neighbour };

  std::string path;                       ///< file, or folder of files
  Format format = Format::automatic;      ///< automatic: by the file name extension
  std::optional<double> metres_per_unit;  ///< > 0; none: 1, if the size of the model is that of a structure
  UpAxis up = UpAxis::z;                  ///< of the file; y up is rotated to z up about x
  std::vector<std::string> supports;      ///< names of fixed blocks
  bool flagged_supports = true;           ///< also fix blocks that the file marks as fixed
  std::optional<double> fixed_below;      ///< m: also fix blocks whose centroid lies below this z
  SupportRule fixed_by = SupportRule::none;
  std::optional<Eigen::Vector3d>
      axis;  ///< m, a point of the vertical axis from which `outward` points; none: from the supports
  std::vector<BlockDensity>
      densities;              ///< override those of the file, which override the material of the case
  std::string springs, rods;  ///< files of ties, brick CSV; "" for none
  /// rad, > 0: neighbouring triangles form a facet if their normals agree within this and their vertices lie
  /// within this times the block size of one plane.
  /// None: chosen from the deviations of the faces from planes (generators/importer/flatness.hpp).
  std::optional<double> facet_angle;
  /// m: facing facets within this distance of a common plane are moved into it; 0: none; without a value: 4
  /// times the deviation of the faces from planes.
  std::optional<double> snap;
};
constexpr auto enum_names(ImportedBlocks::Format) {
  return std::array{"automatic", "obj", "off", "stl", "ply", "compas", "bricks"};
}
constexpr auto enum_names(ImportedBlocks::UpAxis) {
  return std::array{"z", "y"};
}
constexpr auto enum_names(ImportedBlocks::SupportRule) {
  return std::array{"none", "lowest", "one_neighbour"};
}

/// What is built: `members`, and behind them the one member that this is itself.
struct Geometry : Member {
  std::optional<ImportedBlocks> imported;  ///< if set, all that follows is ignored
  std::vector<Member> members;             ///< a member follows the one on which it stands
  bool has_shell = true;                   ///< false: all members are in the list
  std::optional<Affine> affine;
  std::optional<Window> window;
  std::optional<Stage> stage;
  std::vector<Chain> chains;
  std::optional<Imperfections> imperfections;  ///< from the section `imperfections` of the case
  double support_width = 1.0;  ///< m, > 0, distance by which the fixed base extends beyond the shell
  /// >= 1: equal parts of the fixed ring, which may move separately; the first about the first corner.
  int base_blocks = 1;
};

/// All members, in the order of their courses; `window`, `stage` and `chains` belong to the last.
std::vector<const Member*> members_of(const Geometry& geometry);
/// "geometry.members[i]", or "geometry" behind them.
std::string key_of_member(const Geometry& geometry, size_t i);
inline const Member& last_member(const Geometry& geometry) {
  return *members_of(geometry).back();
}

/// The bond of the masonry, or those of its wythes.
std::vector<const Bond*> bonds_of(const Masonry& masonry);
/// The one with the most courses, whose beds all wythes share.
const Bond* finest_bond(const Masonry& masonry);

/// Number of courses after refinement.
int rings_of(const Bond& bond);

}  // namespace cupola

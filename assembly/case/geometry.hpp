#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include <Eigen/Core>

#include "assembly/base/named_enum.hpp"
#include "assembly/case/imported_blocks.hpp"
#include "assembly/case/member.hpp"

namespace cupola {

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

/// A closed chain round a dome or vault, or tie rods across a barrel: a level in the masonry, and the bars
/// there.
struct Chain {
  /// `polygon`: straight bars between anchors in the masonry. `clamps`: a bar across each head joint, as of a
  /// course of stone clamped with iron. `rods`: a bar from one side of a barrel to the other at each of `at`.
  enum class Type : std::uint8_t { polygon, clamps, rods };

  std::string name;
  std::string member;  ///< in which it lies, or a copy of it; "": the last
  Type type = Type::polygon;
  int course = -1;               ///< in whose middle it lies, counted before refinement; -1: at `height`
  std::optional<double> height;  ///< m, z of all anchors in the frame of the member
  double place = 0.5;            ///< in the thickness, in [0, 1]: 0 intrados, 1 extrados
  std::vector<double> at;        ///< m along a barrel, of rods; none: one in the middle
  int links = 0;  ///< of a polygon, equal in azimuth, the first from a corner; 0: from block to block
  double clamp_length = 0.3;          ///< m, > 0, half on each side of the joint
  int long_blocks = 0;                ///< equal blocks that replace those of the bond in the course; 0: none
  double axial_stiffness = 1e9;       ///< N, > 0, E A of a bar
  std::optional<double> yield_force;  ///< N, > 0; none: elastic without limit
  double slack = 0.0;                 ///< m, >= 0, of each bar; 0 with prestress
  double prestress = 0.0;             ///< N, >= 0, tension as built
};
constexpr auto enum_names(Chain::Type) {
  return std::array{"polygon", "clamps", "rods"};
}

struct Stage {
  int rings = 0;  ///< rings built so far, >= 1
};

/// Random deviations from the drawing. All faces stay plane.
struct Imperfections {
  double gap = 0.0;    ///< m, >= 0: every bed and head of every block recedes by up to half of this
  double noise = 0.0;  ///< m, >= 0: beds, head planes and skin corners move by up to this; joints stay closed
  int seed = 1;        ///< >= 0
  /// m, > 0: gaps and noise are functions of place, whose normal numbers have the correlation
  /// exp(-(r / length)^2) over the distance r; bonds of one seed read the same functions. None: each number
  /// is independent.
  std::optional<double> correlation_length = std::nullopt;
  /// Coefficient of variation of the density of free blocks, a lognormal function of place with mean 1.
  double density = 0.0;

  bool of_shape() const { return gap > 0.0 || noise > 0.0; }
};

/// What is built: `members`, and behind them the one member that this is itself.
struct Geometry : Member {
  std::optional<ImportedBlocks> imported;  ///< if set, all that follows is ignored
  std::vector<Member> members;             ///< a member follows the one on which it stands
  bool has_shell = true;                   ///< false: all members are in the list
  std::optional<Window> window;
  std::optional<Stage> stage;
  std::vector<Chain> chains;
  std::optional<Imperfections> imperfections;  ///< from the section `imperfections` of the case
  double support_width = 1.0;  ///< m, > 0, distance by which the fixed base extends beyond the shell
  /// >= 1: equal parts of the fixed ring, which may move separately; the first about the first corner.
  int base_blocks = 1;
};

/// All members, in the order of their courses; `window` and `stage` belong to the last.
std::vector<const Member*> members_of(const Geometry& geometry);
/// The member with a name, also if it is that of a copy, "NAME 2"; the last for "", null for others.
const Member* member_named(const Geometry& geometry, const std::string& name);
/// "geometry.members[i]", or "geometry" behind them.
std::string key_of_member(const Geometry& geometry, size_t i);
/// Its own, or that of the geometry.
inline const std::optional<Affine>& affine_of(const Geometry& geometry, const Member& member) {
  return member.affine ? member.affine : geometry.affine;
}
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

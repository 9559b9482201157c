#pragma once

#include <optional>
#include <string>
#include <vector>

#include "assembly/model/assembly.hpp"
#include "assembly/model/block_ref.hpp"
#include "assembly/model/time_function.hpp"

namespace cupola {

/// Upper end of an open range of rings.
constexpr int kLastRing = 1 << 20;

/// Weight distributed over the top faces by area, as vertical forces at the face centroids: the lantern of a
/// dome or the load on top of a wall.
struct TopLoad {
  double weight_fraction = 0.0;  ///< of the weight of the free blocks, >= 0
  double weight = 0.0;           ///< N, >= 0, in addition
  double mass = 0.0;             ///< kg, >= 0, in addition

  /// N, with the weight of the free blocks (N) under gravity `g` (m/s2).
  double total(double free_weight, double g) const {
    return weight_fraction * free_weight + weight + mass * g;
  }
};

/// Free blocks that share a force in proportion to their volumes.
struct SharingBlocks {
  int course = -1;     ///< first ring of the blocks; -1: any
  std::string member;  ///< see Assembly::members; empty: any
};

/// A rectangle over which a force is spread on the surface of a fill, and how it widens on its way down to
/// the masonry.
struct Spread {
  double x = 1.0, y = 1.0;  ///< m, > 0, its sides along the world axes, about the point of the force
  double slope = 0.5;       ///< >= 0, by which each side moves outwards per m of depth
};

/// A force of constant direction, and a moment, on a block; or a force shared by many.
struct BlockForce {
  static constexpr int kAtPoint = -1;
  BlockRef block;             ///< kAtPoint: the free block that contains `point`, or the nearest
  std::optional<Vec3> point;  ///< m, world, as built; none: the centroid
  Vec3 force = Vec3::Zero();  ///< N
  TimeFunction time;
  /// N m. Couples of forces of constant direction at points that move with the block, so that it falls with
  /// the cosine of the block's rotation about it.
  std::optional<Vec3> moment = {};
  std::optional<SharingBlocks> over = {};  ///< instead of block, point and moment
  std::optional<Spread> spread = {};       ///< instead of a block: on the extrados below `point`

  bool is_at_point() const { return block == kAtPoint && point && !over && !spread; }
};

/// Backing or fill with a level surface. On a face of the masonry its vertical stress is the weight of the
/// column above, and acts along gravity; the horizontal one is a share of it, on the upright part of the
/// face. Faces that do not look up carry the horizontal one only, where it lies before them
/// (beside_fill()).
struct Fill {
  double level = 0.0;          ///< m, z of its surface
  std::optional<double> from;  ///< m, z below which there is other material; none: it lies on the masonry
  double unit_weight = 0.0;    ///< N/m3, > 0, under standard gravity
  double horizontal = 0.0;     ///< >= 0, horizontal over vertical stress

  double stress(double z) const;  ///< N/m2, vertical
};

/// A traction of constant direction, a pressure normal to the as-built faces, or a fill, on all faces of one
/// kind.
struct FaceLoad {
  FaceKind faces = FaceKind::extrados;
  int from_ring = 0, to_ring = kLastRing;  ///< rings of the parts, inclusive
  std::string member = {};                 ///< of the blocks, see Assembly::members; empty: all
  Vec3 traction = Vec3::Zero();            ///< N/m2, world
  double pressure = 0.0;                   ///< N/m2, positive into the block
  TimeFunction time;
  std::optional<Fill> fill = {};
};

/// A factor that varies with the azimuth phi about the axis of the masonry: cos(waves (phi - phase)).
struct AzimuthProfile {
  int waves = 1;           ///< >= 1, around the axis
  double phase_deg = 0.0;  ///< deg, azimuth of a crest, from its x axis
};

/// Azimuths about the axis of the masonry from `from_deg` counter-clockwise to below `to_deg`.
struct Sector {
  double from_deg = 0.0, to_deg = 360.0;  ///< deg; to > from, by at most 360
};

/// Blocks by name or number, those of a member and those whose centroids lie in a sector. What is left out
/// does not restrict.
struct BlockRegion {
  std::vector<BlockRef> blocks = {};  ///< empty: all
  std::string member = {};            ///< see Assembly::members; empty: any
  std::optional<Sector> sector = {};
  std::optional<AzimuthProfile> profile =
      {};  ///< factor at the azimuth of the centroid of each block; none: 1
};

/// Change of temperature of blocks, linear over each: change + gradient . x, x from the centroid. No other
/// field leaves a free rigid block without stress.
struct BlockHeat {
  BlockRegion region = {};
  double change = 0.0;           ///< K, at the centroid
  double through = 0.0;          ///< K/m, its growth along the outward normal of the block's extrados
  Vec3 gradient = Vec3::Zero();  ///< K/m, its growth along the world axes, in addition
  double expansion = 0.0;        ///< 1/K, > 0, thermal strain per change
  bool ground = false;           ///< the fixed blocks expand with the others, as one body
  TimeFunction time = {};
};

struct Loads {
  Vec3 gravity{0.0, 0.0, -9.81};  ///< m/s2
  Vec3 pull = Vec3::Zero();       ///< m/s2, of all that weighs, in full at any time: see case_at()
  std::optional<TopLoad> lantern;
  std::optional<TopLoad> top_load;
  /// Factor on gravity, lantern, top load and fill without `time`: a ramp applies the dead load gradually.
  TimeFunction dead_load_time;
  std::vector<BlockForce> forces;
  std::vector<FaceLoad> faces;
  std::vector<BlockHeat> heat = {};
};

/// A tie between points of two blocks, as built. It carries tension when longer than its natural length, and
/// nothing when shorter. Its tension is at most `yield_force`, where it elongates plastically.
struct PairTie {
  BlockRef block_a, block_b;
  std::optional<Vec3> point_a, point_b;  ///< m, world; none: the centroid
  double stiffness = 1e8;                ///< N/m, > 0
  double prestress = 0.0;                ///< N, tension as built, >= 0
  double slack = 0.0;                 ///< m, >= 0, elongation at which it begins to carry; 0 with prestress
  std::optional<double> yield_force;  ///< N, > 0; none: elastic without limit
};

/// Ties of the case, in addition to those of the assembly (chains, imported springs and rods).
struct Ties {
  std::vector<PairTie> pairs;
  double rod_stiffness = 1e10;  ///< N/m, > 0, replaces the infinite one of imported rigid rods
};

/// Ground motion: all fixed blocks move together.
struct BaseMotion {
  enum class Quantity { displacement, acceleration };
  std::string file;  ///< two columns: time (s) and value (m or m/s2)
  Quantity quantity = Quantity::displacement;
  Vec3 direction{1.0, 0.0, 0.0};  ///< scales the values of the file; m per unit
};
constexpr auto enum_names(BaseMotion::Quantity) {
  return std::array{"displacement", "acceleration"};
}

/// Displacement and rotation imposed on the fixed blocks of a region.
struct SupportMove {
  BlockRegion region = {};
  Vec3 displacement = Vec3::Zero();  ///< m
  double outward = 0.0;   ///< m, horizontally away from the axis of the masonry on each block, in addition
  double tilt_deg = 0.0;  ///< deg, about the centroid of each block, whose top turns outwards
  Vec3 rotation_deg = Vec3::Zero();  ///< deg, rotation vector about `pivot`
  Vec3 pivot = Vec3::Zero();         ///< m
  TimeFunction time;
};

/// Holds a point of a block in one direction, both ways and without friction, against the ground.
struct Restraint {
  BlockRef block;
  std::optional<Vec3> point;       ///< m, world, as built; none: the centroid
  Vec3 direction = Vec3::UnitX();  ///< not zero; its length does not matter
  double stiffness = 1e10;         ///< N/m, > 0
};

struct Supports {
  std::optional<BaseMotion> base_motion;
  std::vector<SupportMove> moves;
  std::vector<Restraint> restraints;
  bool moving() const { return base_motion.has_value() || !moves.empty(); }
};

}  // namespace cupola

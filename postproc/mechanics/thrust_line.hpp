#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "assembly/model/applied_loads.hpp"
#include "postproc/mechanics/joint_wrenches.hpp"
#include "postproc/mechanics/poses.hpp"
#include "postproc/mechanics/shell.hpp"

namespace cupola {

/// The resultant of a meridian strip across one bed. Of a wythe: its skins are those of the wythe.
///
/// Its position is undefined if the resultant runs along the bed or is negligible: `position`, `point`,
/// `face_distance` and `geometric_safety` are then NaN, and so is the couple length of a negligible one.
struct ThrustPoint {
  int bed = 0;              ///< its number in the stack
  int blocks = 0;           ///< number of blocks in the strip
  Vec3 intrados, extrados;  ///< m, of the bed in the meridian plane
  /// Through the thickness: 0 on the intrados, 1 on the extrados.
  double position = std::numeric_limits<double>::quiet_NaN();
  Vec3 point = Vec3::Zero();      ///< m, of the thrust line
  Vec3 force = Vec3::Zero();      ///< N, on the part further along, turned into the meridian plane
  double r = 0.0;                 ///< N, norm of the resultant
  double v = 0.0;                 ///< N, its vertical component
  double couple_length = 0.0;     ///< m
  double face_distance = 0.0;     ///< m, to the nearer skin along the bed, negative outside
  double geometric_safety = 0.0;  ///< half the thickness over the eccentricity; infinite when centred
  /// The outermost contact points of the strip's blocks that push on the bed, as `position`, and the normal
  /// force of those that push over their area. NaN if none does, as where the bed runs through the blocks.
  double compressed_from = std::numeric_limits<double>::quiet_NaN();
  double compressed_to = std::numeric_limits<double>::quiet_NaN();
  double pressure = std::numeric_limits<double>::quiet_NaN();  ///< Pa
  double height() const { return 0.5 * (intrados.z() + extrados.z()); }
  bool is_placed() const { return std::isfinite(position); }
};

/// Thrust line of a meridian (paper, section 3.2).
///
/// The strip consists of the same blocks wherever they stand: as built it is one standard block wide and
/// centred on the meridian. On every bed:
///
/// - Each block in the strip counts with the share of its width that lies inside, and its wrench is turned
///   about the axis into the meridian plane. Where a herringbone crosses, several narrow blocks share the
///   strip.
/// - Of a stone round the axis, as a key stone, whose horizontal forces cancel, each joint on the bed counts
///   in the same way.
/// - If the bed runs through a block, the wrench is the one that balances the piece of the block above the
///   bed: its weight, its contact forces, and the loads and ties that act on it. A load at the bed itself is
///   on the piece; a moment acts at the centroid of the block.
/// - The position of each block's resultant is measured through the thickness on the block's own bed. The
///   position of the strip is the mean of these, weighted by the normal forces on the bed, and is drawn on
///   the meridian. In an arch and in a shell with wythes it is the mean over the contact points, weighted in
///   the same way.
///
/// The thrust line of a wythe takes the joints that lie in it, see wythes_of(). Where a block of the strip
/// rests on a joint that lies in several wythes, as a bonder on a bonder, nothing tells how its force is
/// shared among them: the line of the wythe has no point there. At its points, the forces of all wythes add
/// up to that of the whole thickness.
struct ThrustLine {
  std::string name;
  double azimuth_deg = 0.0;         ///< about its axis, from the x axis of that sheet
  Sheet axis;                       ///< the lowest sheet of its stack
  bool arch = false;                ///< along an arch, without azimuth
  std::optional<int> wythe;         ///< none: of the whole thickness
  std::vector<ThrustPoint> points;  ///< from the springing upwards
  std::vector<Vec3> envelope;       ///< m, intersections of successive lines of action
  int undefined = 0;                ///< number of points of undefined position
  int without_skins = 0;            ///< further beds, whose blocks have no inner or outer edge in the strip
  bool inside = false;  ///< every point of defined position lies between the skins or on one of them
  double least_face_distance = 0.0;  ///< m
  double least_geometric_safety = 0.0;
  double largest_couple_length() const;  ///< m, of its points
  /// m, its points in runs of at least two: it is interrupted where its position is undefined, that of a
  /// wythe also at beds without a point.
  std::vector<std::vector<Vec3>> runs() const;
};

/// The data of one frame that all thrust lines use.
struct ThrustInput {
  const Assembly* assembly = nullptr;
  const Shell* shell = nullptr;
  const ContactTable* contacts = nullptr;
  const JointWrenches* joints = nullptr;
  std::vector<Wrench> from_below;
  Vec3 gravity = Vec3::Zero();
  Poses poses = {};
  std::vector<PointForce> loads = {};  ///< those of ties included, in the order of their blocks
};

/// Wrench across a bed within the width of one block: on the part above, about the block's centroid. If the
/// bed runs through the block, it is the wrench that balances the piece of the block above the bed.
Wrench wrench_at_bed(const ThrustInput& input, int block, int bed);

/// Thrust line along a meridian of the stack with the course `ring`, about its axis. Without azimuth: along
/// an arch, where the strip is the full width. Without wythe: of the whole thickness.
ThrustLine thrust_line(const ThrustInput& input, const std::string& name, std::optional<double> azimuth_deg,
                       std::optional<int> wythe = std::nullopt, int ring = 0);

}  // namespace cupola

#pragma once

#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <vector>

#include "postproc/mechanics/joint_wrenches.hpp"
#include "postproc/mechanics/shell.hpp"

namespace cupola {

/// The resultant that crosses one bed of a meridian strip. Where it runs along the bed or is nothing but
/// rounding it has no place in the thickness: position, point, distance and safety are NaN.
struct ThrustPoint {
  int bed = 0;
  int blocks = 0;           ///< blocks that the strip meets
  Vec3 intrados, extrados;  ///< m, of the bed in the meridian plane
  double position =
      std::numeric_limits<double>::quiet_NaN();  ///< through the thickness: 0 intrados, 1 extrados
  Vec3 point = Vec3::Zero();                     ///< m, of the thrust line
  Vec3 force = Vec3::Zero();                     ///< N, on the upper side, turned into the meridian plane
  double r = 0.0;                                ///< N, norm of the resultant
  double v = 0.0;                                ///< N, its vertical component
  double couple_length = 0.0;                    ///< m
  double face_distance = 0.0;                    ///< m, to the nearer skin along the bed, negative outside
  double geometric_safety = 0.0;  ///< half the thickness over the eccentricity; infinite when centred
  double height() const { return 0.5 * (intrados.z() + extrados.z()); }
  bool is_placed() const { return std::isfinite(position); }
};

/// Thrust line of a meridian (paper 3.2).
///
/// The strip is one standard block wide and centred on the meridian. Each block that it meets counts with the
/// share of its width inside, its wrench turned about the axis into the meridian plane; where a herringbone
/// crosses, these are its narrow blocks together. A bed that runs inside a block carries the wrench that
/// balances the block's upper piece. Where the resultant crosses a block's bed is told as a position through
/// the thickness, measured on that block, and drawn at the same position on the meridian. Several blocks
/// count by how hard they press on the bed.
struct ThrustLine {
  std::string name;
  double azimuth_deg = 0.0;
  std::vector<ThrustPoint> points;   ///< from the springing upwards
  std::vector<Vec3> envelope;        ///< m, where successive lines of action meet
  int undefined = 0;                 ///< points without a place in the thickness
  bool inside = false;               ///< every point that has one lies between the skins
  double least_face_distance = 0.0;  ///< m
  double least_geometric_safety = 0.0;
};

/// What the thrust lines of one frame share.
struct ThrustInput {
  const Assembly* assembly = nullptr;
  const Shell* shell = nullptr;
  const ContactTable* contacts = nullptr;
  const JointWrenches* joints = nullptr;
  std::vector<Wrench> from_below;
  Vec3 gravity = Vec3::Zero();
};

/// Wrench that crosses a bed upwards within one block's width, on the part above, about the block's centroid.
/// A bed that runs inside the block carries the wrench that balances the block's upper piece.
Wrench wrench_at_bed(const ThrustInput& input, int block, int bed);

/// Along a meridian of a vault about the z axis; `azimuth_deg` none: along an arch, all blocks of a ring.
ThrustLine thrust_line(const ThrustInput& input, const std::string& name, std::optional<double> azimuth_deg);

}  // namespace cupola

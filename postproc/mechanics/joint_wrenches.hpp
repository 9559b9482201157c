#pragma once

#include <limits>
#include <vector>

#include "assembly/model/results.hpp"
#include "postproc/mechanics/floor.hpp"
#include "postproc/mechanics/planar_hull.hpp"
#include "postproc/mechanics/poses.hpp"
#include "postproc/mechanics/shell.hpp"
#include "postproc/mechanics/wrench.hpp"

namespace cupola {

/// A joint of one frame, summed over its contact points. A negligible joint counts as unloaded: its centre of
/// pressure is the centroid of the patch, and what follows from the direction or place of its force is NaN.
/// Where only its normal forces cancel, so is what follows from their place.
struct JointWrench : Joint {
  /// Blocks of a bed or base joint; -1 for other kinds, of an upright joint within a course, and where a support
  /// stands beside the stone.
  int upper = -1, lower = -1;
  /// The upper block, whose course the joint carries. -1 without one, and where the last course of an arch
  /// stands on another sheet: the joint is over that course, and carries none.
  int carried = -1;
  PlanarHull patch;   ///< hull of the contact points in their mean plane
  double area = 0.0;  ///< m2, sum over the contact points; the hull is larger where it fills in a bend or gap
  /// m, of its area: mean of the contact points weighted by their areas, on which the patch's hull may differ
  /// where it is not plane or not convex. Where outwards is measured.
  Vec3 centroid = Vec3::Zero();
  Wrench wrench;  ///< on block_b, about the centre of pressure
  CentralAxis axis;
  bool negligible = false;                 ///< its force is not above the floor of the frame
  Vec3 centre_of_pressure = Vec3::Zero();  ///< m, of the normal forces; the patch centroid if unloaded
  double couple_length = 0.0;              ///< m, on the central axis
  double normal_force = 0.0;               ///< N, sum over the points; 0 where they cancel
  double eccentricity = 0.0;               ///< m, distance of the centre of pressure from the patch centroid
  double edge_distance = 0.0;              ///< m, distance of the centre of pressure from the outline
  double kern = 0.0;                       ///< kern utilisation, at most 1 inside the kern; NaN on a line
  /// |tangential force| / (cohesion x area + mu x normal force), of the resultant: it does not depend on how
  /// its points share the force, and does not count turning about the normal. 1: the joint slides.
  double friction_use = 0.0;
  double opening = 0.0;           ///< m, widest at its points, >= 0: gap, or crack with strength
  double open_share = 0.0;        ///< share of the area whose points carry no normal force
  bool touches = false;           ///< the faces have not parted everywhere by more than contact.margin
  double slip = 0.0;              ///< m, largest accumulated slip of its points
  double largest_pressure = 0.0;  ///< Pa, largest normal force of a point over its area
  double strength_use =
      std::numeric_limits<double>::quiet_NaN();              ///< largest of its points; NaN in a dry joint
  double damage = std::numeric_limits<double>::quiet_NaN();  ///< mean over the area; NaN without bond
  int contact_start = 0, num_contacts = 0;                   ///< into JointWrenches::contacts
};

struct JointWrenches {
  std::vector<JointWrench> wrenches;       ///< in the order of the contacts' joint ids
  std::vector<int> contacts;               ///< contact rows sorted by joint
  std::vector<std::vector<int>> of_block;  ///< indices of the wrenches on each block, ascending
  Floor floor;
};

/// Sums the contacts of every joint. The upper block of a bed or base joint is the one further along the
/// shell in the direction from ring to ring; the right support of an arch therefore lies above its last
/// joint. A support beside a stone, as a wall, does not carry it. `unbalanced`: N, see floor_of().
JointWrenches joint_wrenches(const Assembly& assembly, const ContactTable& contacts, const Shell& shell,
                             double unbalanced = 0.0);

/// Fills of_block, as joint_wrenches does.
void index_by_block(size_t num_blocks, JointWrenches* joints);

/// The wythes in which a joint lies: those that both blocks occupy. Between two layers of the thickness,
/// where they share none, those of the block in the higher ring; in one ring, of block_b.
WytheRange wythes_of(const Assembly& assembly, const Shell& shell, const Joint& joint);

/// The wrench of the joint on `block`, which must be one of its two.
Wrench wrench_on(const JointWrench& joint, int block);

/// Wrench on each block from the ring below, about the block's centroid in these poses (paper, section 3.2):
/// the sum over the bed and base joints that carry it. Zero for blocks without such a joint.
std::vector<Wrench> wrenches_from_below(const Assembly& assembly, const JointWrenches& joints,
                                        const Poses& poses = {});

}  // namespace cupola

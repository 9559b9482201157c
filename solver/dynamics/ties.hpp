#pragma once

#include <limits>
#include <vector>

#include "assembly/case/case.hpp"
#include "solver/collision/contact_set.hpp"

namespace cupola {

/// A straight tie between points of two blocks, modelled as a frictionless contact along its axis with gap
///
///     phi = L0 + yielded - L   (positive when slack)
///
/// compliance 1/stiffness and, as compressive strength, the yield force: `yielded` is the plastic elongation
/// so far. A strut has phi = L - L0, pushes when it is shorter than L0, and does not yield. A restraint is a
/// tie and a strut whose direction does not turn with its ends: L is the distance of the ends along it. Its
/// end a moves with the ground, not with the fixed block that stands for it.
struct Tie {
  int block_a = 0, block_b = 0;                       ///< a < b but for restraints
  Vec3 p_AP_A = Vec3::Zero(), p_BP_B = Vec3::Zero();  ///< m, from the centroids, axes of the blocks
  double natural_length = 0.0;                        ///< L0, m
  double compliance = 0.0;                            ///< m/N, > 0
  bool strut = false;                                 ///< resists shortening instead of lengthening
  double yield_force = std::numeric_limits<double>::infinity();  ///< N, > 0, largest tension
  int chain = -1;                                                ///< index into Assembly::chains; -1: none
  Vec3 direction = Vec3::Zero();  ///< unit, world, of a restraint, from a to b; zero: along its ends
  Vec3 ground = Vec3::Zero();     ///< m, world, of a restraint: its end a at rest

  bool is_restraint() const { return !direction.isZero(); }
};

/// Position of a tie: its ends, and the direction of its force on b.
struct TieGeometry {
  Vec3 point_a = Vec3::Zero(), point_b = Vec3::Zero();  ///< m, world; the force acts along their line
  /// Unit, used like a contact normal: u_n > 0 slackens the tie, and a positive force acts on b along it.
  Vec3 normal = Vec3::UnitZ();
  double gap = 0.0;  ///< m, positive when slack, without plastic elongation
};
/// `ground`: its displacement (m), which the poses contain.
TieGeometry tie_geometry(const Tie& tie, const std::vector<Pose>& poses, const Vec3& ground);

/// The ends of a tie as the points of a contact. Restraints reach from the ground, which is no block.
Contact as_contact(const Tie& tie, const TieGeometry& now);

/// The ties of the case and of the assembly, and its restraints, which end on the first fixed block. A rigid
/// rod gives a tie and a strut. Throws InputError for blocks that do not exist, for ends that coincide, and
/// for restraints of fixed blocks or without one.
std::vector<Tie> make_ties(const Case& scene, const Assembly& assembly);

/// The strut of the bar to which tie k belongs, next behind its tie; -1: the bar only pulls.
int strut_of(const std::vector<Tie>& ties, int k);

/// Subtracts from tie and strut of each bar the force with which they press against each other. That of rigid
/// bars is arbitrary. `forces`: N, one per tie.
void remove_self_stress(const std::vector<Tie>& ties, std::vector<double>* forces);

}  // namespace cupola

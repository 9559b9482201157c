#pragma once

#include <stdexcept>
#include <vector>

#include "solver/dynamics/time_step.hpp"

namespace cupola {

/// An isometry that maps a model on itself, each block, contact and load on another one: a rotation about a
/// vertical axis, or a reflection in a vertical plane. Row numbers are those of StepProblem.
struct ModelSymmetry {
  Mat3 R;                     ///< of directions
  std::vector<int> blocks;    ///< image of each (nb)
  std::vector<int> contacts;  ///< image of each (nc)
  std::vector<char> swapped;  ///< block a of a contact maps to block b of its image (nc)

  VecX velocities(const VecX& v) const;                                 ///< of the blocks (6 nb)
  VecX forces(const ContactProblem& problem, const VecX& gamma) const;  ///< of the contacts (3 nc)
};

/// a after b.
ModelSymmetry operator*(const ModelSymmetry& a, const ModelSymmetry& b);

/// A model does not have a symmetry; the message says why.
struct NotSymmetric : std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// The images under x -> centre + R (x - centre). Throws NotSymmetric if the model has not this symmetry; the
/// message names the cause: the position, mass or load of a block, the position, gap or law of a contact,
/// ties, or moving supports.
ModelSymmetry find_symmetry(const Model& model, const State& start, const ContactSet& contacts, const Mat3& R,
                            const Vec3& centre);

/// The largest number of equal sectors around the vertical axis through the centre of mass.
int num_equal_sectors(const Model& model, const State& start, const ContactSet& contacts);

/// All symmetries of a model except the identity: rotations about the vertical axis through the centre of
/// mass, and reflections in planes through it.
std::vector<ModelSymmetry> find_symmetries(const Model& model, const State& start,
                                           const ContactSet& contacts);

}  // namespace cupola

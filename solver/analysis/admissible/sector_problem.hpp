#pragma once

#include "solver/analysis/admissible/rigid_scene.hpp"
#include "solver/analysis/statics/cyclic_symmetry.hpp"

namespace cupola {

/// The conic problem of one sector of a rigid scene with cyclic symmetry. The mean of a state over its
/// rotations is admissible too (the set is convex) and has the same value of an objective that repeats around
/// the axis. Such an objective therefore has the same range over the states that repeat as over all.
class SectorProblem {
 public:
  /// Throws InputError if the scene does not have the symmetry.
  SectorProblem(const RigidScene& scene, int sectors);

  int sectors() const { return symmetry_.sectors; }
  /// One block and one contact per orbit, without an objective.
  const ConicProblem& problem() const { return problem_; }
  /// The coefficients c (3 nc) of an objective of the whole model in the forces of the sector. None if it
  /// does not repeat around the axis, unless its mean over all rotations is meant.
  std::optional<VecX> coefficients(const VecX& whole, bool mean) const;
  /// The forces of the whole model (3 nc), from those of the sector.
  VecX whole_forces(const VecX& gamma) const;

 private:
  const RigidScene& scene_;
  CyclicSymmetry symmetry_;
  ConicProblem problem_;
};

}  // namespace cupola

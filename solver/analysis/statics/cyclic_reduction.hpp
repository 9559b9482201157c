#pragma once

#include "solver/analysis/statics/cyclic_symmetry.hpp"

namespace cupola {

/// The contact problem of the representatives: one block and one contact per orbit. The velocity of an image
/// is the rotated velocity of its representative.
ContactProblem reduce(const ContactProblem& problem, const CyclicSymmetry& symmetry);

/// Velocities and impulses of the representatives, from those of the whole problem. Empty vectors stay empty.
ContactSolution restrict(const ContactSolution& whole, const CyclicSymmetry& symmetry);

/// Velocities and impulses of the whole problem, from those of the representatives. `problem` is the whole
/// one.
ContactSolution expand(const ContactSolution& reduced, const ContactProblem& problem,
                       const CyclicSymmetry& symmetry);

}  // namespace cupola

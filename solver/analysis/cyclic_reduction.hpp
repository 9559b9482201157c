#pragma once

#include "solver/analysis/cyclic_symmetry.hpp"

namespace cupola {

/// The contact problem of the representatives. An image moves as its representative does, turned.
ContactProblem reduce(const ContactProblem& problem, const CyclicSymmetry& symmetry);

/// Velocities and impulses of the representatives among those of all; empty stays empty.
ContactSolution restrict(const ContactSolution& whole, const CyclicSymmetry& symmetry);

/// Velocities and impulses of all from those of the representatives; `problem` is the whole one.
ContactSolution expand(const ContactSolution& reduced, const ContactProblem& problem,
                       const CyclicSymmetry& symmetry);

}  // namespace cupola

#pragma once

#include "solver/conic/conic_problem.hpp"
#include "solver/contact/problem/whitening.hpp"

namespace cupola {

/// A conic problem in unknowns of order one: rows whitened by the masses, forces over the largest load of a
/// block, the objective over its largest coefficient.
struct ScaledConicProblem {
  ConicProblem problem;    ///< all but the columns of D, which are those of `white`
  WhitenedProblem white;   ///< of M over its mean mass; v = objective / force * to_v(scaled v)
  double force = 1.0;      ///< N: gamma = force * scaled gamma
  double objective = 1.0;  ///< c . gamma + e . t = objective * scaled value
  VecX multiplier;         ///< t = multiplier * scaled t (nt)
  VecX row;                ///< q = objective / row * scaled q (nq)
};

/// Keeps a reference to problem.contacts.
ScaledConicProblem scaled(const ConicProblem& problem);
ScaledConicProblem scaled(ConicProblem&&) = delete;

/// Throws std::invalid_argument if sizes do not match.
void check_sizes(const ConicProblem& problem);

}  // namespace cupola

#pragma once

#include "solver/contact/problem/solve_summary.hpp"
#include "tests/reference/delassus.hpp"

namespace cupola {

struct DelassusOptions {
  double tolerance = 1e-9;  ///< on the larger of fclib_merit and scaled_merit, > 0
  FlowRule law = FrictionLaw::coulomb;
  int max_outer_iterations = 500;  ///< >= 1
};

/// Solves problems in the local form, without masses and geometry (FCLIB files), by the proximal point
/// method:
///
///     gamma_(k+1) solves  gamma = Gamma(W gamma + q - R gamma_k),   R = share * trace W_ii / 3
///
/// Gamma is the impulse of a contact of compliance R (cone.hpp). Each subproblem is solved by semismooth
/// Newton with a sparse LU of I + G W and back-tracking. The share shrinks where Newton succeeds and grows
/// where it fails (Levenberg's rule). A fixed point solves the rigid problem. Impulses need not be unique;
/// the solution depends on the guess `gamma` (empty: zero). Intended for up to a few thousand contacts: the
/// LU is unsymmetric and W is often dense.
SolveSummary solve_delassus(const DelassusProblem& problem, const DelassusOptions& options, VecX* gamma);

}  // namespace cupola

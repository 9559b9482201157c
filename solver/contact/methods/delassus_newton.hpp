#pragma once

#include "solver/contact/problem/delassus.hpp"
#include "solver/contact/problem/solve_summary.hpp"

namespace cupola {

struct DelassusOptions {
  double tolerance = 1e-9;  ///< on the larger of fclib_merit and scaled_merit, > 0
  FrictionLaw law = FrictionLaw::coulomb;
  int max_outer_iterations = 500;  ///< >= 1
};

/// Solves the local form, for problems that come without masses and geometry (FCLIB files). Proximal passes
///
///     gamma_(k+1) solves  gamma = Gamma(W gamma + q - R gamma_k),   R = share * trace W_ii / 3
///
/// with Gamma the impulse of a contact of compliance R (cone.hpp), each by semismooth Newton with a sparse LU
/// of I + G W and backtracking; share shrinks while Newton succeeds and grows where it does not (Levenberg's
/// rule). A fixed point solves the rigid problem. Impulses need not be unique; the answer is the one reached
/// from `gamma` (empty: zero). Meant for up to some thousand contacts: the LU is unsymmetric and W often
/// dense.
SolveSummary solve_delassus(const DelassusProblem& problem, const DelassusOptions& options, VecX* gamma);

}  // namespace cupola

#pragma once

#include <functional>

#include "solver/contact/problem/contact_problem.hpp"
#include "solver/contact/problem/solve_options.hpp"
#include "solver/contact/problem/solve_summary.hpp"

namespace cupola {

/// Solves a convex (associated) problem by some method; guess in, solution out.
using ConvexSolve = std::function<SolveSummary(const ContactProblem& problem, const SolveOptions& options,
                                               ContactSolution* solution)>;

struct OuterOptions : ContactSolverOptions {
  /// Contacts whose compliance is below this share of their own Delassus block (a third of trace N_ii) get
  /// the difference as a proximal term R, >= 0; 0 adds none. Applies to the first outer iteration: the share
  /// shrinks where outer iterations gain little, and grows where rounding of D^T v / R limits the accuracy.
  double proximal_share = 0.0;
  int max_outer_iterations = 300;  ///< >= 1
};

/// Solves problems with rigid contacts or Coulomb's law by a sequence of convex problems:
///
///     E' = E + R,   b' = b - R gamma_k + s_k n,   s_k = mu |(D^T v_k + b + E gamma_k)_t|
///
/// R > 0 on (nearly) rigid contacts is the proximal point method (augmented Lagrangian) on the dual. Its
/// fixed point solves the problem with E, zero included. s is De Saxce's term for Coulomb's law, with the
/// *plastic* slip only: with the elastic slip included, the iteration converges to another law. The outer
/// iteration is a fixed-point iteration for b' - b, accelerated by anderson.hpp. Acary, Cadoux, Lemarechal,
/// Malick (2011), "A formulation of the linear discrete Coulomb friction problem via convex optimization",
/// section 4. We differ in changing s and the proximal centre in the same outer iteration.
///
/// `converged`: contact_law (for `law`, on the given problem), momentum and rigid_contact_speed of the
/// residuals are <= tolerance, or as small as rounding permits. With zero compliance impulses are not unique
/// in general; the solution is one near the guess. Under Coulomb's law there may be no solution (mu >~ 1);
/// the ending is then `stalled`.
SolveSummary solve_by_outer_iterations(const ContactProblem& problem, const OuterOptions& options,
                                       const ConvexSolve& solve, ContactSolution* solution);

}  // namespace cupola

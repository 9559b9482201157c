#pragma once

#include <functional>

#include "assembly/model/choices.hpp"
#include "solver/contact/problem/contact_problem.hpp"
#include "solver/contact/problem/solve_options.hpp"
#include "solver/contact/problem/solve_summary.hpp"

namespace cupola {

/// One solve of the convex (associated) problem by some method; guess in, answer out.
using ConvexSolve = std::function<SolveSummary(const ContactProblem& problem, const SolveOptions& options,
                                               ContactSolution* solution)>;

struct OuterOptions {
  FrictionLaw law = FrictionLaw::associated;
  /// Contacts whose compliance is below this share of their own Delassus block (a third of trace N_ii) get
  /// the difference as a proximal term R, >= 0; 0 adds none. This is the share of the first pass: it shrinks
  /// where passes gain little and grows where rounding of D^T v / R is felt.
  double proximal_share = 0.0;
  int max_outer_iterations = 300;  ///< >= 1
};

/// What the convex methods cannot take at once, by passes over convex problems that they can:
///
///     E' = E + R,   b' = b - R gamma_k + s_k n,   s_k = mu |(D^T v_k + b + E gamma_k)_t|
///
/// R > 0 on (nearly) rigid contacts is the proximal point method (augmented Lagrangian) on the dual: its
/// fixed point solves the problem with E, zero included. s is De Saxce's term for Coulomb's law, with the
/// *plastic* slip only: with the elastic slip inside, the passes converge to another law. The passes are a
/// fixed-point iteration for b' - b, accelerated (anderson.hpp). Acary, Cadoux, Lemarechal, Malick (2011), "A
/// formulation of the linear discrete Coulomb friction problem via convex optimization", section 4; we change
/// s and the proximal centre in the same pass.
///
/// Stops when Residuals::contact_law (of `law`, on the given problem) and the momentum residual are <=
/// tolerance, or as small as rounding lets them be; so is rigid_contact_speed. Zero compliance: impulses are
/// in general not unique; the answer is the one near the guess, and the message says so. For the Coulomb law
/// there may be no answer (mu
/// >~ 1); then `stalled`.
SolveSummary solve_by_outer_iterations(const ContactProblem& problem, const SolveOptions& options,
                                       const OuterOptions& outer, const ConvexSolve& solve,
                                       ContactSolution* solution);

}  // namespace cupola

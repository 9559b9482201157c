#pragma once

#include "solver/contact/problem/contact_problem.hpp"
#include "solver/contact/problem/solve_options.hpp"
#include "solver/contact/problem/solve_summary.hpp"
#include "solver/contact/problem/whitening.hpp"

namespace cupola {

/// The associated problem in its impulses, paper eq. 12-13 (any E >= 0):
///
///     min over Y of  f(gamma) = 1/2 gamma^T (N + E) gamma + q^T gamma,   q = D^T v_star + b
///
/// on the whitened problem, where N = J^T J is applied without being formed. First-order methods work on it
/// in the metric B of its own diagonal, one value for the normal and one for both tangents of a contact, in
/// which the projection on the cone is exact (cone.hpp): the paper's diagonal preconditioner.
struct DualProblem {
  WhitenedProblem white;
  VecX q;  ///< (3 nc)
  VecX B;  ///< diagonal of N + E, tangents averaged (3 nc)

  VecX times(const VecX& gamma) const;  ///< (N + E) gamma
  /// argmin over Y of |g - x|_B.
  VecX project(const VecX& x) const;
  /// v_star + M^-1 D gamma: the velocities that balance these impulses exactly.
  VecX velocities(const VecX& gamma) const;
};

DualProblem make_dual_problem(const ContactProblem& problem);

/// How far gamma in Y is from the answer, given g = (N + E) gamma + q: the certified force error where all E
/// > 0 (residuals.hpp), the contact-law residual where some contact is rigid. The momentum balance holds
/// exactly.
double dual_accuracy(const DualProblem& dual, const VecX& gamma, const VecX& g);

/// Guess of a dual method: the given impulses projected on Y, or zero.
VecX first_impulses(const DualProblem& dual, const ContactSolution& guess);

/// Shared ending of the dual methods: fills the summary's ending and message from accuracy and iterations.
void finish_dual(double accuracy, const SolveOptions& options, bool stalled, SolveSummary* summary);

}  // namespace cupola

#pragma once

#include "solver/contact/problem/contact_problem.hpp"
#include "solver/contact/problem/solve_options.hpp"
#include "solver/contact/problem/solve_summary.hpp"
#include "solver/contact/problem/whitening.hpp"

namespace cupola {

/// The associated problem in its impulses (dual form), paper eq. 12-13, any E >= 0:
///
///     min over Y of  f(gamma) = 1/2 gamma^T (N + E) gamma + q^T gamma,   q = D^T v_star + b
///
/// on the whitened problem, where N = J^T J is applied without being formed. First-order methods use the
/// metric B: the diagonal of N + E, with one value for the normal and one for both tangents of a contact, so
/// that the projection on the cone is exact (cone.hpp). This is the paper's diagonal preconditioner.
struct DualProblem {
  WhitenedProblem white;
  VecX q;                                            ///< (3 nc)
  VecX B;                                            ///< diagonal of N + E, tangents averaged (3 nc)
  ErrorMeasure measure = ErrorMeasure::force_error;  ///< of dual_accuracy()

  VecX times(const VecX& gamma) const;  ///< (N + E) gamma
  /// argmin over Y of |g - x|_B.
  VecX project(const VecX& x) const;
  /// v_star + M^-1 D gamma: the velocities that balance these impulses exactly.
  VecX velocities(const VecX& gamma) const;
};

DualProblem make_dual_problem(const ContactProblem& problem);

/// Error of gamma in Y, given g = (N + E) gamma + q, in dual.measure: the force error bound if all E > 0
/// (duality_gap.hpp, without its rounding terms), the contact-law residual if some contact is rigid. The
/// momentum balance holds exactly.
double dual_accuracy(const DualProblem& dual, const VecX& gamma, const VecX& g);

/// Initial impulses of a dual method: the given ones projected on Y, or zero.
VecX first_impulses(const DualProblem& dual, const ContactSolution& guess);

/// Sets ending and message of the summary of a dual method from its accuracy and iterations.
void finish_dual(const DualProblem& dual, double accuracy, const SolveOptions& options, bool stalled,
                 SolveSummary* summary);

}  // namespace cupola

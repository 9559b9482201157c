#pragma once

#include "solver/contact/blocks/block_lu.hpp"
#include "solver/contact/problem/contact_problem.hpp"
#include "solver/contact/problem/solve_options.hpp"
#include "solver/contact/problem/solve_summary.hpp"

namespace cupola {

/// Semismooth Newton method in the velocities for any flow rule, Coulomb's law above all, and any compliance:
///
///     F(v) = M (v - v_star) - D Gamma(D^T v + b) = 0,    (M + D G D^T) dv = -F,    v <- v + t dv
///
/// Gamma is the explicit impulse of a compliant contact (contact_impulse in cone.hpp), G its unsymmetric
/// derivative. t is halved until |F| in the norm of M^-1 decreases. As F is not the gradient of a cost,
/// Newton may end in a minimum of |F|. The smaller h, that is the larger the share of inertia, the rarer this
/// is.
///
/// Rigid contacts, and compliant ones where plain Newton fails, are solved by the proximal point method:
/// Gamma takes the compliance E + R and the velocity D^T v + b - R gamma_k. Its fixed point solves the given
/// problem for any R >= 0. R is a share of the Delassus block of each contact: it grows tenfold where Newton
/// fails and shrinks where it succeeds. A given max_iterations excludes this second attempt.
///
/// Without an initial guess, compliant contacts start from the solution with all of them sticking. So do
/// rigid contacts if none opens or slides there at the first R (keeps_sticking()); each subproblem is then
/// solved to 3 % of the error that its R causes, by GMRES with symmetric factors. Otherwise they start from
/// free fall.
///
/// The solver object keeps the symbolic factor while the same pairs of blocks touch, and the share of R with
/// which the last solve ended: where that suits the next problem too, a single proximal point solves it, and
/// the last factor preconditions it.
///
/// Converged when excess() of the residuals is <= 1.
class CoulombNewton {
 public:
  SolveSummary solve(const ContactProblem& problem, const ContactSolverOptions& options,
                     ContactSolution* solution);

 private:
  BlockLu lu_;
  double share_ = 1.0;         ///< of the Delassus blocks, the R with which the last solve ended
  double factor_share_ = 0.0;  ///< that of the R in lu_
};

}  // namespace cupola

#pragma once

#include "solver/contact/problem/contact_problem.hpp"
#include "solver/contact/problem/solve_options.hpp"
#include "solver/contact/problem/solve_summary.hpp"

namespace cupola {

/// Alternating direction method of multipliers (ADMM) on the whitened problem, any E >= 0, with a copy z of
/// y = J^T w + b:
///
///     (I + J R J^T) w = v_star + J (gamma + R (z - b))      one solve with the current factor
///     gamma+ = impulse of compliance E + R^-1 at y - R^-1 gamma
///     z+     = y + R^-1 (gamma+ - gamma)
///
/// with over-relaxation by 1.6. R = rho / (E + 1e-4 trace N_ii / 3) per contact. rho balances the primal
/// residual R (y - z) and the dual residual; each change of rho costs a factorisation. Boyd et al. (2011),
/// "Distributed optimization and statistical learning via the alternating direction method of multipliers",
/// section 3.4.
///
/// Converged when the larger of the momentum and contact-law residuals of (w, gamma) is <= tolerance; the
/// force error bound would not fall below 1e-9 where E is tiny. Measured every fifth iteration. Default of
/// max_iterations: 2000.
SolveSummary solve_admm(const ContactProblem& problem, const SolveOptions& options,
                        ContactSolution* solution);

}  // namespace cupola

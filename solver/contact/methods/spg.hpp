#pragma once

#include "solver/contact/problem/contact_problem.hpp"
#include "solver/contact/problem/solve_options.hpp"
#include "solver/contact/problem/solve_summary.hpp"

namespace cupola {

/// Spectral projected gradient (SPG) on the dual problem (dual_problem.hpp), the paper's method (section
/// 2.1):
///
///     d = P_B(gamma - alpha B^-1 g) - gamma,   gamma <- gamma + lambda d,   alpha = (s . B s) / (s . y)
///
/// Barzilai-Borwein steps alpha in the metric B of the diagonal preconditioner. lambda comes from the
/// non-monotone line search of Grippo, Lampariello and Lucidi over the last 10 objectives; f is quadratic, so
/// the search costs no further product. Returns the best iterate, so that more iterations never give a worse
/// one. Birgin, Martinez, Raydan (2000), "Nonmonotone spectral projected gradient methods on convex sets",
/// algorithm SPG2.
///
/// Converged when dual_accuracy <= tolerance. Default of max_iterations: 5000. Cost per iteration: one
/// product with N.
SolveSummary solve_spg(const ContactProblem& problem, const SolveOptions& options, ContactSolution* solution);

}  // namespace cupola

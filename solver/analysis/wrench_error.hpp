#pragma once

#include <optional>

#include "solver/analysis/static_solve.hpp"

namespace cupola {

/// Upper bound of the relative error of the wrenches on bed and base joints (root mean square) against the
/// exact solution of the same contact problem. None if the solution has no certified force error.
///
/// The wrenches are w = A gamma / h. The rows of A give the force on a joint, and the moment about the joint
/// centroid over the square root of the mean joint area. With the certified |gamma - exact| <= eps |gamma|:
///
///     |w - w_exact| / |w| <= |A| eps |gamma| / (h |w|),   |A|^2 = max over joints of lambda_max(A_j A_j^T)
///
/// The bound does not include the inertia share of the static step, which the equilibrium residual measures.
std::optional<double> certified_wrench_error(const ContactSet& contacts, const StaticSolution& solution);

/// The same error of `solution`, measured against `finer`.
double compared_wrench_error(const ContactSet& contacts, const StaticSolution& solution,
                             const StaticSolution& finer);

/// solve_static() with the largest tolerance at which the error of the joint wrenches is at most
/// `wrench_error` (> 0). The error is certified if a certificate exists; otherwise it is measured against a
/// solution with a tolerance a hundred times smaller. The message names which. The equilibrium residual stays
/// below a tenth of `wrench_error`. If the error is still larger when the tolerance reaches rounding, the
/// outcome is `unconverged`. `reached` returns the error.
StaticSolution solve_static_to_wrench_error(const Model& model, const State& start,
                                            const ContactSet& contacts, const ContactMemories& memories,
                                            StaticOptions options, double wrench_error, double* reached);

}  // namespace cupola

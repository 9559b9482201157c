#pragma once

#include <optional>

#include "solver/analysis/static_solve.hpp"

namespace cupola {

/// Bound of the relative error of the bed and base joints' wrenches, root mean square, against the exact
/// solution of the contact problem that was solved; none where the solution has no certified force error.
///
/// The wrenches are w = A gamma / h, with rows (force, moment about the joint's centroid over the root of the
/// mean joint area). With the certified |gamma - exact| <= eps |gamma|:
///
///     |w - w_exact| / |w| <= |A| eps |gamma| / (h |w|),   |A|^2 = max over joints of lambda_max(A_j A_j^T)
///
/// The inertia share of the static step is not in it: it is what the equilibrium residual measures.
std::optional<double> certified_wrench_error(const ContactSet& contacts, const StaticSolution& solution);

/// The same error of one solution against another, measured.
double compared_wrench_error(const ContactSet& contacts, const StaticSolution& solution,
                             const StaticSolution& finer);

/// solve_static() at the loosest tolerance whose joint wrenches are within `wrench_error` (> 0): certified
/// where a certificate exists, else compared with a solution a hundred times tighter; the message says which.
/// The equilibrium residual stays below a tenth of it. Where neither is met before the tolerance reaches
/// rounding, the verdict is `unconverged`. `reached` gets the error.
StaticSolution solve_static_to_wrench_error(const Model& model, const State& start,
                                            const ContactSet& contacts, const ContactMemories& memories,
                                            StaticOptions options, double wrench_error, double* reached);

}  // namespace cupola

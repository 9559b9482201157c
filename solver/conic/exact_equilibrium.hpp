#pragma once

#include "solver/contact/blocks/block_cholesky.hpp"
#include "solver/contact/problem/whitening.hpp"

namespace cupola {

/// -(load + D gamma), summed in extended precision (6 nb).
VecX imbalance_of(const ContactProblem& problem, const VecX& load, const VecX& gamma);

/// Distance of forces from equilibrium, in the measure in which a distance below 1 proves that forces in
/// exact equilibrium exist inside the limits of the joints, whatever the flow rule and the compliance.
///
/// Forces that lie on a limit are first moved inside by a small share; contacts without force stay without.
/// Around a point inside the limits, the ellipsoid of the Hessian H of a self-concordant barrier lies inside
/// them too (Dikin's ellipsoid; Nesterov, Nemirovskii 1994, "Interior-point polynomial algorithms in convex
/// programming", theorem 2.1.1). With S = H^-1 and the imbalance r, the correction S D^T K^-1 r with K = D S
/// D^T gives exact equilibrium and has the length
///
///     lambda = sqrt(r . K^-1 r)
///
/// in that norm. It is computed by a Cholesky factor of K and conjugate gradients, r in extended precision;
/// what the gradients leave is added tenfold. Infinite where K is singular: the loaded contacts cannot carry
/// every load.
///
/// `load` and `gamma`: impulses or forces, in the unit of the strength of the problem (6 nb; 3 nc). `graph` is
/// that of the problem; `factor` keeps its structure if it has that of `graph`.
double equilibrium_distance(const WhitenedProblem& problem, const ContactGraph& graph, const VecX& load,
                            const VecX& gamma, BlockCholesky* factor);

/// The distance up to which forces next to gamma count as proven: below 1, for the rounding of lambda.
constexpr double kProvenDistance = 0.5;

/// True if forces next to gamma are proven to exist.
bool proves_equilibrium(const ContactProblem& problem, const VecX& load, const VecX& gamma);

}  // namespace cupola

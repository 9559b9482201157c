#pragma once

#include "solver/contact/problem/whitening.hpp"

namespace cupola {

/// The primal objective of a whitened problem (M = I, all E > 0) at a point w, after Castro et al. (2022):
///
///     cost(w) = 1/2 |w - w_star|^2 + sum_i 1/2 gamma_i^T E_i gamma_i - gamma_i . z_i,
///     gamma_i = gamma(y_i),   y_i = J_i^T w + b_i,   z_i = y_i + E_i gamma_i
///
/// gamma_i . z_i is zero for dry joints and minus the plastic dissipation at a strength. The cost is strongly
/// convex and continuously differentiable. The momentum balance holds at its minimum.
struct PrimalPoint {
  VecX w;         ///< (6 nb)
  VecX y;         ///< J^T w + b (3 nc)
  VecX gamma;     ///< gamma(y), in the cone (3 nc)
  VecX gradient;  ///< w - w_star - J gamma: the unbalanced impulse (6 nb)
  double cost = 0.0;
  double largest_block_gradient = 0.0;  ///< max over blocks of |gradient_k|
};

PrimalPoint primal_point(const WhitenedProblem& problem, VecX w);

struct LineSearchResult {
  double t = 0.0;
  int evaluations = 0;
};

/// The t > 0 that minimises cost(w + t d), to |slope| <= slope_reduction |slope at 0| or to rounding, by a
/// safeguarded Newton method on the slope, which is monotone. Requires d . gradient < 0.
LineSearchResult line_search(const WhitenedProblem& problem, const PrimalPoint& point, const VecX& d,
                             double slope_reduction);

}  // namespace cupola

#pragma once

#include <Eigen/SparseCore>

#include "solver/contact/problem/contact_problem.hpp"
#include "solver/contact/problem/flow_rule.hpp"

namespace cupola {

/// A contact problem reduced to its impulses, the local form of FCLIB (W, r there; N or N + E, gamma here):
///
///     u = W gamma + q,   gamma in Y  _|_  u + s n in Y*,   s = (1 - dilatancy) mu |u_t|
///
/// W may have full 3x3 blocks, may be singular, and may be slightly unsymmetric: problems from other codes
/// are.
struct DelassusProblem {
  Eigen::SparseMatrix<double> W;  ///< 1/kg (3 nc x 3 nc)
  VecX q;                         ///< m/s (3 nc)
  VecX mu;                        ///< (nc)
  int num_contacts() const { return static_cast<int>(mu.size()); }
};

/// W = D^T M^-1 D + diag(E), q = D^T v_star + b.
DelassusProblem make_delassus(const ContactProblem& problem);

/// FCLIB's merit function 1, for any flow rule:
///
///     |gamma - P(gamma - (u + s n))| / (1 + sqrt(|q|)),   P the Euclidean projection on the cone
///
/// It adds N s and m/s. Report it together with scaled_merit, whose terms share a unit.
double fclib_merit(const DelassusProblem& problem, const VecX& gamma, const FlowRule& law);

/// Contact-law residual, no unit: |gamma - P(gamma - rho (u + s n))| / |gamma| with rho_i = 3 / trace W_ii.
double scaled_merit(const DelassusProblem& problem, const VecX& gamma, const FlowRule& law);

/// trace(W_ii) / 3 of every contact, 1/kg (nc).
VecX mean_diagonal(const DelassusProblem& problem);

}  // namespace cupola

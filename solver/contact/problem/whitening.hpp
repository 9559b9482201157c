#pragma once

#include "solver/contact/problem/contact_problem.hpp"

namespace cupola {

/// The same problem in the unknowns w = L^T v with M = L L^T per block: unit mass, J = L^-1 D. Impulses,
/// compliances and relative velocities stay what they are (J^T w = D^T v), so the Hessian I + J G J^T has
/// comparable rows whatever the blocks weigh and however small they are.
struct WhitenedProblem {
  ContactProblem problem;       ///< M = identity, v_star = L^T v_star, D = L^-1 D
  std::vector<Mat6> L;          ///< lower triangles (nb)
  std::vector<Mat6> L_inverse;  ///< lower triangles (nb)

  VecX to_w(const VecX& v) const;  ///< L^T v
  VecX to_v(const VecX& w) const;  ///< L^-T w
};

WhitenedProblem whiten(const ContactProblem& problem);

}  // namespace cupola

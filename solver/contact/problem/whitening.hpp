#pragma once

#include "solver/contact/problem/contact_problem.hpp"

namespace cupola {

/// The unknowns w = L^T v with M = L L^T per block: unit mass, J = L^-1 D. Impulses, compliances and relative
/// velocities do not change (J^T w = D^T v). The rows of the Hessian I + J G J^T are then of comparable size
/// for blocks of any mass and size.
struct Whitening {
  std::vector<Mat6> L;          ///< lower triangles (nb)
  std::vector<Mat6> L_inverse;  ///< lower triangles (nb)

  Whitening() = default;
  explicit Whitening(const std::vector<Mat6>& M);

  VecX to_w(const VecX& v) const;            ///< L^T v
  VecX to_v(const VecX& w) const;            ///< L^-T w
  VecX whiten_impulse(const VecX& p) const;  ///< L^-1 p
};

/// A problem in these unknowns: M = identity, v_star = L^T v_star, D = L^-1 D.
struct WhitenedProblem : Whitening {
  ContactProblem problem;
};

WhitenedProblem whiten(const ContactProblem& problem);

}  // namespace cupola

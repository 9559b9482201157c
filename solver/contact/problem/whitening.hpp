#pragma once

#include "solver/contact/problem/contact_problem.hpp"

namespace cupola {

/// A problem in the unknowns w = L^T v with M = L L^T per block: unit mass, J = L^-1 D. Impulses, compliances
/// and relative velocities do not change (J^T w = D^T v). The rows of the Hessian I + J G J^T are then of
/// comparable size for blocks of any mass and size. J is not stored.
struct WhitenedProblem {
  const ContactProblem& given;  ///< in v
  std::vector<Mat6> L_inverse;  ///< lower triangles (nb)
  VecX w_star;                  ///< L^T v_star (6 nb)

  /// L^T times a vector or matrix of one block.
  template <class Matrix>
  Matrix times_L_transposed(int block, const Matrix& x) const {
    return L_inverse[block].transpose().triangularView<Eigen::Upper>().solve(x);
  }
  VecX to_w(const VecX& v) const;            ///< L^T v
  VecX to_v(const VecX& w) const;            ///< L^-T w
  VecX whiten_impulse(const VecX& p) const;  ///< L^-1 p
};

/// Keeps a reference to the problem.
WhitenedProblem whiten(const ContactProblem& problem);
WhitenedProblem whiten(ContactProblem&&) = delete;

/// J^T w, relative velocities in the contact frames (3 nc).
VecX relative_velocity(const WhitenedProblem& problem, const VecX& w);
/// J gamma, impulses on the blocks in the unit of w (6 nb).
VecX generalized_impulse(const WhitenedProblem& problem, const VecX& gamma);

}  // namespace cupola

#include "solver/contact/whitening.hpp"

#include <Eigen/Cholesky>

namespace cupola {

VecX WhitenedProblem::to_w(const VecX& v) const {
  VecX w(v.size());
  for (int k = 0; k < problem.num_blocks(); ++k) {
    w.segment<6>(6 * k).noalias() = L[k].triangularView<Eigen::Lower>().transpose() * v.segment<6>(6 * k);
  }
  return w;
}

VecX WhitenedProblem::to_v(const VecX& w) const {
  VecX v = w;
  for (int k = 0; k < problem.num_blocks(); ++k) {
    auto v_k = v.segment<6>(6 * k);
    L[k].triangularView<Eigen::Lower>().transpose().solveInPlace(v_k);
  }
  return v;
}

WhitenedProblem whiten(const ContactProblem& problem) {
  WhitenedProblem white{problem, {}};
  ContactProblem& p = white.problem;
  white.L.reserve(p.M.size());
  for (Mat6& M : p.M) {
    white.L.push_back(M.llt().matrixL());
    M.setIdentity();
  }
  p.v_star = white.to_w(problem.v_star);
  const auto solve_lower = [&white](int k, Mat63& D) {
    if (k != ContactProblem::kFixed) white.L[k].triangularView<Eigen::Lower>().solveInPlace(D);
  };
  for (int i = 0; i < p.num_contacts(); ++i) {
    solve_lower(p.block_a[i], p.D_a[i]);
    solve_lower(p.block_b[i], p.D_b[i]);
  }
  return white;
}

}  // namespace cupola

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
  VecX v(w.size());
  for (int k = 0; k < problem.num_blocks(); ++k) {
    v.segment<6>(6 * k).noalias() = L_inverse[k].transpose() * w.segment<6>(6 * k);
  }
  return v;
}

WhitenedProblem whiten(const ContactProblem& problem) {
  WhitenedProblem white{problem, {}, {}};
  ContactProblem& p = white.problem;
  white.L.reserve(p.M.size());
  white.L_inverse.reserve(p.M.size());
  for (Mat6& M : p.M) {
    white.L.push_back(M.llt().matrixL());
    white.L_inverse.push_back(white.L.back().triangularView<Eigen::Lower>().solve(Mat6::Identity()));
    M.setIdentity();
  }
  p.v_star = white.to_w(problem.v_star);
  for (int i = 0; i < p.num_contacts(); ++i) {
    const int a = p.block_a[i], b = p.block_b[i];
    if (a != ContactProblem::kFixed) p.D_a[i] = white.L_inverse[a].lazyProduct(problem.D_a[i]);
    if (b != ContactProblem::kFixed) p.D_b[i] = white.L_inverse[b].lazyProduct(problem.D_b[i]);
  }
  return white;
}

}  // namespace cupola

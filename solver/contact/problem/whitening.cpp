#include "solver/contact/problem/whitening.hpp"

#include <Eigen/Cholesky>

#include "assembly/base/error.hpp"
#include "solver/runtime/threads.hpp"

namespace cupola {

Whitening::Whitening(const std::vector<Mat6>& M) {
  L.reserve(M.size());
  L_inverse.reserve(M.size());
  for (const Mat6& block : M) {
    const Eigen::LLT<Mat6> factor(block);
    CUPOLA_ASSERT(factor.info() == Eigen::Success);
    L.push_back(factor.matrixL());
    L_inverse.push_back(L.back().triangularView<Eigen::Lower>().solve(Mat6::Identity()));
  }
}

VecX Whitening::to_w(const VecX& v) const {
  CUPOLA_ASSERT(v.size() == 6 * std::ssize(L));
  VecX w(v.size());
  for (int k = 0; k < static_cast<int>(L.size()); ++k) {
    w.segment<6>(6 * k).noalias() = L[k].triangularView<Eigen::Lower>().transpose() * v.segment<6>(6 * k);
  }
  return w;
}

VecX Whitening::to_v(const VecX& w) const {
  CUPOLA_ASSERT(w.size() == 6 * std::ssize(L));
  VecX v(w.size());
  for (int k = 0; k < static_cast<int>(L.size()); ++k) {
    v.segment<6>(6 * k).noalias() = L_inverse[k].transpose() * w.segment<6>(6 * k);
  }
  return v;
}

VecX Whitening::whiten_impulse(const VecX& p) const {
  CUPOLA_ASSERT(p.size() == 6 * std::ssize(L));
  VecX result(p.size());
  for (int k = 0; k < static_cast<int>(L.size()); ++k)
    result.segment<6>(6 * k).noalias() = L_inverse[k] * p.segment<6>(6 * k);
  return result;
}

WhitenedProblem whiten(const ContactProblem& problem) {
  const int nb = problem.num_blocks(), nc = problem.num_contacts();
  WhitenedProblem white{Whitening(problem.M), {}};
  ContactProblem& p = white.problem;
  p.M.assign(nb, Mat6::Identity());
  p.block_a = problem.block_a;
  p.block_b = problem.block_b;
  p.b = problem.b;
  p.E = problem.E;
  p.mu = problem.mu;
  p.strength = problem.strength;
  p.h = problem.h;
  p.plane = problem.plane;
  p.v_star = white.to_w(problem.v_star);
  p.D_a.resize(nc);
  p.D_b.resize(nc);
  constexpr double kOperationsPerContact = 400.0;
  share_sums(kOperationsPerContact * nc, nc, [&](int first, int last) {
    for (int i = first; i < last; ++i) {
      const int a = p.block_a[i], b = p.block_b[i];
      if (a != ContactProblem::kFixed) p.D_a[i] = white.L_inverse[a].lazyProduct(problem.D_a[i]);
      if (b != ContactProblem::kFixed) p.D_b[i] = white.L_inverse[b].lazyProduct(problem.D_b[i]);
    }
  });
  return white;
}

}  // namespace cupola

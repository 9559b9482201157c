#include "solver/contact/problem/whitening.hpp"

#include <Eigen/Cholesky>

#include "assembly/base/error.hpp"
#include "solver/runtime/threads.hpp"

namespace cupola {

namespace {

/// y_k = product(k, x_k) of every block.
template <class Product>
VecX by_blocks(const VecX& x, const Product& product) {
  constexpr double kOperationsPerBlock = 72.0;
  const auto nb = static_cast<int>(x.size() / 6);
  VecX y(x.size());
  share_range(kOperationsPerBlock * nb, nb, [&](int first, int last) {
    for (int k = first; k < last; ++k) y.segment<6>(6 * k).noalias() = product(k, x.segment<6>(6 * k));
  });
  return y;
}

}  // namespace

VecX WhitenedProblem::to_w(const VecX& v) const {
  CUPOLA_ASSERT(v.size() == 6 * std::ssize(L_inverse));
  return by_blocks(v, [&](int k, const auto& x) { return times_L_transposed(k, Vec6(x)); });
}

VecX WhitenedProblem::to_v(const VecX& w) const {
  CUPOLA_ASSERT(w.size() == 6 * std::ssize(L_inverse));
  return by_blocks(w, [&](int k, const auto& x) { return L_inverse[k].transpose() * x; });
}

VecX WhitenedProblem::whiten_impulse(const VecX& p) const {
  CUPOLA_ASSERT(p.size() == 6 * std::ssize(L_inverse));
  return by_blocks(p, [&](int k, const auto& x) { return L_inverse[k] * x; });
}

WhitenedProblem whiten(const ContactProblem& problem) {
  WhitenedProblem white{problem, {}, {}};
  white.L_inverse.reserve(problem.M.size());
  for (const Mat6& block : problem.M) {
    const Eigen::LLT<Mat6> factor(block);
    CUPOLA_ASSERT(factor.info() == Eigen::Success);
    white.L_inverse.push_back(factor.matrixL().solve(Mat6::Identity()));
  }
  white.w_star = white.to_w(problem.v_star);
  return white;
}

VecX relative_velocity(const WhitenedProblem& problem, const VecX& w) {
  return relative_velocity(problem.given, problem.to_v(w));
}

VecX generalized_impulse(const WhitenedProblem& problem, const VecX& gamma) {
  return problem.whiten_impulse(generalized_impulse(problem.given, gamma));
}

}  // namespace cupola

#include "tests/reference/delassus.hpp"

#include <cmath>

#include "assembly/base/error.hpp"
#include "solver/contact/problem/cone.hpp"
#include "solver/contact/problem/whitening.hpp"

namespace cupola {

namespace {

/// J^T (3 nc x 6 nb), N = J^T J.
Eigen::SparseMatrix<double, Eigen::RowMajor> whitened_contact_matrix(const WhitenedProblem& white) {
  const ContactProblem& p = white.given;
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(36 * p.num_contacts());
  const auto add = [&](int i, int k, const Lever& D) {
    if (k == ContactProblem::kFixed) return;
    const Mat63 J = white.L_inverse[k] * D.matrix();
    for (int c = 0; c < 3; ++c) {
      for (int r = 0; r < 6; ++r) entries.emplace_back(3 * i + c, 6 * k + r, J(r, c));
    }
  };
  for (int i = 0; i < p.num_contacts(); ++i) {
    add(i, p.block_a[i], p.D_a[i]);
    add(i, p.block_b[i], p.D_b[i]);
  }
  Eigen::SparseMatrix<double, Eigen::RowMajor> JT(3 * p.num_contacts(), 6 * p.num_blocks());
  JT.setFromTriplets(entries.begin(), entries.end());
  return JT;
}

/// |gamma - P(gamma - rho (u + s n))|.
double natural_map(const DelassusProblem& p, const VecX& gamma, const FlowRule& law, const VecX& rho) {
  CUPOLA_ASSERT(gamma.size() == p.q.size() && rho.size() == p.num_contacts());
  const VecX u = p.W * gamma + p.q;
  double squared = 0.0;
  for (int i = 0; i < p.num_contacts(); ++i) {
    Vec3 velocity = u.segment<3>(3 * i);
    if (!law.is_associated()) velocity[0] += (1.0 - law.dilatancy) * p.mu[i] * velocity.tail<2>().norm();
    const Vec3 gamma_i = gamma.segment<3>(3 * i);
    squared +=
        (gamma_i - project_on_admissible({1.0, 1.0, p.mu[i]}, gamma_i - rho[i] * velocity)).squaredNorm();
  }
  return std::sqrt(squared);
}

}  // namespace

DelassusProblem make_delassus(const ContactProblem& problem) {
  const WhitenedProblem white = whiten(problem);
  const Eigen::SparseMatrix<double, Eigen::RowMajor> JT = whitened_contact_matrix(white);
  DelassusProblem result;
  result.W = Eigen::SparseMatrix<double>(JT * JT.transpose());
  for (Eigen::Index k = 0; k < problem.E.size(); ++k) result.W.coeffRef(k, k) += problem.E[k];
  result.W.makeCompressed();
  result.q = relative_velocity(problem, problem.v_star) + problem.b;
  result.mu = problem.mu;
  return result;
}

double fclib_merit(const DelassusProblem& problem, const VecX& gamma, const FlowRule& law) {
  return natural_map(problem, gamma, law, VecX::Ones(problem.num_contacts())) /
         (1.0 + std::sqrt(problem.q.norm()));
}

double scaled_merit(const DelassusProblem& problem, const VecX& gamma, const FlowRule& law) {
  const double error = natural_map(problem, gamma, law, mean_diagonal(problem).cwiseInverse());
  return error == 0.0 ? 0.0 : gamma.norm() > 0.0 ? error / gamma.norm() : 1.0;
}

VecX mean_diagonal(const DelassusProblem& problem) {
  const VecX diagonal = problem.W.diagonal();
  VecX mean(problem.num_contacts());
  for (int i = 0; i < problem.num_contacts(); ++i) mean[i] = diagonal.segment<3>(3 * i).mean();
  return mean;
}

}  // namespace cupola

#include "solver/contact/methods/coulomb_direction.hpp"

#include <algorithm>
#include <cmath>

#include "solver/contact/methods/gmres.hpp"

namespace cupola {

namespace {

/// G without the terms that couple normal and tangential directions.
std::vector<Mat3> uncoupled(std::vector<Mat3> G) {
  for (Mat3& stiffness : G) {
    stiffness.topRightCorner<1, 2>().setZero();
    stiffness.bottomLeftCorner<2, 1>().setZero();
  }
  return G;
}

}  // namespace

bool CoulombDirection::solve_by_gmres(const UnsymmetricBlockMatrix& J, const VecX& F, double forcing, VecX* d,
                                      SolveSummary* summary) {
  const BlockPattern& pattern = graph_.pattern;
  const bool is_symmetric = last_ == Factor::symmetric;
  if (last_ == Factor::none || (is_symmetric ? symmetric_.pattern() : unsymmetric_.pattern()) != pattern)
    return false;
  // Half the cost of an LU factor of a shell, which grows with the power 1.5 of the number of its blocks.
  const double growth = std::sqrt(std::max(1.0, pattern.num_blocks() / 1000.0));
  const int max_iterations = static_cast<int>(growth * (is_symmetric ? 12 : 6));
  const auto precondition = [&](const VecX& r) {
    return is_symmetric ? symmetric_.solve_approximately(r) : unsymmetric_.solve(r);
  };
  const int iterations = gmres([&](const VecX& x) { return multiply(pattern, J, x); }, precondition, F,
                               forcing, max_iterations, d);
  summary->conjugate_gradients += iterations > 0 ? iterations : max_iterations;
  return iterations > 0;
}

bool CoulombDirection::factorize_symmetric(const std::vector<Mat3>& G, SolveSummary* summary) {
  ++summary->factorizations;
  const bool succeeds = symmetric_.factorize(graph_.pattern, assemble_hessian(problem_, graph_, G));
  last_ = succeeds ? Factor::symmetric : Factor::none;
  return succeeds;
}

bool CoulombDirection::solve_symmetric(const std::vector<Mat3>& G, const VecX& F, VecX* d,
                                       SolveSummary* summary) {
  if (!factorize_symmetric(G, summary)) return false;
  *d = symmetric_.solve(F);
  return d->allFinite();
}

bool CoulombDirection::solve_directly(const UnsymmetricBlockMatrix& J, const VecX& F, VecX* d,
                                      SolveSummary* summary) {
  ++summary->factorizations;
  const bool succeeds = unsymmetric_.factorize(graph_.pattern, J);
  last_ = succeeds ? Factor::unsymmetric : Factor::none;
  if (!succeeds) return false;
  *d = unsymmetric_.solve(F);
  return d->allFinite();
}

bool CoulombDirection::solve(const std::vector<Mat3>& G, const VecX& F, const Accuracy& accuracy, VecX* d,
                             SolveSummary* summary) {
  const UnsymmetricBlockMatrix& J = jacobian_.at(G);
  if (accuracy.damping > 0.0) {
    UnsymmetricBlockMatrix damped = J;
    for (Mat6& block : damped.diagonal) block.diagonal().array() += accuracy.damping;
    return solve_directly(damped, F, d, summary);
  }
  const std::optional<double>& forcing = accuracy.forcing;
  if (forcing && solve_by_gmres(J, F, *forcing, d, summary)) return true;
  const bool symmetric = last_ == Factor::symmetric || (last_ == Factor::none && first_ == First::symmetric);
  if (forcing && symmetric && factorize_symmetric(uncoupled(G), summary) &&
      solve_by_gmres(J, F, *forcing, d, summary))
    return true;
  return solve_directly(J, F, d, summary);
}

}  // namespace cupola

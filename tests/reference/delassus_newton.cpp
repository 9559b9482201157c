#include "tests/reference/delassus_newton.hpp"

#include <algorithm>
#include <cmath>

#include <Eigen/UmfPackSupport>
#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/base/error.hpp"
#include "solver/contact/problem/cone.hpp"

namespace cupola {

namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// One proximal subproblem: gamma = Gamma(W gamma + q - R centre).
struct DelassusSubproblem {
  const DelassusProblem& p;
  FlowRule law;
  VecX R;       ///< (nc)
  VecX centre;  ///< gamma_k (3 nc)

  ContactLaw contact(int i) const { return {R[i], R[i], p.mu[i], law.dilatancy}; }
  VecX velocity(const VecX& gamma) const {
    VecX y = p.W * gamma + p.q;
    for (int i = 0; i < p.num_contacts(); ++i) y.segment<3>(3 * i) -= R[i] * centre.segment<3>(3 * i);
    return y;
  }
  VecX residual(const VecX& gamma) const;
  /// d residual / d gamma = I + G W.
  Sparse jacobian(const VecX& gamma) const;
};

VecX DelassusSubproblem::residual(const VecX& gamma) const {
  const VecX y = velocity(gamma);
  VecX F = gamma;
  for (int i = 0; i < p.num_contacts(); ++i) {
    const Vec3 y_i = y.segment<3>(3 * i);
    F.segment<3>(3 * i) -= contact_impulse(contact(i), y_i);
  }
  return F;
}

Sparse DelassusSubproblem::jacobian(const VecX& gamma) const {
  const VecX y = velocity(gamma);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(9 * p.num_contacts());
  for (int i = 0; i < p.num_contacts(); ++i) {
    const Vec3 y_i = y.segment<3>(3 * i);
    const Mat3 G = contact_stiffness(contact(i), y_i);
    for (int c = 0; c < 3; ++c) {
      for (int r = 0; r < 3; ++r) entries.emplace_back(3 * i + r, 3 * i + c, G(r, c));
    }
  }
  Sparse G(gamma.size(), gamma.size()), identity(gamma.size(), gamma.size());
  G.setFromTriplets(entries.begin(), entries.end());
  identity.setIdentity();
  Sparse J = G * p.W;
  J += identity;
  J.makeCompressed();
  return J;
}

/// Semismooth Newton from `gamma`. True if |F| <= `tolerance` |gamma|.
bool solve_delassus_subproblem(const DelassusSubproblem& sub, double tolerance, VecX* gamma,
                               SolveSummary* summary) {
  constexpr int kMaxIterations = 30;
  VecX F = sub.residual(*gamma);
  for (int k = 0; k < kMaxIterations; ++k) {
    if (F.norm() <= tolerance * gamma->norm()) return true;
    ++summary->iterations;
    ++summary->factorizations;
    const Sparse J = sub.jacobian(*gamma);  // the solver keeps a reference to it
    Eigen::UmfPackLU<Sparse> lu(J);
    if (lu.info() != Eigen::Success) return false;
    const VecX d = lu.solve(F);
    double t = 1.0;
    VecX trial, F_trial;
    do {  // halved until |F| decreases: the map has kinks, so its slope is unreliable
      trial = *gamma - t * d;
      F_trial = sub.residual(trial);
      t *= 0.5;
    } while (!(F_trial.norm() < (1.0 - 0.1 * t) * F.norm()) && t > 1e-4);
    if (!F_trial.allFinite() || !(F_trial.norm() < F.norm())) return false;
    *gamma = trial;
    F = F_trial;
  }
  return F.norm() <= tolerance * gamma->norm();
}

/// gamma projected on the cone: Newton's result may lie outside by rounding.
VecX on_cone(const DelassusProblem& p, const VecX& gamma) {
  VecX result(gamma.size());
  for (int i = 0; i < p.num_contacts(); ++i) {
    result.segment<3>(3 * i) = project_on_admissible({1.0, 1.0, p.mu[i]}, gamma.segment<3>(3 * i));
  }
  return result;
}

}  // namespace

SolveSummary solve_delassus(const DelassusProblem& problem, const DelassusOptions& options, VecX* gamma) {
  constexpr double kLargestShare = 1e3, kSmallestShare = 1e-6;
  CUPOLA_ASSERT(problem.q.size() == 3 * problem.num_contacts());
  CUPOLA_ASSERT(problem.W.rows() == problem.q.size() && problem.W.cols() == problem.q.size());
  SolveSummary summary;
  const auto measure = [&](const VecX& g) {
    return std::max(fclib_merit(problem, g, options.law), scaled_merit(problem, g, options.law));
  };
  VecX x = gamma->size() == problem.q.size() ? on_cone(problem, *gamma) : VecX::Zero(problem.q.size()).eval();
  VecX best = x;
  double best_error = measure(x);
  double share = 1.0;
  const VecX diagonal = mean_diagonal(problem);
  while (best_error > options.tolerance && summary.outer_iterations < options.max_outer_iterations &&
         share <= kLargestShare) {
    ++summary.outer_iterations;
    const DelassusSubproblem sub{problem, options.law, share * diagonal, x};
    VecX next = x;
    if (!solve_delassus_subproblem(sub, std::min(1e-6, 1e-2 * best_error), &next, &summary)) {
      share *= 10.0;
      continue;
    }
    share = std::max(0.3 * share, kSmallestShare);
    x = on_cone(problem, next);
    const double error = measure(x);
    summary.residual_history.push_back(error);
    if (error < best_error) {
      best_error = error;
      best = x;
    }
  }
  *gamma = best;
  const bool converged = best_error <= options.tolerance;
  summary.ending = converged                   ? SolveEnding::converged
                   : std::isfinite(best_error) ? SolveEnding::stalled
                                               : SolveEnding::failed;
  summary.message =
      fmt::format("merit {:.2e} {} tolerance {:.2e} after {}", best_error, converged ? "<=" : ">",
                  options.tolerance, counted(summary.outer_iterations, "outer iteration"));
  return summary;
}

}  // namespace cupola

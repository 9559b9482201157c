#include "solver/contact/methods/coulomb_newton.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/SparseLU>
#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/base/process.hpp"
#include "solver/contact/problem/cone.hpp"
#include "solver/contact/problem/residuals.hpp"
#include "solver/contact/problem/whitening.hpp"
#include "solver/runtime/interruption.hpp"

namespace cupola {

namespace {

using Sparse = Eigen::SparseMatrix<double>;

/// w = v_star + D Gamma(D^T w + b - R centre), whitened.
struct CoulombSubproblem {
  const ContactProblem& p;
  VecX R;       ///< 1/kg (nc)
  VecX centre;  ///< gamma_k (3 nc)

  ContactLaw contact(int i) const {
    ContactLaw law = contact_law(p, i);
    law.e_n += R[i];
    law.e_t += R[i];
    return law;
  }
  VecX velocity(const VecX& w) const;
  VecX impulses(const VecX& w) const;
  VecX residual(const VecX& w) const { return w - p.v_star - generalized_impulse(p, impulses(w)); }
  /// d residual / d w = I + D G D^T.
  Sparse jacobian(const VecX& w) const;
};

VecX CoulombSubproblem::velocity(const VecX& w) const {
  VecX y = relative_velocity(p, w) + p.b;
  for (int i = 0; i < p.num_contacts(); ++i) y.segment<3>(3 * i) -= R[i] * centre.segment<3>(3 * i);
  return y;
}

VecX CoulombSubproblem::impulses(const VecX& w) const {
  const VecX y = velocity(w);
  VecX gamma(y.size());
  for (int i = 0; i < p.num_contacts(); ++i)
    gamma.segment<3>(3 * i) = coulomb_impulse(contact(i), y.segment<3>(3 * i));
  return gamma;
}

Sparse CoulombSubproblem::jacobian(const VecX& w) const {
  const VecX y = velocity(w);
  std::vector<Eigen::Triplet<double>> entries;
  entries.reserve(w.size() + 144 * static_cast<size_t>(p.num_contacts()));
  for (int k = 0; k < w.size(); ++k) entries.emplace_back(k, k, 1.0);
  const auto add = [&entries](int row_block, int column_block, const Mat6& value) {
    if (row_block == ContactProblem::kFixed || column_block == ContactProblem::kFixed) return;
    for (int c = 0; c < 6; ++c)
      for (int r = 0; r < 6; ++r) entries.emplace_back(6 * row_block + r, 6 * column_block + c, value(r, c));
  };
  for (int i = 0; i < p.num_contacts(); ++i) {
    const Mat3 G = coulomb_stiffness(contact(i), y.segment<3>(3 * i));
    if (G.isZero(0.0)) continue;
    const Mat63 D_a_G = p.D_a[i] * G, D_b_G = p.D_b[i] * G;
    const int a = p.block_a[i], b = p.block_b[i];
    add(a, a, D_a_G * p.D_a[i].transpose());
    add(a, b, D_a_G * p.D_b[i].transpose());
    add(b, a, D_b_G * p.D_a[i].transpose());
    add(b, b, D_b_G * p.D_b[i].transpose());
  }
  Sparse J(w.size(), w.size());
  J.setFromTriplets(entries.begin(), entries.end());
  return J;
}

/// Semismooth Newton from `w`. True if |F| <= `tolerance`.
bool solve_coulomb_subproblem(const CoulombSubproblem& sub, double tolerance, VecX* w,
                              SolveSummary* summary) {
  constexpr int kMaxIterations = 30;
  constexpr double kShortest = 1e-4;
  VecX F = sub.residual(*w);
  for (int k = 0; k < kMaxIterations && F.norm() > tolerance; ++k) {
    throw_if_interrupted();
    ++summary->iterations;
    ++summary->factorizations;
    Eigen::SparseLU<Sparse> lu(sub.jacobian(*w));
    if (lu.info() != Eigen::Success) return false;
    const VecX d = lu.solve(F);
    VecX trial, F_trial;
    double t = 2.0;
    do {  // halved until |F| decreases: the map has kinks, so its slope is unreliable
      t *= 0.5;
      trial = *w - t * d;
      F_trial = sub.residual(trial);
      ++summary->line_search_evaluations;
    } while (!(F_trial.norm() < (1.0 - 0.1 * t) * F.norm()) && t > kShortest);
    if (!(F_trial.norm() < F.norm())) return false;
    *w = trial;
    F = F_trial;
  }
  return F.norm() <= tolerance;
}

}  // namespace

SolveSummary solve_coulomb_newton(const ContactProblem& problem, const SolveOptions& options,
                                  ContactSolution* solution) {
  constexpr int kMaxOuterIterations = 200;
  constexpr double kLargestShare = 1e3, kSmallestShare = 1e-6;
  const double start = wall_seconds();
  options.validate();
  SolveSummary summary;
  if (summary.message = problem.defect(); !summary.message.empty()) return summary;
  const WhitenedProblem white = whiten(problem);
  VecX w = solution->v.size() == problem.v_star.size() ? white.to_w(solution->v) : VecX(white.problem.v_star);
  VecX diagonal(problem.num_contacts());
  for (int i = 0; i < problem.num_contacts(); ++i) diagonal[i] = delassus_trace(problem, i) / 3.0;
  CoulombSubproblem sub{white.problem, {}, VecX::Zero(problem.b.size())};
  if (solution->gamma.size() == problem.b.size()) sub.centre = solution->gamma;

  const double tolerance = 0.1 * options.tolerance * root_mean_mass(problem) * options.reference_speed;
  double share = 1.0, best = std::numeric_limits<double>::infinity();
  Residuals best_residuals;
  while (best > 1.0 && summary.outer_iterations < kMaxOuterIterations && share <= kLargestShare) {
    ++summary.outer_iterations;
    sub.R = share * diagonal;
    VecX next = w;
    if (!solve_coulomb_subproblem(sub, tolerance, &next, &summary)) {
      share *= 10.0;
      continue;
    }
    share = std::max(0.3 * share, kSmallestShare);
    w = next;
    sub.centre = sub.impulses(w);
    const ContactSolution x{white.to_v(w), sub.centre};
    CUPOLA_ASSERT(x.v.allFinite() && x.gamma.allFinite());
    const Residuals residuals = compute_residuals(problem, x, options.reference_speed, FrictionLaw::coulomb);
    const double error = excess(residuals, options.tolerance);
    summary.residual_history.push_back(largest_residual(residuals));
    if (error < best) {
      best = error;
      best_residuals = residuals;
      *solution = x;
    }
  }
  summary.time_seconds = wall_seconds() - start;
  if (!std::isfinite(best)) {
    summary.message = fmt::format("no proximal point of Coulomb's law found in {} outer iterations",
                                  summary.outer_iterations);
    return summary;
  }
  summary.ending = best <= 1.0 ? SolveEnding::converged : SolveEnding::stalled;
  summary.measure = ErrorMeasure::all_residuals;
  summary.reached = largest_residual(best_residuals);
  summary.message = fmt::format("{}, after {} proximal points",
                                residuals_text(best_residuals, options.tolerance), summary.outer_iterations);
  return summary;
}

}  // namespace cupola

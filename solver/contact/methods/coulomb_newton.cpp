#include "solver/contact/methods/coulomb_newton.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/base/error.hpp"
#include "assembly/base/process.hpp"
#include "solver/contact/methods/gmres.hpp"
#include "solver/contact/problem/cone.hpp"
#include "solver/contact/problem/residuals.hpp"
#include "solver/contact/problem/whitening.hpp"
#include "solver/runtime/interruption.hpp"

namespace cupola {

namespace {

/// w = v_star + D Gamma(D^T w + b - R centre), whitened.
struct CoulombSubproblem {
  const ContactProblem& p;
  const ContactGraph& graph;
  double dilatancy;
  VecX R;       ///< 1/kg (nc)
  VecX centre;  ///< gamma_k (3 nc)

  ContactLaw contact(int i) const {
    ContactLaw law = contact_law(p, i, p.E[3 * i] + R[i], p.E[3 * i + 1] + R[i]);
    law.dilatancy = dilatancy;
    return law;
  }
  VecX velocity(const VecX& w) const;
  VecX impulses(const VecX& y) const;
  /// d residual / d w = I + D G D^T at the relative velocities y.
  UnsymmetricBlockMatrix jacobian(const VecX& y) const;
};

VecX CoulombSubproblem::velocity(const VecX& w) const {
  VecX y = relative_velocity(p, w) + p.b;
  for (int i = 0; i < p.num_contacts(); ++i) y.segment<3>(3 * i) -= R[i] * centre.segment<3>(3 * i);
  return y;
}

VecX CoulombSubproblem::impulses(const VecX& y) const {
  VecX gamma(y.size());
  for (int i = 0; i < p.num_contacts(); ++i)
    gamma.segment<3>(3 * i) = contact_impulse(contact(i), y.segment<3>(3 * i));
  return gamma;
}

UnsymmetricBlockMatrix CoulombSubproblem::jacobian(const VecX& y) const {
  std::vector<Mat3> G(p.num_contacts());
  for (int i = 0; i < p.num_contacts(); ++i) G[i] = contact_stiffness(contact(i), y.segment<3>(3 * i));
  return assemble_jacobian(p, graph, G);
}

struct CoulombPoint {
  VecX w, y, gamma, F;  ///< F: w - v_star - D gamma
};

CoulombPoint point_at(const CoulombSubproblem& sub, VecX w) {
  CoulombPoint point{std::move(w), {}, {}, {}};
  point.y = sub.velocity(point.w);
  point.gamma = sub.impulses(point.y);
  point.F = point.w - sub.p.v_star - generalized_impulse(sub.p, point.gamma);
  return point;
}

/// The solution with all contacts sticking, including those with a gap. False if the matrix is singular.
bool all_stick_start(const CoulombSubproblem& sub, BlockLu* lu, VecX* w) {
  const ContactProblem& p = sub.p;
  std::vector<Mat3> G(p.num_contacts());
  for (int i = 0; i < p.num_contacts(); ++i) G[i] = sticking_stiffness(sub.contact(i));
  if (!lu->factorize(sub.graph.pattern, assemble_jacobian(p, sub.graph, G))) return false;
  VecX impulse(p.b.size());
  const VecX y = sub.velocity(VecX::Zero(p.v_star.size()));
  for (int i = 0; i < p.num_contacts(); ++i) impulse.segment<3>(3 * i) = -G[i] * y.segment<3>(3 * i);
  *w = lu->solve(p.v_star + generalized_impulse(p, impulse));
  return w->allFinite();
}

double largest_block(const VecX& F) {
  double largest = 0.0;
  for (Eigen::Index k = 0; k < F.size(); k += 6) {
    const double norm = F.segment<6>(k).norm();
    if (!(norm <= largest)) largest = norm;  // keeps NaN
  }
  return largest;
}

/// J d = F by GMRES with the existing factor where `forcing` is given and that succeeds, otherwise by a new
/// factor.
bool solve_direction(const BlockPattern& pattern, const UnsymmetricBlockMatrix& J, const VecX& F,
                     std::optional<double> forcing, BlockLu* lu, VecX* d, SolveSummary* summary) {
  constexpr int kMaxIterations = 6;  // half the cost of a factorisation at 1,000 blocks
  if (forcing && lu->has_factor() && lu->pattern() == pattern) {
    const int iterations = gmres([&](const VecX& x) { return multiply(pattern, J, x); },
                                 [&](const VecX& r) { return lu->solve(r); }, F, *forcing, kMaxIterations, d);
    summary->conjugate_gradients += iterations > 0 ? iterations : kMaxIterations;
    if (iterations > 0) return true;
  }
  ++summary->factorizations;
  if (!lu->factorize(pattern, J)) return false;
  *d = lu->solve(F);
  return d->allFinite();
}

/// Semismooth Newton from `point`, with a line search on |F|. True if no block of F exceeds `tolerance`;
/// otherwise point is the last iterate. Gives up where |F| has not halved in six iterations.
bool solve_subproblem(const CoulombSubproblem& sub, double tolerance, const SolveOptions& options,
                      BlockLu* lu, CoulombPoint* point, SolveSummary* summary) {
  constexpr int kMaxIterations = 30, kPatience = 6;
  constexpr double kShortest = 1.0 / 64.0, kDecrease = 1e-4;
  const int max_iterations = options.max_iterations.value_or(kMaxIterations);
  std::vector<double> norms;
  for (int k = 0; k < max_iterations && !(largest_block(point->F) <= tolerance); ++k) {
    throw_if_interrupted();
    const VecX& F = point->F;
    norms.push_back(F.norm());
    if (k >= kPatience && norms[k] > 0.5 * norms[k - kPatience]) return false;
    ++summary->iterations;
    std::optional<double> forcing;
    if (options.lag_factor) forcing = std::clamp(0.3 * tolerance / largest_block(F), 1e-2, 0.1);
    VecX d;
    if (!solve_direction(sub.graph.pattern, sub.jacobian(point->y), F, forcing, lu, &d, summary))
      return false;
    CoulombPoint trial;
    double t = 2.0;
    do {  // halved until |F| decreases: the map has kinks, so its slope is unreliable
      t *= 0.5;
      trial = point_at(sub, point->w - t * d);
      ++summary->line_search_evaluations;
    } while (!(trial.F.norm() < (1.0 - kDecrease * t) * F.norm()) && t > kShortest);
    if (!(trial.F.norm() < F.norm())) return false;
    *point = std::move(trial);
  }
  return largest_block(point->F) <= tolerance;
}

/// The best solution so far, judged by residuals of the given problem.
struct BestSolution {
  const ContactProblem& problem;
  const WhitenedProblem& white;
  const ContactSolverOptions& options;
  ContactSolution* solution;
  double error = std::numeric_limits<double>::infinity();
  Residuals residuals{};

  void include(const VecX& w, const VecX& gamma, SolveSummary* summary) {
    const ContactSolution x{white.to_v(w), gamma};
    if (!x.v.allFinite() || !x.gamma.allFinite()) return;
    const Residuals now = compute_residuals(problem, x, options.reference_speed, options.law);
    summary->residual_history.push_back(largest_residual(now));
    const double excess_now = excess(now, options.tolerance);
    if (!(excess_now < error)) return;
    error = excess_now;
    residuals = now;
    *solution = x;
  }
};

}  // namespace

SolveSummary CoulombNewton::solve(const ContactProblem& problem, const ContactSolverOptions& options,
                                  ContactSolution* solution) {
  constexpr double kShare = 0.5;  // of the tolerance, so that residuals computed anew meet it too
  constexpr int kMaxOuterIterations = 200;
  constexpr double kFirstShare = 1.0, kLargestShare = 1e3, kSmallestShare = 1e-6;
  const double start = wall_seconds();
  options.validate();
  SolveSummary summary;
  if (summary.message = problem.defect(); !summary.message.empty()) return summary;
  const WhitenedProblem white = whiten(problem);
  const ContactGraph graph = contact_graph(problem);
  CoulombSubproblem sub{white.problem, graph, options.law.dilatancy, VecX::Zero(problem.num_contacts()),
                        VecX::Zero(problem.b.size())};
  const bool rigid = first_rigid_contact(problem).has_value();
  const double scale = root_mean_mass(problem) * options.reference_speed;
  const double tolerance = kShare * options.tolerance * scale;
  BestSolution best{problem, white, options, solution};
  VecX w = white.problem.v_star;
  if (solution->v.size() == problem.v_star.size())
    w = white.to_w(solution->v);
  else if (!rigid)
    all_stick_start(sub, &lu_, &w);

  // 1. Plain Newton
  if (!rigid) {
    factor_share_ = 0.0;
    CoulombPoint next = point_at(sub, w);
    const bool solved = solve_subproblem(sub, tolerance, options, &lu_, &next, &summary);
    if (solved || options.max_iterations) {
      const double reached = largest_block(next.F) / scale;
      *solution = {white.to_v(next.w), std::move(next.gamma)};
      summary.reached = reached;
      summary.residual_history.push_back(reached);
      const bool finite = std::isfinite(reached) && solution->v.allFinite() && solution->gamma.allFinite();
      summary.ending = !finite                                         ? SolveEnding::failed
                       : solved                                        ? SolveEnding::converged
                       : summary.iterations >= *options.max_iterations ? SolveEnding::max_iterations
                                                                       : SolveEnding::stalled;
      summary.message =
          fmt::format("momentum residual {:.2e} {} tolerance {:.2e} after {}", reached, solved ? "<=" : ">",
                      options.tolerance, counted(summary.iterations, "iteration"));
      summary.time_seconds = wall_seconds() - start;
      return summary;
    }
    best.include(next.w, next.gamma, &summary);
  }

  // 2. Proximal points
  const VecX diagonal = delassus_traces(problem) / 3.0;
  if (solution->gamma.size() == problem.b.size()) sub.centre = solution->gamma;
  SolveOptions inner = options;
  double share = rigid ? share_ : kFirstShare;
  while (best.error > 1.0 && summary.outer_iterations < kMaxOuterIterations && share <= kLargestShare) {
    ++summary.outer_iterations;
    sub.R = share * diagonal;
    inner.lag_factor = options.lag_factor && rigid && share == factor_share_;  // R changes the matrix
    factor_share_ = share;
    CoulombPoint next = point_at(sub, w);
    if (!solve_subproblem(sub, 0.2 * tolerance, inner, &lu_, &next, &summary)) {
      // What was right for the last problem is not for this one.
      share = summary.outer_iterations == 1 && share < kFirstShare ? kFirstShare : 10.0 * share;
      continue;
    }
    share_ = share;
    share = std::max(0.3 * share, kSmallestShare);
    w = std::move(next.w);
    sub.centre = std::move(next.gamma);
    best.include(w, sub.centre, &summary);
  }
  summary.time_seconds = wall_seconds() - start;
  if (!(best.error <= 1.0)) share_ = kFirstShare;
  if (!std::isfinite(best.error)) {
    summary.message = fmt::format("Newton found no usable point of the friction law in {}",
                                  counted(summary.iterations, "iteration"));
    return summary;
  }
  summary.ending = best.error <= 1.0 ? SolveEnding::converged : SolveEnding::stalled;
  summary.measure = ErrorMeasure::all_residuals;
  summary.reached = largest_residual(best.residuals);
  summary.message = fmt::format("{}, after {} for {}", residuals_text(best.residuals, options.tolerance),
                                counted(summary.iterations, "Newton iteration"),
                                counted(summary.outer_iterations, "proximal point"));
  return summary;
}

}  // namespace cupola

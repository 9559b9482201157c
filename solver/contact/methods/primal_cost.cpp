#include "solver/contact/methods/primal_cost.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "assembly/base/error.hpp"
#include "solver/contact/problem/cone.hpp"
#include "solver/runtime/threads.hpp"

namespace cupola {

namespace {

constexpr double kOperationsPerContact = 150.0;

/// 1/2 gamma^T E gamma - gamma . z of one contact.
double contact_cost(const ContactProblem& p, int i, const Vec3& y, const Vec3& gamma) {
  double cost = 0.5 * p.E[3 * i] * gamma[0] * gamma[0];
  if (contact_law(p, i).carries_shear()) cost += 0.5 * p.E[3 * i + 1] * gamma.tail<2>().squaredNorm();
  if (!p.strength.empty()) cost -= gamma.dot(y + p.E.segment<3>(3 * i).cwiseProduct(gamma));
  return cost;
}

}  // namespace

PrimalPoint primal_point(const WhitenedProblem& problem, VecX w) {
  const ContactProblem& p = problem.given;
  CUPOLA_ASSERT(w.size() == 6 * p.num_blocks());
  PrimalPoint point;
  point.w = std::move(w);
  point.y.resize(p.b.size());
  point.gamma.resize(p.b.size());
  const VecX v = problem.to_v(point.w), momentum = point.w - problem.w_star;
  VecX impulse = VecX::Zero(momentum.size());
  VecX costs(p.num_contacts());
  // One pass, because reading D dominates the cost.
  share_sums(kOperationsPerContact * p.num_contacts(), p.num_blocks(), [&](int first, int last) {
    const auto in_range = [&](int block) { return first <= block && block < last; };
    for (int i = 0; i < p.num_contacts(); ++i) {
      const int a = p.block_a[i], b = p.block_b[i];
      if (!in_range(a) && !in_range(b)) continue;
      const Vec3 y = relative_velocity(p, i, v) + p.b.segment<3>(3 * i);
      const Vec3 gamma = contact_impulse(contact_law(p, i), y);
      if (in_range(a)) p.D_a[i].add_impulse(gamma, impulse.segment<6>(6 * a));
      if (in_range(b)) p.D_b[i].add_impulse(gamma, impulse.segment<6>(6 * b));
      if (!in_range(a != ContactProblem::kFixed ? a : b)) continue;
      point.y.segment<3>(3 * i) = y;
      point.gamma.segment<3>(3 * i) = gamma;
      costs[i] = contact_cost(p, i, y, gamma);
    }
  });
  point.cost = 0.5 * momentum.squaredNorm();
  for (const double cost : costs) point.cost += cost;  // in order: the same bits for any number of threads
  point.gradient = momentum - problem.whiten_impulse(impulse);
  for (int k = 0; k < p.num_blocks(); ++k) {
    const double norm = point.gradient.segment<6>(6 * k).norm();
    if (!(norm <= point.largest_block_gradient)) point.largest_block_gradient = norm;  // keeps NaN
  }
  return point;
}

namespace {

/// Slope and curvature of the cost along w + t d. The slope is computed as the change from t = 0, so that the
/// large terms that balance each other there do not cancel in every evaluation.
class Line {
 public:
  Line(const WhitenedProblem& problem, const PrimalPoint& point, const VecX& d)
      : p_(problem.given),
        point_(point),
        dy_(relative_velocity(problem, d)),
        slope0_(d.dot(point.gradient)),
        dd_(d.squaredNorm()),
        terms_(p_.num_contacts()) {}

  double slope0() const { return slope0_; }

  struct Derivatives {
    double slope, curvature;
  };
  Derivatives at(double t) {
    const int nc = p_.num_contacts();
    share_sums(kOperationsPerContact * nc, nc, [&](int first, int last) {
      for (int i = first; i < last; ++i) {
        const Vec3 dy = dy_.segment<3>(3 * i);
        const ContactResponse contact =
            contact_response(contact_law(p_, i), point_.y.segment<3>(3 * i) + t * dy, dy);
        terms_[i] = {(contact.impulse - point_.gamma.segment<3>(3 * i)).dot(dy), contact.curvature};
      }
    });
    Derivatives result{slope0_ + t * dd_, dd_};
    for (const Derivatives& term : terms_) {  // in order: the same bits for any number of threads
      result.slope -= term.slope;
      result.curvature += term.curvature;
    }
    return result;
  }

 private:
  const ContactProblem& p_;
  const PrimalPoint& point_;
  VecX dy_;
  double slope0_;
  double dd_;
  std::vector<Derivatives> terms_;  ///< of the contacts
};

}  // namespace

LineSearchResult line_search(const WhitenedProblem& problem, const PrimalPoint& point, const VecX& d,
                             double slope_reduction) {
  constexpr int kMaxEvaluations = 60;  // enough for bisection alone to reach double precision
  CUPOLA_ASSERT(d.size() == point.w.size());
  Line line(problem, point, d);
  double low = 0.0, high = std::numeric_limits<double>::infinity();
  LineSearchResult result{1.0, 0};
  while (result.evaluations < kMaxEvaluations) {
    const auto [slope, curvature] = line.at(result.t);
    ++result.evaluations;
    if (!(std::abs(slope) > slope_reduction * std::abs(line.slope0()))) break;
    (slope > 0.0 ? high : low) = result.t;
    double next = result.t - slope / curvature;
    if (std::isinf(high)) {
      next = std::clamp(next, 1.5 * result.t, 10.0 * result.t);
    } else if (!(next > low + 0.01 * (high - low) && next < high - 0.01 * (high - low))) {
      next = 0.5 * (low + high);
    }
    if (next == result.t || high - low <= 1e-14 * high) break;
    result.t = next;
  }
  return result;
}

}  // namespace cupola

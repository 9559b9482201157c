#include "solver/contact/methods/primal_cost.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "assembly/base/error.hpp"
#include "solver/contact/problem/cone.hpp"

namespace cupola {

PrimalPoint primal_point(const ContactProblem& p, VecX w) {
  CUPOLA_ASSERT(w.size() == 6 * p.num_blocks());
  PrimalPoint point;
  point.w = std::move(w);
  point.y.resize(p.b.size());
  point.gamma.resize(p.b.size());
  const VecX momentum = point.w - p.v_star;
  point.cost = 0.5 * momentum.squaredNorm();
  VecX impulse = VecX::Zero(momentum.size());
  for (int i = 0; i < p.num_contacts(); ++i) {  // one pass, because reading D dominates the cost
    const Vec3 y = relative_velocity(p, i, point.w) + p.b.segment<3>(3 * i);
    const ContactLaw law = contact_law(p, i);
    const Vec3 gamma = contact_impulse(law, y);
    add_impulse(p, i, gamma, &impulse);
    point.y.segment<3>(3 * i) = y;
    point.gamma.segment<3>(3 * i) = gamma;
    point.cost += 0.5 * p.E[3 * i] * gamma[0] * gamma[0];
    if (law.carries_shear()) point.cost += 0.5 * p.E[3 * i + 1] * gamma.tail<2>().squaredNorm();
    if (!p.strength.empty()) point.cost -= gamma.dot(y + p.E.segment<3>(3 * i).cwiseProduct(gamma));
  }
  point.gradient = momentum - impulse;
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
  Line(const ContactProblem& p, const PrimalPoint& point, const VecX& d)
      : p_(p),
        point_(point),
        dy_(relative_velocity(p, d)),
        slope0_(d.dot(point.gradient)),
        dd_(d.squaredNorm()) {}

  double slope0() const { return slope0_; }

  struct Derivatives {
    double slope, curvature;
  };
  Derivatives at(double t) const {
    Derivatives result{slope0_ + t * dd_, dd_};
    for (int i = 0; i < p_.num_contacts(); ++i) {
      const Vec3 dy = dy_.segment<3>(3 * i);
      const ContactResponse contact =
          contact_response(contact_law(p_, i), point_.y.segment<3>(3 * i) + t * dy, dy);
      result.slope -= (contact.impulse - point_.gamma.segment<3>(3 * i)).dot(dy);
      result.curvature += contact.curvature;
    }
    return result;
  }

 private:
  const ContactProblem& p_;
  const PrimalPoint& point_;
  VecX dy_;
  double slope0_;
  double dd_;
};

}  // namespace

LineSearchResult line_search(const ContactProblem& p, const PrimalPoint& point, const VecX& d,
                             double slope_reduction) {
  constexpr int kMaxEvaluations = 60;  // enough for bisection alone to reach double precision
  CUPOLA_ASSERT(d.size() == point.w.size());
  const Line line(p, point, d);
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

#include "solver/conic/motion_proof.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include "solver/conic/opening_motion.hpp"
#include "solver/conic/solve_conic.hpp"
#include "solver/contact/problem/cone.hpp"

namespace cupola {
namespace {

constexpr double kEps = std::numeric_limits<double>::epsilon();

/// Bound of the rounding of D_i^T v, per component.
Vec3 rounding_of_velocity(const ContactProblem& p, int i, const VecX& v) {
  constexpr double kOperations = 16.0;  // sums of twelve products
  Vec3 size = Vec3::Zero();
  const auto add = [&](int k, const Lever& D) {
    if (k != ContactProblem::kFixed) size += D.size_of_velocity(v.segment<6>(6 * k));
  };
  add(p.block_a[i], p.D_a[i]);
  add(p.block_b[i], p.D_b[i]);
  return kOperations * kEps * size;
}

/// What the joints dissipate in the motion, an upper bound. Infinite if one without limit of compression
/// approaches. At a given s_n it grows with the slip, because mu times the tension limit is at most the
/// cohesion: bounds of both components bound the dissipation.
long double largest_dissipation(const ContactProblem& p, const VecX& v) {
  long double sum = 0.0;
  for (int i = 0; i < p.num_contacts(); ++i) {
    const ContactLaw law = contact_law(p, i);
    const Vec3 s = relative_velocity(p, i, v), error = rounding_of_velocity(p, i, v);
    const double slip =
        law.carries_shear() ? (1.0 + 4.0 * kEps) * s.tail<2>().norm() + error.tail<2>().norm() : 0.0;
    const double closing = (1.0 + 4.0 * kEps) * law.mu * slip + error[0] - s[0];
    if (closing > 0.0 && !std::isfinite(law.strength.compression)) return INFINITY;
    if (closing > 0.0) sum += law.strength.compression * closing;
    sum += law.dissipation(slip, s[0] + error[0] - law.mu * slip);
  }
  return sum;
}

}  // namespace

bool proves_motion(const ContactProblem& contacts, const VecX& load, const VecX& v) {
  if (!v.allFinite()) return false;
  long double power = 0.0, size = 0.0;
  for (Eigen::Index k = 0; k < v.size(); ++k) {
    const long double product = static_cast<long double>(load[k]) * v[k];
    power += product;
    size += std::abs(product);
  }
  const long double rounding =
      static_cast<long double>(v.size()) * std::numeric_limits<long double>::epsilon();
  const long double dissipated = largest_dissipation(contacts, v);
  // Its terms are positive: their relative error is that of one.
  constexpr long double kOfTerms = 1e-12L;
  return power - rounding * size > (1.0L + kOfTerms) * dissipated;
}

MotionProof::MotionProof(const ContactProblem& contacts, const VecX& load) {
  problem_.contacts = contacts;
  problem_.load = load;
  problem_.cost = VecX::Zero(3 * contacts.num_contacts());
  problem_.load_columns = MatX(load.size(), 0);
  problem_.rows = MatX(problem_.cost.size(), 0);
}

const VecX& MotionProof::opening() {
  if (!opening_) opening_ = opening_motion(problem_);
  return *opening_;
}

std::optional<VecX> MotionProof::next_to(const VecX& v) {
  const ContactProblem& p = problem_.contacts;
  if (proves_motion(p, problem_.load, v)) return v;
  if (opening().size() == 0) return std::nullopt;
  const VecX inside = distance_inside(p, v), gained = distance_inside(p, opening());
  constexpr double kMargin = 2.0;  // covers the rounding of the sum
  double share = 0.0;
  for (int i = 0; i < p.num_contacts(); ++i) {
    if (crushes(p, i)) continue;
    const double rounding = (1.0 + p.mu[i]) * rounding_of_velocity(p, i, v).maxCoeff();
    share = std::max(share, kMargin * (rounding - inside[i]) / gained[i]);
  }
  VecX opened = v + share * opening();
  if (!proves_motion(p, problem_.load, opened)) return std::nullopt;
  return opened;
}

MotionProof::Answer MotionProof::search() {
  if (answer_) return *answer_;
  answer_ = Answer::unknown;
  const ContactProblem& p = problem_.contacts;
  for (int i = 0; i < p.num_contacts() && !p.strength.empty(); ++i)
    if (p.mu[i] == 0.0 && p.strength[i].cohesion > 0.0) return *answer_;  // no cone (dry_problem.hpp)
  const ConicSolution solution = solve_conic(problem_);
  if (solution.outcome == ConicOutcome::optimal) {
    answer_ = Answer::admissible;
    forces_ = solution.gamma;
  } else if (solution.outcome == ConicOutcome::infeasible) {
    if (std::optional<VecX> proof = next_to(solution.v)) {
      answer_ = Answer::moves;
      mechanism_ = std::move(*proof);
    }
  }
  return *answer_;
}

}  // namespace cupola

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

/// 1 for the blocks at rest in a motion, 0 for those that move (nb).
std::vector<char> blocks_at_rest(const ContactProblem& p, const VecX& v) {
  constexpr double kAtRest = 1e-6;  // of the fastest; certificates of the conic solver are exact to 1e-9
  VecX speed(p.num_blocks());
  for (int k = 0; k < p.num_blocks(); ++k) {
    const Eigen::Vector<double, 6> of_block = v.segment<6>(6 * k);
    speed[k] = std::sqrt(of_block.dot(p.M[k] * of_block) / p.M[k](0, 0));
  }
  std::vector<char> rest(static_cast<size_t>(p.num_blocks()));
  for (int k = 0; k < p.num_blocks(); ++k) rest[k] = speed[k] <= kAtRest * speed.maxCoeff() ? 1 : 0;
  return rest;
}

/// The contacts of the blocks that are not held, to those that are as to fixed ones.
ContactProblem beside_held(const ContactProblem& p, const std::vector<char>& held) {
  ContactProblem rest;
  rest.M = p.M;
  rest.v_star = VecX::Zero(p.v_star.size());
  rest.plane = p.plane;
  std::vector<double> mu;
  const auto free_of = [&](int k) {
    return k == ContactProblem::kFixed || held[k] != 0 ? ContactProblem::kFixed : k;
  };
  for (int i = 0; i < p.num_contacts(); ++i) {
    const int a = free_of(p.block_a[i]), b = free_of(p.block_b[i]);
    if (a == ContactProblem::kFixed && b == ContactProblem::kFixed) continue;
    rest.block_a.push_back(a);
    rest.block_b.push_back(b);
    rest.D_a.push_back(p.D_a[i]);
    rest.D_b.push_back(p.D_b[i]);
    mu.push_back(p.mu[i]);
    if (!p.strength.empty()) rest.strength.push_back(p.strength[i]);
  }
  rest.mu = Eigen::Map<const VecX>(mu.data(), static_cast<Eigen::Index>(mu.size()));
  return rest;
}

/// The scene without its objective.
ConicProblem without_objective(const ContactProblem& contacts, const VecX& load) {
  ConicProblem problem;
  problem.contacts = contacts;
  problem.load = load;
  problem.cost = VecX::Zero(3 * contacts.num_contacts());
  problem.load_columns = MatX(load.size(), 0);
  problem.rows = MatX(problem.cost.size(), 0);
  return problem;
}

/// v and so much of a motion that opens every contact of `problem` that all its s lie in Y*.
VecX opened(const ContactProblem& p, const VecX& v, const VecX& opening) {
  const VecX inside = distance_inside(p, v), gained = distance_inside(p, opening);
  constexpr double kMargin = 2.0;  // covers the rounding of the sum
  double share = 0.0;
  for (int i = 0; i < p.num_contacts(); ++i) {
    if (crushes(p, i)) continue;
    const double rounding = (1.0 + p.mu[i]) * rounding_of_velocity(p, i, v).maxCoeff();
    share = std::max(share, kMargin * (rounding - inside[i]) / gained[i]);
  }
  return v + share * opening;
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

MotionProof::MotionProof(const ContactProblem& contacts, const VecX& load)
    : problem_(without_objective(contacts, load)) {}

const VecX& MotionProof::opening() {
  if (!opening_) opening_ = opening_motion(problem_);
  return *opening_;
}

std::optional<VecX> MotionProof::next_to(const VecX& v) {
  const ContactProblem& p = problem_.contacts;
  const auto proof = [&](VecX motion) {
    return proves_motion(p, problem_.load, motion) ? std::optional(std::move(motion)) : std::nullopt;
  };
  if (auto own = proof(v)) return own;
  if (opening().size() > 0) return proof(opened(p, v, opening()));
  // Joints that jam, ties and restraints cannot open. Those of blocks at rest need not.
  const std::vector<char> rest = blocks_at_rest(p, v);
  VecX beside = v;
  for (int k = 0; k < p.num_blocks(); ++k)
    if (rest[k] != 0) beside.segment<6>(6 * k).setZero();
  const ConicProblem moving = without_objective(beside_held(p, rest), problem_.load);
  if (moving.contacts.num_contacts() == p.num_contacts()) return std::nullopt;
  const VecX apart = opening_motion(moving);
  return apart.size() > 0 ? proof(opened(moving.contacts, beside, apart)) : std::nullopt;
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

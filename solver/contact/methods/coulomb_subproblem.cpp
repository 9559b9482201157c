#include "solver/contact/methods/coulomb_subproblem.hpp"

#include <algorithm>
#include <optional>
#include <utility>

#include "solver/runtime/interruption.hpp"
#include "solver/runtime/threads.hpp"

namespace cupola {
namespace {

/// What is added to the diagonal of J where full directions do not reduce |F|: a block whose contacts all
/// slide has no stiffness along a direction in which the smallest motion makes some of them stick.
class Damping {
 public:
  double value() const { return value_; }
  void include_success(double t, double step) {
    constexpr double kEasing = 0.1, kNegligible = 1.0;  // the diagonal of J without contacts is 1
    step_ = step;
    if (t == 1.0) value_ *= kEasing;
    if (value_ < kNegligible) value_ = 0.0;
  }
  /// False if this was tried often enough. `F`: norm; `direction`: norm of that along which F did not fall.
  bool include_failure(double F, double direction) {
    constexpr double kGrowth = 100.0, kShare = 0.1;
    constexpr int kMost = 6;
    // The stiffness against the last step that succeeded lets the next be as long as that.
    const double stiffness = step_ > 0.0 ? kShare * F / step_ : F / direction;
    value_ = std::max(kGrowth * value_, stiffness);
    return ++failures_ <= kMost;
  }

 private:
  double value_ = 0.0;
  double step_ = 0.0;  // norm of the last step that succeeded
  int failures_ = 0;
};

/// Calls body(i) for every contact, on all threads.
template <class Body>
void by_contacts(const CoulombSubproblem& sub, const Body& body) {
  constexpr double kOperationsPerContact = 100.0;
  const int nc = sub.white.given.num_contacts();
  share_sums(kOperationsPerContact * nc, nc, [&](int first, int last) {
    for (int i = first; i < last; ++i) body(i);
  });
}

}  // namespace

VecX CoulombSubproblem::velocity(const VecX& w) const {
  VecX y = relative_velocity(white, w);
  by_contacts(*this, [&](int i) {
    y.segment<3>(3 * i) += white.given.b.segment<3>(3 * i);
    y.segment<3>(3 * i) -= R[i] * centre.segment<3>(3 * i);
  });
  return y;
}

VecX CoulombSubproblem::impulses(const VecX& y) const {
  VecX gamma(y.size());
  by_contacts(*this,
              [&](int i) { gamma.segment<3>(3 * i) = contact_impulse(contact(i), y.segment<3>(3 * i)); });
  return gamma;
}

std::vector<Mat3> CoulombSubproblem::stiffnesses(const VecX& y) const {
  std::vector<Mat3> G(white.given.num_contacts());
  by_contacts(*this, [&](int i) { G[i] = contact_stiffness(contact(i), y.segment<3>(3 * i)); });
  return G;
}

double CoulombSubproblem::distance_to_centre(const VecX& gamma) const {
  double largest = 0.0;
  for (int i = 0; i < R.size(); ++i)
    largest = std::max(largest, R[i] * (gamma - centre).segment<3>(3 * i).norm());
  return root_mass * largest;
}

CoulombPoint point_at(const CoulombSubproblem& sub, VecX w) {
  CoulombPoint point{std::move(w), {}, {}, {}};
  point.y = sub.velocity(point.w);
  point.gamma = sub.impulses(point.y);
  point.F = point.w - sub.white.w_star - generalized_impulse(sub.white, point.gamma);
  return point;
}

StickingSystem sticking_system(const CoulombSubproblem& sub) {
  const ContactProblem& p = sub.white.given;
  StickingSystem system;
  const VecX y = sub.velocity(VecX::Zero(p.v_star.size()));
  VecX impulse(p.b.size());
  for (int i = 0; i < p.num_contacts(); ++i) {
    system.G.push_back(sticking_stiffness(sub.contact(i)));
    impulse.segment<3>(3 * i) = -system.G[i] * y.segment<3>(3 * i);
  }
  system.rhs = sub.white.w_star + generalized_impulse(sub.white, impulse);
  return system;
}

bool keeps_sticking(const CoulombSubproblem& sub, const CoulombPoint& point) {
  // Chosen: domes that stick give up to 0.01, domes that slide 0.05 and more, blocks that jam between uprights
  // 0.5 and more.
  constexpr double kShare = 0.03;
  constexpr double kRounding = 1e-12;
  for (Eigen::Index k = 0; k < point.F.size(); k += 6) {
    const auto free = sub.white.w_star.segment<6>(k);
    const double by_contacts = (point.w.segment<6>(k) - free).norm();
    if (!(point.F.segment<6>(k).norm() <= kShare * by_contacts + kRounding * free.norm())) return false;
  }
  return true;
}

double largest_block_norm(const VecX& F) {
  double largest = 0.0;
  for (Eigen::Index k = 0; k < F.size(); k += 6) {
    const double norm = F.segment<6>(k).norm();
    if (!(norm <= largest)) largest = norm;  // keeps NaN
  }
  return largest;
}

bool solve_subproblem(const CoulombSubproblem& sub, const SubproblemAccuracy& accuracy,
                      const SolveOptions& options, CoulombDirection* direction, CoulombPoint* point,
                      SolveSummary* summary) {
  constexpr int kMaxIterations = 30, kPatience = 6;
  constexpr double kShortest = 1.0 / 64.0, kDecrease = 1e-4;
  const int max_iterations = options.max_iterations.value_or(kMaxIterations);
  std::vector<double> norms;
  Damping damping;
  const auto is_solved = [&] {
    double tolerance = accuracy.tolerance;
    if (accuracy.share > 0.0)
      tolerance = std::max(tolerance, accuracy.share * sub.distance_to_centre(point->gamma));
    return largest_block_norm(point->F) <= tolerance;
  };
  for (int k = 0; k < max_iterations && !is_solved(); ++k) {
    throw_if_interrupted();
    const VecX& F = point->F;
    norms.push_back(F.norm());
    if (k >= kPatience && norms[k] > 0.5 * norms[k - kPatience]) return false;
    ++summary->iterations;
    std::optional<double> forcing;
    if (accuracy.inexact_directions && damping.value() == 0.0)
      forcing = std::clamp(0.3 * accuracy.tolerance / largest_block_norm(F), 1e-2, 0.1);
    VecX d;
    if (!direction->solve(sub.stiffnesses(point->y), F, {forcing, damping.value()}, &d, summary))
      return false;
    CoulombPoint trial;
    double t = 2.0;
    do {  // halved until |F| decreases: the map has kinks, so its slope is unreliable
      t *= 0.5;
      trial = point_at(sub, point->w - t * d);
      ++summary->line_search_evaluations;
    } while (!(trial.F.norm() < (1.0 - kDecrease * t) * F.norm()) && t > kShortest);
    if (!(trial.F.norm() < F.norm())) {
      if (!options.near_solution || !damping.include_failure(F.norm(), d.norm())) return false;
      continue;
    }
    damping.include_success(t, t * d.norm());
    *point = std::move(trial);
  }
  return is_solved();
}

}  // namespace cupola

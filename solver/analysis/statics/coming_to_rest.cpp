#include "solver/analysis/statics/coming_to_rest.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Cholesky>
#include <fmt/format.h>

#include "solver/contact/methods/newton.hpp"
#include "solver/contact/problem/cone.hpp"

// The verdict on motions is in proximal_verdict.cpp.

namespace cupola {
namespace {

/// Marks the given blocks and those that at most `reach` joints separate from them.
std::vector<char> blocks_around(const ContactProblem& p, const std::vector<int>& blocks, int reach) {
  std::vector<char> marked(p.num_blocks());
  for (const int block : blocks) marked[block] = 1;
  for (int k = 0; k < reach; ++k) {
    const std::vector<char> before = marked;
    for (int i = 0; i < p.num_contacts(); ++i) {
      const int a = p.block_a[i], b = p.block_b[i];
      if (a == ContactProblem::kFixed || b == ContactProblem::kFixed) continue;
      if (before[a] != 0) marked[b] = 1;
      if (before[b] != 0) marked[a] = 1;
    }
  }
  return marked;
}

VecX choose(const VecX& values, const std::vector<int>& which, int size) {
  VecX chosen(size * std::ssize(which));
  for (Eigen::Index k = 0; k < std::ssize(which); ++k)
    chosen.segment(size * k, size) = values.segment(Eigen::Index{size} * which[k], size);
  return chosen;
}

/// The problem of some blocks, while the others rest.
ContactProblem problem_of(const ContactProblem& whole, const std::vector<int>& blocks) {
  ContactProblem p;
  p.h = whole.h;
  p.plane = whole.plane;
  p.v_star = choose(whole.v_star, blocks, 6);
  std::vector<int> index(whole.num_blocks(), ContactProblem::kFixed);
  for (const int block : blocks) {
    index[block] = p.num_blocks();
    p.M.push_back(whole.M[block]);
  }
  const auto index_of = [&](int block) { return block == ContactProblem::kFixed ? block : index[block]; };
  std::vector<int> rows;
  for (int i = 0; i < whole.num_contacts(); ++i) {
    const int a = index_of(whole.block_a[i]), b = index_of(whole.block_b[i]);
    if (a == ContactProblem::kFixed && b == ContactProblem::kFixed) continue;
    rows.push_back(i);
    p.block_a.push_back(a);
    p.block_b.push_back(b);
    p.D_a.push_back(whole.D_a[i]);
    p.D_b.push_back(whole.D_b[i]);
    if (!whole.strength.empty()) p.strength.push_back(whole.strength[i]);
  }
  p.b = choose(whole.b, rows, 3);
  p.E = choose(whole.E, rows, 3);
  p.mu = choose(whole.mu, rows, 1);
  return p;
}

/// Lets blocks settle with those around them, while the others rest. Most contacts that a new block opens or
/// slides are near it: the solve of the whole structure then takes fewer, larger iterations.
void settle_around(const ContactProblem& whole, const std::vector<int>& new_blocks,
                   ContactSolverOptions options, VecX* v) {
  constexpr int kReach = 5;            // of a dome of 512 blocks some 46
  constexpr int kShare = 3;            // at most a third of all blocks: a larger part does not pay
  constexpr double kTolerance = 1e-3;  // of a start
  const std::vector<char> marked = blocks_around(whole, new_blocks, kReach);
  std::vector<int> blocks;
  for (int block = 0; block < whole.num_blocks(); ++block)
    if (marked[block] != 0) blocks.push_back(block);
  if (kShare * std::ssize(blocks) > whole.num_blocks()) return;
  options.tolerance = std::max(options.tolerance, kTolerance);
  options.lag_factor = true;
  ContactSolution part{choose(*v, blocks, 6), {}};
  if (!ContactSolver().solve(problem_of(whole, blocks), options, &part).usable()) return;
  for (Eigen::Index k = 0; k < std::ssize(blocks); ++k)
    v->segment<6>(6 * Eigen::Index{blocks[k]}) = part.v.segment<6>(6 * k);
}

ProximalPoint::Pace pace_from(ComingToRest::Start from, double tolerance) {
  // Nearby the first solve is to be the last. The usual first step suits structures that settle under all
  // their weight.
  constexpr double kLonger = 30.0;
  // Of the weight of a block. Of 109 random towers that came to rest so, the first iterate of one left 0.02, of
  // the others less than 1e-4; of vaults that slide it mostly leaves 0.1 to 1.
  constexpr double kFar = 0.1;
  ProximalPoint::Pace pace{40, 1e-4, 1e-3};
  if (from == ComingToRest::Start::nearby) {
    pace.coarse = tolerance;
    pace.first_step = kLonger;
  }
  if (from == ComingToRest::Start::associated) pace.largest_residual = kFar;
  return pace;
}

}  // namespace

ComingToRest::ComingToRest(const Model& model, const State& start, const ContactSet& contacts,
                           const ContactMemories& memories, const StaticOptions& options, Start from)
    : ProximalPoint(model, start, contacts, memories, options, pace_from(from, options.tolerance)) {}

bool ComingToRest::start_near(const NearbyStart& start) {
  const ContactProblem& problem = step_.problem;
  if (first_rigid_contact(problem)) return false;
  if (start.displacement.size() > 0)
    x_.v = start.displacement / trial_.h;
  else
    x_.v = VecX::Zero(problem.v_star.size());
  for (const int block : start.new_blocks) {
    Mat6 H = problem.M[block];
    Eigen::Matrix<double, 6, 1> impulse = H * problem.v_star.segment<6>(6 * block);
    for (int i = 0; i < problem.num_contacts(); ++i) {
      if (problem.block_a[i] != block && problem.block_b[i] != block) continue;
      const Mat63 D = contact_columns(problem, i, block);
      const Mat63 DG = D * sticking_stiffness(contact_law(problem, i));
      H += DG * D.transpose();
      impulse -= DG * problem.b.segment<3>(3 * i);
    }
    x_.v.segment<6>(6 * block) = H.llt().solve(impulse);
  }
  if (!start.new_blocks.empty()) settle_around(problem, start.new_blocks, solve_options(), &x_.v);
  return true;
}

/// Momentum residual that rounding of the impulses may cause: no contact solve reaches less.
double ComingToRest::rounding_of_impulses(double reference_speed) const {
  constexpr double kMargin = 32.0;  // contacts of a block, and a few roundings of each
  const double largest = x_.gamma.size() > 0 ? x_.gamma.cwiseAbs().maxCoeff() : 0.0;
  return kMargin * std::numeric_limits<double>::epsilon() * largest /
         (root_mean_mass(step_.problem) * reference_speed);
}

void ComingToRest::iterate() {
  ContactSolverOptions solve = solve_options();
  solve.tolerance = std::max(tightening_ * solve.tolerance,
                             std::min(solve.tolerance, rounding_of_impulses(solve.reference_speed)));
  // After the first iteration few joints change their state, and the last factor is a good preconditioner. Of
  // many blocks the associated law has none.
  solve.lag_factor = x_.v.size() > 0 && !(has_many_blocks(step_.problem) && solve.law.is_associated());
  const VecX before = x_.v.size() > 0 ? x_.v : VecX::Zero(step_.problem.v_star.size());
  trial_.step_solution = x_;
  if (!options_.control) return attempt(solve, before, before);
  constexpr double kSmallest = 1e-13;  // tolerance that rounding admits
  const double share = control_share();
  solve.tolerance = std::max(kSmallest, std::min(solve.tolerance, kSolveShare * share));
  seek_time(share * trial_.h * trial_.h * acceleration_, [&] { attempt(solve, before, before); });
  const bool at_earliest = start_.time + options_.time_advance <= options_.control->earliest;
  num_beyond_ = at_earliest && reached_ > options_.control->length ? num_beyond_ + 1 : 0;
}

bool ComingToRest::shorten_step() {
  constexpr int kMaxShortened = 4;
  constexpr double kFactor = 0.1, kLongest = 0.3;
  if (++num_shortened_ > kMaxShortened) return false;
  // A step as long as one that failed would fail again.
  if (std::isfinite(largest_h_)) largest_h_ = kLongest * trial_.h;
  set_step(trial_.h * kFactor);
  return true;
}

/// After an iteration that reduced the residual by less than a digit: lengthens the step, because an elastic
/// mode of eigenvalue lambda contracts by 1 / (1 + h^2 lambda). Rigid joints do not contract; what remains at
/// rest is the error of the contact solve, summed over the courses. A solve that kept its guess would keep it
/// again.
void ComingToRest::adapt(double contraction) {
  constexpr double kSlow = 0.1, kWanted = 1e-2, kSmallest = 2.0, kLargest = 10.0, kTightening = 0.1;
  if (contraction <= kSlow) return;
  const bool rigid = std::isinf(largest_h_), kept = trial_.solve.iterations == 0;
  if (kept || (rigid && (contraction <= kNoProgress || trial_.speed_ratio <= kAtRest)))
    tightening_ *= kTightening;
  if (rigid) return;
  const double growth = contraction < 1.0 ? std::sqrt(contraction / (1.0 - contraction) / kWanted) : kLargest;
  const double h = std::min(largest_h_, std::clamp(growth, kSmallest, kLargest) * trial_.h);
  if (h > trial_.h) set_step(h);
}

/// By how much the next iterate may miss the control displacement, over g h^2: in the iteration after it, the
/// rest appears as inertia.
double ComingToRest::control_share() const {
  constexpr double kShare = 1e-2;  // of the residual, and of the displacement
  const double largest = kShare * options_.control->length / (trial_.h * trial_.h * acceleration_);
  return std::min(largest, std::max(kSolveShare * options_.tolerance, kShare * residual_) *
                               weight_over_load(model_, acceleration_));
}

/// Finds the time at which the iterate has the control displacement, to a tolerance (m).
void ComingToRest::seek_time(double tolerance, const std::function<void()>& attempt_now) {
  const LengthControl& control = *options_.control;
  std::optional<double> last_time;
  const auto missing = [&](double time) -> std::optional<double> {
    if (time - start_.time != options_.time_advance) {
      options_.time_advance = time - start_.time;
      set_step(trial_.h);
    }
    attempt_now();
    if (!trial_.solve.usable()) return std::nullopt;
    const double before = reached_;
    reached_ = control_displacement(model_, start_, control, time, trial_.h * trial_.step_solution.v) -
               control.displacement;
    if (last_time) time_slope_ = std::abs((reached_ - before) / (time - *last_time));
    last_time = time;
    return reached_;
  };
  RootSearch search{control.earliest,  control.latest, start_.time + options_.time_advance,
                    control.time_step, time_slope_,    tolerance};
  find_root(search, missing);
}

/// True if no time gave the control displacement. At the latest time it may be missing.
bool ComingToRest::misses_displacement(const StaticSolution& trial) const {
  constexpr double kMiss = 0.1;  // of the displacement of a step
  if (!options_.control || std::abs(reached_) <= kMiss * options_.control->length) return false;
  return reached_ > 0.0 || trial.time_advance != options_.control->latest - start_.time;
}

bool ComingToRest::accepts(const StaticSolution& trial) const {
  return !misses_displacement(trial) && ProximalPoint::accepts(trial);
}

StaticSolution ComingToRest::give_up(int num_solves) {
  if (!options_.control || std::abs(reached_) <= options_.control->length)
    return ProximalPoint::give_up(num_solves);
  return finish(
      StaticOutcome::unconverged,
      fmt::format("no time from {:g} to {:g} s gives the control displacement of the step, {:.3g} m",
                  options_.control->earliest, options_.control->latest, options_.control->length));
}

}  // namespace cupola

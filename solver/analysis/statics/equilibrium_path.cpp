#include "solver/analysis/statics/equilibrium_path.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/files/byte_archive.hpp"
#include "assembly/model/block_names.hpp"
#include "assembly/model/joint_rule.hpp"
#include "solver/analysis/statics/hung_blocks.hpp"
#include "solver/analysis/statics/kept_dilatancy.hpp"
#include "solver/analysis/statics/met_in_step.hpp"
#include "solver/dynamics/joint_damage.hpp"
#include "solver/dynamics/state_archive.hpp"

namespace cupola {

double displacement_of(const StaticSolution& solution) {
  return largest_speed(solution.step_solution.v) * solution.h;
}

EquilibriumPath::EquilibriumPath(const Model& model, const DetectionOptions& detection,
                                 const StaticOptions& options, PathGeometry geometry)
    : model_(model), options_(options), geometry_(geometry), detector_(*model.assembly, detection) {
  loaded_.state = state_at_rest(model_);
}

StaticSolution EquilibriumPath::advance(double value) {
  options_.control.reset();
  return advance_from(value);
}

StaticSolution EquilibriumPath::advance_by(const LengthControl& control) {
  options_.control = control;
  return advance_from(loaded_.state.time);
}

/// The scene of the next static solve: contacts at `from` and what the joints remember.
void EquilibriumPath::prepare(const LoadedState& from, double time_advance, const std::vector<double>& way) {
  start_ = from.state;
  const auto detect = [&] {
    contacts_ = detector_.num_detections() == 0 ? contacts_at_rest(model_, &detector_)
                                                : detector_.update(start_.poses, reach(from.memories, way));
    memories_ = match_memories(from.memories, contacts_.points, start_.poses);
    if (!model_.heat.empty()) contacts_ = model_.heat.heated(std::move(contacts_), start_.poses, start_.time);
  };
  detect();
  options_.time_advance = time_advance;
  if (is_unloaded()) {
    for (Contact& contact : contacts_.points) contact.gap = std::max(0.0, contact.gap);
    options_.nearby = NearbyStart{.displacement = VecX::Zero(6 * model_.num_free())};
  }
  // The time that a control finds is not known yet.
  const double loads_at = start_.time + (options_.control ? 0.0 : time_advance);
  if (let_hang(model_, contacts_, memories_, loads_at, &start_)) detect();
}

/// True if nothing presses, pulls or moves a structure that is as it was drawn. Its blocks then rest where
/// they are: the slight overlaps of a drawing bear as soon as loads act, as in statics.
bool EquilibriumPath::is_unloaded() const {
  constexpr double kSlight = 1e-4;  // of the smallest block; a larger overlap is meant, as of a driven key
  if (last_displacement_.size() > 0 || options_.control || !model_.ties.empty() || !model_.heat.empty())
    return false;
  const double time = start_.time + options_.time_advance;
  std::vector<Pose> moved = start_.poses;
  place_supports(*model_.assembly, model_.support_motions, time, &moved);
  const auto same = [](const Pose& a, const Pose& b) {
    return a.p_WB == b.p_WB && a.q_WB.coeffs() == b.q_WB.coeffs();
  };
  const auto slight = [this](const Contact& contact) {
    return contact.gap >= -kSlight * detector_.model().smallest_block;
  };
  return std::equal(moved.begin(), moved.end(), start_.poses.begin(), same) &&
         std::all_of(contacts_.points.begin(), contacts_.points.end(), slight) &&
         applied_forces(model_, start_, time).isZero(0.0);
}

bool EquilibriumPath::surely_moves_at(double value) {
  options_.control.reset();
  prepare(LoadedState(loaded_), value - loaded_.state.time);
  if (model_.joints.has_strength()) {
    begin_step(contacts_, &memories_);
    let_joints_bear_and_pull(&memories_);
  }
  return moves_with_bonded_joints(model_, start_, contacts_, memories_, options_);
}

/// m, by which the reach of the detector exceeds its margin (num_blocks; empty: zero): what sliding has
/// opened, and the way of the blocks in the step.
std::vector<double> EquilibriumPath::reach(const ContactMemories& memories,
                                           const std::vector<double>& way) const {
  std::vector<double> reach = opened_by_sliding(memories, start_.poses.size());
  if (reach.empty() || way.empty()) return reach.empty() ? way : reach;
  for (size_t b = 0; b < reach.size(); ++b) reach[b] += way[b];
  return reach;
}

/// Blocks that the last solve did not know to meet, and that overlap at its end.
std::vector<MetBlocks> EquilibriumPath::met_at(const LoadedState& end, const std::vector<double>& way) {
  if (std::ranges::max(way) <= 0.5 * detector_.narrow_phase().min_width) return {};
  detector_.update(end.state.poses, reach(end.memories));
  return met_unseen(detector_, contacts_, start_.poses, end.state.poses);
}

StaticSolution EquilibriumPath::solve_from(const LoadedState& from, double time_advance) {
  constexpr int kMostPasses = 20;  // what is pushed meets others in turn
  std::vector<double> sought;      // m, by which blocks that met others unseen have moved (num_blocks)
  for (int pass = 1;; ++pass) {
    prepare(from, time_advance, sought);
    int solves = 0;
    StaticSolution solution = solve_breaking(model_, start_, contacts_, options_, &memories_, &solves);
    solves_ += solves;
    options_.time_advance = solution.time_advance;
    if (solution.outcome != StaticOutcome::equilibrium) return solution;
    LoadedState end = loaded_state(model_, start_, contacts_, memories_, solution, options_);
    keep_dilatancy(solution, options_.solve.law, &end.memories);
    const std::vector<double> way = ways(detector_.model(), start_.poses, end.state.poses);
    const std::vector<MetBlocks> met = met_at(end, way);
    bool again = false;
    sought.resize(way.size(), 0.0);
    for (const MetBlocks& pair : met)
      for (const int b : {pair.a, pair.b}) {
        again = again || way[b] > sought[b];
        sought[b] = std::max(sought[b], way[b]);
      }
    if (again && pass < kMostPasses) continue;
    if (!met.empty()) {
      solution.outcome = StaticOutcome::unconverged;
      solution.message =
          fmt::format("block {} meets block {} from aside; take shorter steps",
                      block_label(*model_.assembly, met[0].a), block_label(*model_.assembly, met[0].b));
      return solution;
    }
    loaded_ = std::move(end);
    dissipation_.include(start_, contacts_, solution);
    return solution;
  }
}

namespace {

/// Of the smallest block, by which blocks move in a step. The geometry to which a longer one leads can be so
/// far off that nothing balances the loads there.
constexpr double kLongStep = 0.01;
/// Of a step by a length. On a falling branch the load follows the geometry: one in which hinges have moved by
/// a hundredth of a block bears several hundredths less than the largest load.
constexpr double kLongStepOfControl = 0.001;

}  // namespace

/// Blocks move on as in the last step.
NearbyStart EquilibriumPath::next_start(double step) const {
  if (last_step_ == 0.0) return {};
  return {.displacement = step / last_step_ * last_displacement_};
}

StaticSolution EquilibriumPath::advance_from(double guess) {
  const LoadedState last = loaded_;
  const double length = options_.control ? options_.control->displacement : guess - last.state.time;
  dissipation_ = {};
  solves_ = 0;
  options_.nearby.reset();
  if (last_displacement_.size() > 0) options_.nearby = next_start(length);
  StaticSolution solution = solve_from(last, guess - last.state.time);
  const auto stands = [&] { return solution.outcome == StaticOutcome::equilibrium; };
  const VecX displacement = solution.h * solution.step_solution.v;
  const std::string far = stands() ? too_far(last, solution) : "";
  // A step in which joints soften has the mean of their strength, one that repeats it the last.
  const bool softens = options_.control && model_.joints.has_strength();
  const double long_step = options_.control ? kLongStepOfControl : kLongStep;
  const bool is_long =
      !softens && displacement_of(solution) > long_step * smallest_block_size(*model_.assembly);
  if (stands() && (geometry_ == PathGeometry::end || is_long))
    solution = correct(last.memories.ties, std::move(solution));
  if (!far.empty()) {  // what holds there is not proven of the structure
    solution.message = far + "; " + (stands() ? "take shorter steps" : solution.message);
    if (stands()) solution.outcome = StaticOutcome::unconverged;
    solution.proven = false;
  }
  if (stands()) {
    // Blocks that rest as drawn say nothing of the next step.
    if (last_displacement_.size() > 0 || !displacement.isZero(0.0)) last_displacement_ = displacement;
    last_step_ = length;
  } else {
    loaded_ = last;
  }
  return solution;
}

std::string EquilibriumPath::save() const {
  LoadedState loaded = loaded_;
  DetectionMemory detection = detector_.memory();
  ByteWriter archive;
  VecX displacement = last_displacement_;
  double step = last_step_;
  archive(loaded.state, loaded.memories, loaded.h, displacement, step, detection);
  return archive.bytes();
}

void EquilibriumPath::restore(const std::string& bytes) {
  LoadedState loaded;
  DetectionMemory detection;
  ByteReader archive(bytes);
  VecX displacement;
  double step = 0.0;
  archive(loaded.state, loaded.memories, loaded.h, displacement, step, detection);
  if (!archive.at_end() || loaded.state.poses.size() != loaded_.state.poses.size() ||
      loaded.state.v.size() != loaded_.state.v.size())
    throw std::runtime_error("belongs to another scene");
  loaded_ = std::move(loaded);
  last_displacement_ = std::move(displacement);
  last_step_ = step;
  detector_.restore(std::move(detection));
}

Bracket follow(EquilibriumPath* path, const PathRange& range, double relative_width,
               const std::function<bool(const LimitTrial&, const StaticSolution&)>& report) {
  constexpr double kGrowth = 1.5;  // after a step that found an equilibrium
  const auto& [low, high, longest] = range;
  CUPOLA_ASSERT(low < high && longest > 0.0 && relative_width > 0.0);
  Bracket bracket;
  double step = longest;
  double next = low;
  while (true) {
    const StaticSolution solution = path->advance(next);
    const LimitTrial trial{next, solution.outcome, solution.speed_ratio};
    ++bracket.trials;
    if (!report(trial, solution)) return bracket;
    if (trial.outcome == StaticOutcome::equilibrium) {
      bracket.stable = trial;
      if (next >= high) {
        bracket.at_both_ends = StaticOutcome::equilibrium;
        bracket.sought = {
            .reason = fmt::format("the structure stands up to the end of the bracket, {:g}", high),
            .advice = "widen the bracket"};
        return bracket;
      }
      step = std::min(longest, kGrowth * step);
    } else if (next == low) {
      bracket.sought = {
          .reason = fmt::format("{} at the start of the bracket, {:g}", to_string(trial.outcome), low),
          .advice = "begin where it stands"};
      return bracket;
    } else {
      bracket.moving = trial;
      step = 0.5 * (next - path->value());
      if (step < 0.5 * relative_width * std::abs(next)) break;
    }
    next = std::min(high, path->value() + step);
  }
  bracket.found = bracket.narrow = bracket.moving.outcome == StaticOutcome::moving;
  bracket.sought.reason = fmt::format("stands up to {:.6g}, {} at {:.6g}", bracket.stable.value,
                                      to_string(bracket.moving.outcome), bracket.moving.value);
  return bracket;
}

}  // namespace cupola

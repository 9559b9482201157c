#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>

#include <fmt/format.h>

#include "assembly/base/process.hpp"
#include "assembly/model/joint_rule.hpp"
#include "solver/analysis/admissible/range_end.hpp"
#include "solver/analysis/admissible/range_objectives.hpp"
#include "solver/analysis/admissible/range_record.hpp"
#include "solver/analysis/analysis.hpp"
#include "solver/analysis/record/mechanism.hpp"
#include "solver/analysis/record/record.hpp"
#include "solver/analysis/statics/analysis_options.hpp"
#include "solver/analysis/statics/static_record.hpp"
#include "solver/conic/exact_equilibrium.hpp"
#include "solver/conic/motion_proof.hpp"
#include "solver/conic/solve_conic.hpp"
#include "solver/dynamics/scene_options.hpp"
#include "solver/runtime/threads.hpp"

namespace cupola {
namespace {

constexpr double kGap = 1e-6;  // largest relative distance of an end from its bound

/// The state that the compliances choose, with the contacts of a static analysis.
struct ChosenState {
  ContactSet contacts;
  StaticSolution solution;
  Frame frame;
  bool found() const { return solution.outcome == StaticOutcome::equilibrium; }
};

ChosenState chosen_state(const Case& scene, const RigidScene& rigid, const AnalysisSinks& sinks) {
  ChosenState chosen;
  chosen.contacts = ContactDetector(*rigid.assembly, detection_options(scene)).update(rigid.start.poses);
  const ContactMemories memories = memories_at_rest(rigid.model, rigid.start, chosen.contacts.points);
  StaticOptions options = static_options(scene.analysis);
  options.log = sinks.log;
  chosen.solution = solve_static(rigid.model, rigid.start, chosen.contacts, memories, options);
  if (chosen.found())
    chosen.frame =
        static_frame(rigid.model, rigid.start, chosen.contacts, memories, chosen.solution, options);
  return chosen;
}

std::vector<RangeObjective> all_objectives(const Case& scene, const Model& model,
                                           const ContactSet& contacts) {
  std::vector<RangeObjective> all;
  for (const ForceQuantity& quantity : scene.analysis.range.quantities)
    for (RangeObjective& objective : range_objectives(quantity, scene, model, contacts))
      all.push_back(std::move(objective));
  return all;
}

std::string text_of(const RangeEnd& end) {
  return end.value ? fmt::format("{:.10g}", *end.value) : to_string(end.outcome);
}

/// Both ends of every objective, first all greatest values; frames are written in their order.
class RangeSearchRun {
 public:
  RangeSearchRun(const RigidScene& scene, const std::vector<RangeObjective>& objectives, const Case& of_case,
                 const AnalysisSinks& sinks);

  /// Solves the ends, as many at once as there are threads. False if the user wants to stop.
  [[nodiscard]] bool run(std::vector<ForceRange>* ranges);
  int solves() const { return solves_; }
  int iterations() const { return iterations_; }
  int of_sector() const { return of_sector_; }  ///< ranges for which one sector was solved

 private:
  bool run(double towards, const std::vector<int>& ends, std::vector<ForceRange>* ranges);
  std::vector<int> least_to_solve(std::vector<ForceRange>* ranges) const;
  void find_vanishing(const RangeSolution& state);
  void write_frame(const std::string& end, RangeSolution* solution);

  const RigidScene& scene_;
  const std::vector<RangeObjective>& objectives_;
  const bool states_;
  const AnalysisSinks& sinks_;
  std::optional<SectorProblem> sector_;
  std::vector<SparseX> never_less_;  ///< coefficients_in_dual_cone() of the objectives
  std::vector<char> vanishes_;       ///< in a state of another end
  int frames_ = 1;                   // frame 0 is written before
  int solves_ = 0, iterations_ = 0, of_sector_ = 0;
};

RangeSearchRun::RangeSearchRun(const RigidScene& scene, const std::vector<RangeObjective>& objectives,
                               const Case& of_case, const AnalysisSinks& sinks)
    : scene_(scene),
      objectives_(objectives),
      states_(of_case.analysis.range.states),
      sinks_(sinks),
      vanishes_(objectives.size(), 0) {
  if (const int sectors = of_case.analysis.cyclic_sectors; sectors > 1) sector_.emplace(scene, sectors);
  for (const RangeObjective& objective : objectives)
    never_less_.push_back(coefficients_in_dual_cone(scene, objective));
}

/// `end`: "least thrust".
void RangeSearchRun::write_frame(const std::string& end, RangeSolution* solution) {
  if (!states_ || solution->gamma.size() == 0) return;
  solution->end.frame = frames_;
  Frame frame = admissible_frame(scene_, solution->gamma, frames_++);
  const bool unbounded = solution->end.outcome == RangeOutcome::unbounded;
  set_role(unbounded ? FrameRole::self_stress : FrameRole::range_end, end, &frame);
  sinks_.frame(frame);
}

void RangeSearchRun::find_vanishing(const RangeSolution& state) {
  constexpr double kNothing = 1e-9;  // of one block's weight; ConicOptions::tolerance
  if (!state.admissible) return;
  for (size_t i = 0; i < objectives_.size(); ++i) {
    if (vanishes_[i] || never_less_[i].nonZeros() == 0) continue;
    if (objectives_[i].mean_of_images && !state.of_sector) continue;
    vanishes_[i] = never_less_[i].dot(state.gamma) <= kNothing * scene_.model.block_weight;
  }
}

/// Those that no state found so far attains, or all where each shall have its own state.
std::vector<int> RangeSearchRun::least_to_solve(std::vector<ForceRange>* ranges) const {
  std::vector<int> ends;
  for (size_t i = 0; i < objectives_.size(); ++i) {
    const double least = objectives_[i].value.constant;
    if (vanishes_[i] && !states_)
      (*ranges)[i].min = {RangeOutcome::bounded, least, least, {}};
    else
      ends.push_back(static_cast<int>(i));
  }
  return ends;
}

bool RangeSearchRun::run(double towards, const std::vector<int>& ends, std::vector<ForceRange>* ranges) {
  constexpr double kWork = 1e12;  // of one batch: always worth all threads
  const int count = static_cast<int>(ends.size());
  constexpr int kSolvesPerThread = 8;  // of a batch, which ends when the last of them does
  const int batch = num_threads() == 1 ? 1 : num_threads() * kSolvesPerThread;
  const std::string name = towards > 0.0 ? "least" : "greatest";
  for (int first = 0; first < count; first += batch) {
    if (sinks_.interrupted()) return false;
    const int size = std::min(batch, count - first);
    std::vector<RangeSolution> found(static_cast<size_t>(size));
    share_loop(kWork, size, [&](int i) {
      found[i] = range_end(scene_, objectives_[ends[first + i]], towards, sector_ ? &*sector_ : nullptr);
    });
    for (int i = 0; i < size; ++i) {
      ForceRange& range = (*ranges)[ends[first + i]];
      of_sector_ += found[i].of_sector && towards < 0.0 ? 1 : 0;
      write_frame(fmt::format("{} {}", name, range.quantity), &found[i]);
      find_vanishing(found[i]);
      ++solves_;
      iterations_ += found[i].iterations;
      (towards > 0.0 ? range.min : range.max) = found[i].end;
      sinks_.log(fmt::format("{:<8} end {:4d} of {}  {:<36} {:>18} {}", name, first + i + 1, count,
                             range.quantity, text_of(found[i].end), range.unit));
      sinks_.progress(0.5 * (static_cast<double>(first + i + 1) / count + (towards > 0.0 ? 1.0 : 0.0)),
                      range.quantity);
    }
  }
  return true;
}

bool RangeSearchRun::run(std::vector<ForceRange>* ranges) {
  std::vector<int> all(objectives_.size());
  std::iota(all.begin(), all.end(), 0);
  for (const RangeObjective& objective : objectives_)
    ranges->push_back({objective.quantity, objective.unit, {}, {}, {}, objective.joint});
  return run(-1.0, all, ranges) && run(1.0, least_to_solve(ranges), ranges);
}

/// Fills in the values of the chosen state, whose contacts may be others.
void add_chosen(const ChosenState& chosen, const Case& scene, const Model& model,
                std::vector<ForceRange>* ranges) {
  if (!chosen.found()) return;
  const std::vector<RangeObjective> objectives = all_objectives(scene, model, chosen.contacts);
  CUPOLA_ASSERT(objectives.size() == ranges->size());
  for (size_t i = 0; i < ranges->size(); ++i) {
    const double value = objectives[i](chosen.solution.forces);
    if (std::isfinite(value)) (*ranges)[i].chosen = value;
  }
}

/// Frame 0: the chosen state, or any admissible one. False if there is none; the mechanism is then the frame.
bool write_start(const RigidScene& rigid, const ChosenState& chosen, const AnalysisSinks& sinks,
                 Summary* summary) {
  if (chosen.found()) {
    sinks.frame(chosen.frame);
    summarize_frame(chosen.frame, rigid.model, summary);
    summarize_balance(chosen.solution.balance, summary);
    summary->status = standing(chosen.solution.proven);
    return true;
  }
  const ConicSolution any = solve_conic(rigid.problem);
  Frame frame = admissible_frame(rigid, any.gamma, 0.0);
  summarize_frame(frame, rigid.model, summary);
  if (any.outcome == ConicOutcome::infeasible) {
    const Mechanism mechanism =
        find_mechanism(rigid.model, rigid.start, rigid.contacts, rigid.problem.contacts, any.v);
    const size_t nc = rigid.contacts.points.size();
    write_mechanism(rigid.model, rigid.start, rigid.contacts, rigid.memories, mechanism,
                    {std::vector<Vec3>(nc, Vec3::Zero()), {}}, std::vector<double>(nc, 0.0), "", sinks);
    summary->status =
        motion(MotionProof(rigid.problem.contacts, rigid.problem.load).next_to(any.v).has_value());
    summary->message = fmt::format("no admissible state {}: {}",
                                   proven(summary->status) ? "exists" : "was found", describe(mechanism));
    return false;
  }
  const bool found = any.outcome == ConicOutcome::optimal;
  if (found)
    summary->status = standing(proves_equilibrium(rigid.problem.contacts, rigid.problem.load, any.gamma));
  else
    set_role(FrameRole::unconverged, "", &frame);
  sinks.frame(frame);
  summarize_balance(balance_of(rigid, any.gamma), summary);
  summary->message = fmt::format("the search for an admissible state ended {}", to_string(any.outcome));
  return found;
}

}  // namespace

std::optional<Summary> run_range(const Case& scene, const Assembly& assembly, const AnalysisSinks& sinks) {
  const double started = wall_seconds();
  const RigidScene rigid =
      rigid_scene(scene, std::shared_ptr<const Assembly>(&assembly, [](const Assembly*) {}));
  const std::vector<RangeObjective> objectives = all_objectives(scene, rigid.model, rigid.contacts);

  Summary summary;
  summary.accuracy = {"ends of the ranges",
                      "largest distance from the proven bound, relative to the larger end or to one block",
                      kGap};
  summary.certified_force_error.bounds = "the forces are one of the admissible states";
  summary.forces_unique = {false, "they are one of the admissible states"};
  const ChosenState chosen = chosen_state(scene, rigid, sinks);
  if (write_start(rigid, chosen, sinks, &summary)) {
    RangeSearchRun run(rigid, objectives, scene, sinks);
    if (!run.run(&summary.ranges)) return std::nullopt;
    add_chosen(chosen, scene, rigid.model, &summary.ranges);
    summary.steps = run.solves();
    summary.iterations = run.iterations();
    double gap = 0.0;
    bool complete = true;
    for (const ForceRange& range : summary.ranges) {
      const double small = range.unit == "N"   ? rigid.model.block_weight
                           : range.unit == "m" ? smallest_block_size(assembly)
                                               : 1.0;
      gap = std::max(gap, relative_gap(range, small));
      for (const RangeEnd* end : {&range.min, &range.max})
        complete = complete && end->outcome != RangeOutcome::unconverged;
    }
    summary.accuracy.reached = summary.accuracy.worst_over_run = gap;
    if (!complete || gap > kGap) summary.status = Status::unconverged;
    summary.message = describe(summary.ranges);
    if (const int sectors = scene.analysis.cyclic_sectors; sectors > 1)
      summary.message +=
          fmt::format("; one of {} sectors was solved for {} of {} quantities, those that repeat", sectors,
                      run.of_sector(), summary.ranges.size());
    sinks.table("ranges.csv", ranges_csv(summary.ranges));
  }
  summary.message += gaps_note(rigid.contacts, assembly);
  summary.solve_time_seconds = wall_seconds() - started;
  return summary;
}

}  // namespace cupola

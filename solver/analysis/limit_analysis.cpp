#include <algorithm>
#include <cmath>
#include <memory>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/base/process.hpp"
#include "assembly/case/limit_parameter.hpp"
#include "assembly/files/csv_columns.hpp"
#include "assembly/model/joint_rule.hpp"
#include "assembly/model/loads_on_top.hpp"
#include "assembly/model/thickness.hpp"
#include "solver/analysis/admissible/direct_limit.hpp"
#include "solver/analysis/analysis.hpp"
#include "solver/analysis/record/joints_as_built.hpp"
#include "solver/analysis/record/mechanism.hpp"
#include "solver/analysis/record/record.hpp"
#include "solver/analysis/statics/analysis_options.hpp"
#include "solver/analysis/statics/equilibrium_path.hpp"
#include "solver/analysis/statics/limit_search.hpp"
#include "solver/analysis/statics/static_record.hpp"
#include "solver/dynamics/scene_options.hpp"

namespace cupola {
namespace {

constexpr double kImmense = 1e6;

/// A row of history.csv: a static solve at one value of the parameter.
struct TrialRow {
  double value;
  const StaticSolution& solution;
};

constexpr CsvColumn<TrialRow> kTrialColumns[] = {
    {"value", [](const TrialRow& r) { return fmt::format("{:.17g}", r.value); }},
    {"verdict", [](const TrialRow& r) { return to_string(r.solution.outcome); }},
    {"speed_ratio", [](const TrialRow& r) { return fmt::format("{:.9e}", r.solution.speed_ratio); }},
    {"equilibrium_residual",
     [](const TrialRow& r) { return fmt::format("{:.9e}", r.solution.balance.residual); }},
    {"iterations", [](const TrialRow& r) { return std::to_string(r.solution.iterations); }},
};

/// A static solve at one value of the parameter, with the model it was made for.
struct Probe {
  std::shared_ptr<const Assembly> assembly;
  Model model;
  State start;
  ContactSet contacts;
  ContactMemories memories;
  StaticSolution solution;
};

/// One limit analysis, with the last probe on either side of the critical value.
struct LimitRun {
  const Case& scene;
  const Assembly& assembly;
  const AnalysisSinks& sinks;
  StaticOptions options;
  std::optional<Probe> stable = {}, moving = {}, undecided_probe = {};
  std::string undecided = {};  ///< why the last trial that did not converge failed
  std::string also = {};       ///< what is known of values outside the bracket found
  int iterations = 0;
  int num_trials = 0;
  bool interrupted = false;

  std::shared_ptr<const Assembly> as_built() const {
    return {&assembly, [](const Assembly*) {}};
  }
  Probe probe_at(double value) const;
  /// A static solve of a case that the parameter changed, or of the case itself.
  Probe probe(const Case& changed, std::shared_ptr<const Assembly> blocks) const;
  /// The status of the case itself, which takes the place of the ends of a bracket that both stand, or move;
  /// `unconverged` if it does otherwise. What stands by itself is shown.
  Status judge_the_case(StaticOutcome at_both_ends);
  /// Stores and reports a probe. Returns false if the user wants to stop.
  bool keep(double value, Probe probe);
  Bracket search_value();
  Bracket follow_spread();
};

Probe LimitRun::probe_at(double value) const {
  return probe(case_at(scene, value), scene.analysis.limit.parameter == LimitSearch::Parameter::thickness
                                          ? std::make_shared<const Assembly>(with_thickness(assembly, value))
                                          : as_built());
}

Probe LimitRun::probe(const Case& changed, std::shared_ptr<const Assembly> blocks) const {
  Probe probe;
  probe.assembly = std::move(blocks);
  probe.model = make_model(changed, *probe.assembly);
  probe.start = state_at_rest(probe.model);
  ContactDetector detector(*probe.assembly, detection_options(scene));
  probe.contacts = contacts_at_rest(probe.model, &detector);
  probe.memories = match_memories({}, probe.contacts.points);
  probe.solution = solve_static(probe.model, probe.start, probe.contacts, probe.memories, options);
  // Neither forces that balance the loads to a tolerance decide a limit, nor a motion without proof that
  // forces of less than kImmense times the loads might prevent. Coulomb's law has no proof of a motion that
  // the associated law does not have.
  const bool stands = probe.solution.outcome == StaticOutcome::equilibrium;
  const bool doubtful = options.solve.law.is_associated() && probe.solution.forces_over_loads < kImmense;
  if (!probe.solution.proven && (stands || doubtful)) probe.solution.outcome = StaticOutcome::unconverged;
  return probe;
}

bool LimitRun::keep(double value, Probe probe) {
  const StaticSolution& solution = probe.solution;
  iterations += solution.iterations;
  ++num_trials;
  const LimitSearch::Parameter parameter = scene.analysis.limit.parameter;
  sinks.log(fmt::format("trial {:3d}  {} {:12.8g} {} {:<11}  |v|/(g h) {:9.2e}  iterations {:4d}", num_trials,
                        to_string(parameter), value, limit_unit(to_string(parameter)),
                        to_string(solution.outcome), solution.speed_ratio, solution.iterations));
  sinks.history(csv_row(kTrialColumns, TrialRow{value, solution}));
  if (solution.outcome == StaticOutcome::equilibrium)
    stable = std::move(probe);
  else if (solution.outcome == StaticOutcome::moving)
    moving = std::move(probe);
  else {
    undecided = fmt::format("at {:.6g}: {}", value, solution.message);
    undecided_probe = std::move(probe);
  }
  interrupted = sinks.interrupted();
  return !interrupted;
}

Status LimitRun::judge_the_case(StaticOutcome at_both_ends) {
  Probe own = probe(scene, as_built());
  iterations += own.solution.iterations;
  const StaticOutcome outcome = own.solution.outcome;
  const Status status = status_of(outcome, own.solution.proven);
  if (outcome == StaticOutcome::equilibrium) {
    moving.reset();
    stable = std::move(own);
  } else if (outcome == at_both_ends) {
    moving = std::move(own);
  }
  return outcome == at_both_ends ? status : Status::unconverged;
}

Bracket LimitRun::search_value() {
  const LimitSearch& limit = scene.analysis.limit;
  const auto search_from = [&](double low) {
    return bisect(low, limit.high,
                  {bracket_width(scene.analysis), 0.0, kZeroLimit * (limit.high - limit.low)},
                  [this](double value) -> std::optional<LimitTrial> {
                    Probe probe = probe_at(value);
                    const LimitTrial trial{value, probe.solution.outcome, probe.solution.speed_ratio};
                    if (!keep(value, std::move(probe))) return std::nullopt;
                    return trial;
                  });
  };
  const Bracket whole = search_from(limit.low);
  // A case that needs some of its loads has the largest factor on them as its limit.
  const std::optional<double> own =
      limit.parameter == LimitSearch::Parameter::load ? own_value(scene) : std::nullopt;
  if (interrupted || whole.at_both_ends != StaticOutcome::moving || !own) return whole;
  Bracket above = search_from(*own);
  if (!above.found) return whole;
  also = fmt::format("it moves again at {:g}", limit.low);
  return above;
}

/// By how much the support that moves most does between two factors of `spread`, turns included, m.
double largest_move(const Model& model, double low, double high) {
  const std::vector<Block>& blocks = model.assembly->blocks;
  std::vector<Pose> from = state_at_rest(model).poses, to = from;
  place_supports(*model.assembly, model.support_motions, low, &from);
  place_supports(*model.assembly, model.support_motions, high, &to);
  double moved = 0.0;
  for (size_t i = 0; i < blocks.size(); ++i) {
    const double turned = from[i].q_WB.angularDistance(to[i].q_WB) * std::cbrt(blocks[i].volume);
    moved = std::max(moved, (to[i].p_WB - from[i].p_WB).norm() + turned);
  }
  return moved;
}

/// The longest step of the factor of `spread`. Where joints slide, the state at a factor depends on the steps
/// before it. The size of the blocks therefore limits them, and not only the bracket, which the user may
/// widen.
double longest_step(const Model& model, double low, double high) {
  constexpr int kFewest = 40;
  // Chosen: with 0.01 the limits of an arch and of a flying buttress are within 0.4 % of those of finer paths,
  // with 0.02 within 1 %.
  constexpr double kShare = 0.01;  // of the smallest block, by which supports move in a step
  const double step = (high - low) / kFewest;
  return step *
         std::min(1.0, kShare * smallest_block_size(*model.assembly) / largest_move(model, low, low + step));
}

Bracket LimitRun::follow_spread() {
  const LimitSearch& limit = scene.analysis.limit;
  const Model model = make_model(case_at(scene, 0.0), assembly);
  EquilibriumPath path(model, detection_options(scene), options, PathGeometry::end);
  Bracket bracket = follow(
      &path, {limit.low, limit.high, longest_step(model, limit.low, limit.high)},
      bracket_width(scene.analysis), [&](const LimitTrial& trial, const StaticSolution& solution) {
        return keep(trial.value, {{}, model, path.start(), path.contacts(), path.memories(), solution});
      });
  if (bracket.at_both_ends && largest_move(model, limit.low, limit.high) == 0.0)
    bracket.sought = {.reason = "the structure stands, and no support moves",
                      .advice = "give the motion that it multiplies, supports.moves"};
  return bracket;
}

/// Summarises the last equilibrium or, without one, what moves or is undecided, and writes two frames: that
/// state and the mechanism with its largest speed scaled to 1 m/s. Returns a description of the mechanism,
/// empty if none was found.
std::string write_frames(const LimitRun& run, Summary* summary) {
  const std::optional<Probe>& shown = run.stable ? run.stable : run.moving ? run.moving : run.undecided_probe;
  if (shown) {
    StaticOptions options = run.options;
    options.time_advance = shown->solution.time_advance;  // supports move in the last step of `spread`
    Frame frame =
        static_frame(shown->model, shown->start, shown->contacts, shown->memories, shown->solution, options);
    if (run.stable) {
      const LoadedState end = loaded_state(shown->model, shown->start, shown->contacts, shown->memories,
                                           shown->solution, options);
      JointsAsBuilt(shown->model, detection_options(run.scene))
          .list_parted(end.state, shown->contacts, &frame);
    }
    summarize_static(shown->solution, frame, shown->model, run.options.tolerance, summary);
    summary->weight_N = free_weight(*shown->model.assembly, run.scene.loads.gravity.norm());
    summary->max_displacement_m.reset();  // it depends on how close the bracket is to the critical value
    set_contact_poses_if_moved(shown->model, shown->start, &frame);
    if (run.stable) {
      frame.time = 0.0;
      set_role(FrameRole::equilibrium, to_string(run.scene.analysis.limit.parameter), &frame);
    }
    if (run.stable || !run.moving) run.sinks.frame(frame);
  }
  if (!run.stable) {
    summary->certified_force_error.bounds = "no equilibrium was found";
    summary->forces_unique = {false, "no equilibrium was found"};
  }
  if (!run.moving) return "";
  const Probe& probe = *run.moving;
  const StaticSolution& solution = probe.solution;
  const Mechanism mechanism = find_mechanism(probe.model, probe.start, probe.contacts, solution.step.problem,
                                             solution.increment / solution.h);
  write_mechanism(probe.model, probe.start, probe.contacts, probe.memories, mechanism, solution.forces,
                  static_violations(probe.contacts, solution, run.options.solve.law),
                  to_string(run.scene.analysis.limit.parameter), run.sinks);
  return describe(mechanism);
}

/// Ends the bracket of a thickness where stones would turn inside out. Returns a note of it, "" without need.
std::string end_at_sound_stones(const Assembly& assembly, LimitSearch* limit) {
  if (limit->parameter != LimitSearch::Parameter::thickness) return "";
  const ThicknessLimit most = largest_thickness(assembly);
  if (limit->high <= most.factor) return "";
  const std::string why = fmt::format(
      "beyond a thickness factor of {:.5g} block {} turns inside out, where beds meet inside the shell or "
      "the intrados reaches the axis",
      most.factor, most.block);
  if (limit->low >= most.factor)
    throw InputError(fmt::format("analysis.limit.low = {:g}: {}", limit->low, why));
  limit->high = most.factor;
  return "the bracket ends early, because " + why;
}

/// The critical value, or why there is none by the status of the summary, and the message that begins with it.
void record_search(const LimitRun& run, const Bracket& bracket, Summary* summary) {
  const LimitSearch& limit = run.scene.analysis.limit;
  const std::string parameter = to_string(limit.parameter);
  Sought sought = bracket.sought;
  sought.also = run.also;
  if (bracket.found)
    summary->critical =
        CriticalValue{parameter, bracket.middle(), bracket.stable.value, bracket.moving.value};
  if (bracket.at_both_ends) {
    const bool stands = *bracket.at_both_ends == StaticOutcome::equilibrium;
    summary->stands_at_both_ends = stands;
    if (!stands && run.stable) sought.also = "the case itself stands";
  }
  summary->message =
      fmt::format("{}{}: {}", summary->critical ? critical_text(*summary->critical) : parameter,
                  varied_joints(limit), clauses(sought));
  if (!bracket.found) sought = concluded(std::move(sought), summary->status);
  sought.quantity = critical_quantity(limit);
  summary->sought = std::move(sought);
}

std::optional<Summary> search_limit(const Case& scene, const Assembly& assembly, const AnalysisSinks& sinks) {
  if (uses_direct_limit(scene.analysis)) return run_direct_limit(scene, assembly, sinks);
  LimitRun run{scene, assembly, sinks, verdict_options(scene.analysis)};
  run.options.log = sinks.log;
  const double started = wall_seconds();
  sinks.history(csv_header(kTrialColumns));
  const Bracket bracket = scene.analysis.limit.parameter == LimitSearch::Parameter::spread
                              ? run.follow_spread()
                              : run.search_value();
  if (run.interrupted) return std::nullopt;

  Summary summary;
  const Status status = bracket.narrow         ? Status::stable
                        : bracket.found        ? Status::bracketed
                        : bracket.at_both_ends ? run.judge_the_case(*bracket.at_both_ends)
                                               : Status::unconverged;
  const std::string mechanism = write_frames(run, &summary);
  summary.status = status;
  record_search(run, bracket, &summary);
  add_clause(mechanism, &summary.message);
  for (const std::optional<Probe>* probe : {&run.stable, &run.moving})
    if (*probe) {
      summary.message += gaps_note((*probe)->model, (*probe)->start, (*probe)->contacts);
      break;
    }
  if (run.moving && !run.moving->solution.proven)
    summary.message +=
        run.moving->solution.forces_over_loads > 0.0
            ? fmt::format("; forces of more than {:.2g} times the loads might prevent the motion",
                          run.moving->solution.forces_over_loads)
            : "; the motion is not proven: other forces might balance the loads";
  if (!bracket.narrow && !run.undecided.empty()) summary.message += "; " + run.undecided;
  summary.steps = run.num_trials;
  summary.iterations = run.iterations;
  summary.accuracy = {"critical value", "width of its bracket, relative to the middle",
                      bracket_width(scene.analysis)};
  if (bracket.found) {
    const double span = scene.analysis.limit.high - scene.analysis.limit.low;
    const bool zero = std::abs(bracket.middle()) <= kZeroLimit * span;
    if (zero) summary.accuracy.norm = kNormOfZero;
    const double width =
        std::abs(bracket.stable.value - bracket.moving.value) / (zero ? span : std::abs(bracket.middle()));
    summary.accuracy.reached = summary.accuracy.worst_over_run = width;
    if (!bracket.narrow) summary.message += missed_width(width, bracket_width(scene.analysis));
  }
  summary.solve_time_seconds = wall_seconds() - started;
  return summary;
}

}  // namespace

std::optional<Summary> run_limit(const Case& scene, const Assembly& assembly, const AnalysisSinks& sinks) {
  if (seeks_lantern(scene.analysis)) require_top_for_lantern(assembly, scene.loads.gravity.norm());
  Case sound = scene;
  std::string note = end_at_sound_stones(assembly, &sound.analysis.limit);
  std::optional<Summary> summary = search_limit(sound, assembly, sinks);
  if (!summary) return summary;
  if (!summary->critical) {  // the verdict is that of the case, of which the bracket may say nothing
    add_clause(case_outside_bracket(sound), &note);
    add_clause(note, &summary->sought->also);
  }
  add_clause(note, &summary->message);
  return summary;
}

}  // namespace cupola

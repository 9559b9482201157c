#include <algorithm>
#include <cmath>
#include <optional>
#include <string>
#include <vector>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/base/process.hpp"
#include "assembly/files/csv_columns.hpp"
#include "assembly/files/number_text.hpp"
#include "assembly/model/joint_rule.hpp"
#include "assembly/model/results.hpp"
#include "solver/analysis/admissible/range_end.hpp"
#include "solver/analysis/admissible/range_objectives.hpp"
#include "solver/analysis/analysis.hpp"
#include "solver/analysis/range_run.hpp"
#include "solver/analysis/record/mechanism.hpp"
#include "solver/analysis/record/record.hpp"
#include "solver/analysis/statics/analysis_options.hpp"
#include "solver/analysis/statics/static_record.hpp"
#include "solver/conic/exact_equilibrium.hpp"
#include "solver/conic/motion_proof.hpp"
#include "solver/conic/solve_conic.hpp"
#include "solver/dynamics/scene_options.hpp"

namespace cupola {
namespace {

std::string number(const std::optional<double>& value) {
  return value ? fmt::format("{:.17g}", *value) : "";
}
std::string number(const std::optional<int>& value) {
  return value ? std::to_string(*value) : "";
}

constexpr CsvColumn<ForceRange> kRangeColumns[] = {
    {"quantity", [](const ForceRange& r) { return r.quantity; }},
    {"unit", [](const ForceRange& r) { return r.unit; }},
    {"min", [](const ForceRange& r) { return number(r.min.value); }},
    {"max", [](const ForceRange& r) { return number(r.max.value); }},
    {"min_bound", [](const ForceRange& r) { return number(r.min.bound); }},
    {"max_bound", [](const ForceRange& r) { return number(r.max.bound); }},
    {"chosen", [](const ForceRange& r) { return number(r.chosen); }},
    {"min_outcome", [](const ForceRange& r) { return to_string(r.min.outcome); }},
    {"max_outcome", [](const ForceRange& r) { return to_string(r.max.outcome); }},
    {"min_frame", [](const ForceRange& r) { return number(r.min.frame); }},
    {"max_frame", [](const ForceRange& r) { return number(r.max.frame); }},
    {"block_a", [](const ForceRange& r) { return r.joint ? std::to_string(r.joint->first) : ""; }},
    {"block_b", [](const ForceRange& r) { return r.joint ? std::to_string(r.joint->second) : ""; }},
};

/// The table ranges.csv.
std::string ranges_csv(const std::vector<ForceRange>& ranges) {
  std::string csv = csv_header(kRangeColumns) + "\n";
  for (const ForceRange& range : ranges) csv += csv_row(kRangeColumns, range) + "\n";
  return csv;
}

/// The sentence that leads: the first quantity, and what was not found.
std::string describe(const std::vector<ForceRange>& ranges) {
  const ForceRange& r = ranges.front();
  const auto end = [&r](const RangeEnd& e) {
    if (e.outcome == RangeOutcome::unbounded) return std::string("without limit");
    if (!e.value) return std::string(e.outcome == RangeOutcome::undefined ? "undefined" : "unknown");
    return r.unit == "N" ? readable_force(*e.value) : fmt::format("{:.5g} {}", *e.value, r.unit);
  };
  std::string text =
      fmt::format("an admissible state exists, which says nothing about the history; {}: {} ... {}",
                  r.quantity, end(r.min), end(r.max));
  if (r.chosen)
    text += fmt::format(", chosen by the compliances {}", end({RangeOutcome::bounded, r.chosen, {}, {}}));
  const auto unknown = std::count_if(ranges.begin(), ranges.end(), [](const ForceRange& range) {
    return range.min.outcome == RangeOutcome::unconverged || range.max.outcome == RangeOutcome::unconverged;
  });
  if (unknown > 0) text += fmt::format("; {} of {} ranges are incomplete", unknown, ranges.size());
  return text;
}

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
  ContactDetector detector(*rigid.assembly, detection_options(scene));
  chosen.contacts = contacts_at_rest(rigid.model, &detector);
  const ContactMemories memories = match_memories({}, chosen.contacts.points);
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
  const Equilibrium balance = balance_of(rigid, any.gamma);
  if (any.outcome == ConicOutcome::infeasible) {
    summary->applied_load_N = balance.applied_load;
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
  summarize_balance(balance, summary);
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
  summary.forces_unique = {false, ForcesUnique::kOneOfMany};
  const ChosenState chosen = chosen_state(scene, rigid, sinks);
  if (write_start(rigid, chosen, sinks, &summary)) {
    RangeRun run(rigid, objectives, scene, sinks);
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
    if (run.images() > 0)
      summary.message += fmt::format("; {} from others by symmetry", counted(run.images(), "end"));
    sinks.table("ranges.csv", ranges_csv(summary.ranges));
  }
  summary.message += gaps_note(rigid.model, rigid.start, rigid.contacts);
  summary.solve_time_seconds = wall_seconds() - started;
  return summary;
}

}  // namespace cupola

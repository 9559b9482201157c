#include "postproc/studies/tradeoff_runs.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>

#include <fmt/format.h>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

const TradeoffRun* find_run(const std::vector<TradeoffRun>& runs, const std::string& name) {
  const auto at = std::ranges::find(runs, name, &TradeoffRun::name);
  return at == runs.end() ? nullptr : &*at;
}

/// The time step that a run sets, s; 0 if it sets none.
double time_step(const TradeoffRun& run) {
  constexpr const char* kKey = "analysis.time_step=";
  for (const std::string& setting : run.settings)
    if (setting.starts_with(kKey)) return std::strtod(setting.c_str() + std::strlen(kKey), nullptr);
  return 0.0;
}

void declare_tradeoff_run(Section& s, TradeoffRun& run) {
  s.text("name", run.name, "of the run and its folder");
  declare_settings(s, run.settings, "key.path=value, or --option=value of cupola-solve, separated by spaces");
  s.rule(is_plain_name(run.name), "name", "must be given, of letters, digits and . _ + -");
}

void check_reference(const TradeoffRun& run, const std::vector<TradeoffRun>& runs,
                     const FileLocation& where) {
  const TradeoffRun* reference = find_run(runs, run.reference);
  if (run.coarse.empty()) {
    if (reference && reference->is_reference()) return;
    std::vector<std::string> references;
    for (const TradeoffRun& other : runs)
      if (other.is_reference()) references.push_back(other.name);
    const std::string near = nearest_name(run.reference, references);
    throw InputError(
        where, fmt::format("reference = {}: no run of this name has itself as reference{}", run.reference,
                           near.empty() ? "" : fmt::format("; did you mean {}?", near)));
  }
  const TradeoffRun* coarse = find_run(runs, run.coarse);
  if (!reference || !coarse)
    throw InputError(where, fmt::format("no run has the name {}", reference ? run.coarse : run.reference));
  constexpr double kRounding = 1e-9;  // of decimal numbers read from text
  const double fine_step = time_step(*reference), coarse_step = time_step(*coarse);
  if (fine_step <= 0.0 || std::abs(coarse_step / fine_step - 2.0) > kRounding)
    throw InputError(where,
                     fmt::format("extrapolation requires that analysis.time_step of {} is twice that of {}",
                                 run.coarse, run.reference));
}

}  // namespace

std::string TradeoffRun::reference_text() const {
  return coarse.empty() ? reference : fmt::format("2 x {} - {}", reference, coarse);
}

void declare_tradeoff_knob(Section& s, TradeoffKnob& knob) {
  s.text("knob", knob.knob, "the setting that these runs vary");
  s.text("reference", knob.reference, "run whose result counts as exact");
  s.text("coarse", knob.coarse,
         "run with twice the time step of the reference, which is then extrapolated to a step of zero");
  declare_names(s, "only", knob.only, "cases for which these runs are made; without it all");
  declare_settings(s, knob.settings, "key.path=value of all these runs, separated by spaces");
  s.list("runs", knob.runs, "one entry per run", declare_tradeoff_run);
  s.rule(is_plain_name(knob.knob), "knob", "must be given, of letters, digits and . _ + -");
  s.rule(!knob.reference.empty(), "reference", "must be given");
  s.rule(!knob.runs.empty(), "runs", "must list at least one run");
}

std::vector<TradeoffRun> runs_of(const std::vector<TradeoffKnob>& knobs, const CaseNode& list,
                                 const std::string& case_name, const std::string& folder) {
  CUPOLA_ASSERT(list.items.size() == knobs.size());
  std::vector<TradeoffRun> runs;
  std::vector<FileLocation> places;
  for (size_t i = 0; i < knobs.size(); ++i) {
    const TradeoffKnob& knob = knobs[i];
    if (!knob.only.empty() && std::ranges::find(knob.only, case_name) == knob.only.end()) continue;
    for (const TradeoffRun& given : knob.runs) {
      if (find_run(runs, given.name))
        throw InputError(list.items[i].where, fmt::format("{}: another run has this name", given.name));
      TradeoffRun run = given;
      run.knob = knob.knob;
      run.reference = knob.reference;
      run.coarse = knob.coarse;
      run.settings.insert(run.settings.begin(), knob.settings.begin(), knob.settings.end());
      run.folder = folder + "/" + run.name;
      runs.push_back(std::move(run));
      places.push_back(list.items[i].find("reference")->where);
    }
  }
  for (size_t i = 0; i < runs.size(); ++i) check_reference(runs[i], runs, places[i]);
  return runs;
}

}  // namespace cupola

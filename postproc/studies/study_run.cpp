#include "postproc/studies/study_run.hpp"

#include <algorithm>

#include "assembly/case/declare.hpp"
#include "postproc/claims/quantity.hpp"

namespace cupola {
namespace {

bool consists_of(const std::string& text, const std::string& signs) {
  return !text.empty() && std::ranges::all_of(text, [&signs](unsigned char c) {
    return std::isalnum(c) || signs.find(static_cast<char>(c)) != std::string::npos;
  });
}

}  // namespace

bool is_plain_name(const std::string& name) {
  return consists_of(name, "._+-") && name.front() != '-' && name.front() != '.';
}

std::string filled(std::string text, const std::string& placeholder, const std::string& value) {
  for (size_t at = text.find(placeholder); at != std::string::npos;
       at = text.find(placeholder, at + value.size()))
    text.replace(at, placeholder.size(), value);
  return text;
}

void declare_settings(Section& s, std::vector<std::string>& settings, const std::string& meaning) {
  std::string text;
  s.text("set", text, meaning);
  settings = words(text);
  s.rule(std::ranges::all_of(settings,
                             [](const std::string& setting) {
                               return consists_of(setting, "._+-=[],:") && setting.front() != '=' &&
                                      setting.find('=') != std::string::npos;
                             }),
         "set", "must be key.path=value ..., of letters, digits and . _ + - [ ] , : only");
}

void declare_names(Section& s, const std::string& key, std::vector<std::string>& names,
                   const std::string& meaning) {
  std::string text;
  s.text(key, text, meaning);
  names = words(text);
  s.rule(std::ranges::all_of(names,
                             [](std::string name) {
                               for (const char* placeholder : {"{run}", "{case}"})
                                 name = filled(name, placeholder, "x");
                               if (name.ends_with('*')) name.pop_back();
                               // A run of a study is in the folder of the study.
                               const size_t slash = name.find('/');
                               return slash == std::string::npos ? is_plain_name(name)
                                                                 : is_plain_name(name.substr(0, slash)) &&
                                                                       is_plain_name(name.substr(slash + 1));
                             }),
         key, "names consist of letters, digits and . _ + -");
}

void declare_run_group(Section& s, RunGroup& group) {
  declare_names(s, "names", group.names, "existing runs: cases or variants, separated by spaces");
  declare_names(s, "cases", group.cases, "cases to run, separated by spaces");
  s.text("name", group.name, "name of a run; {case} stands for its case");
  declare_settings(s, group.settings, "key.path=value of all these runs, separated by spaces");
  s.list("sweep", group.sweep, "keys and the values they take, in all combinations", declare_swept_key);
  s.optional_section("ensemble", group.ensemble, "random members of every case, the same for all",
                     declare_ensemble);
  declare_names(s, "needs", group.needs,
                "keys of which the case, or an item of its lists, must give one; else the runs are left out");
  s.number("settle", group.settle, {.min = 0, .max = 0.1},
           "one run per support, which sinks by this share of the span of the model");
  s.rule(group.settle == 0.0 || (group.cases.size() == 1 && group.sweep.empty()), "settle",
         "requires one case and no `sweep`");
  s.rule(!group.ensemble || (group.sweep.empty() && group.settle == 0.0 && !group.cases.empty()), "ensemble",
         "requires `cases`, and neither `sweep` nor `settle`");
  s.rule(group.names.empty() != group.cases.empty(), "cases", "give either `cases` or `names`");
  s.rule(group.names.empty() || (group.settings.empty() && group.sweep.empty()), "names",
         "runs that exist take no `set` and no `sweep`; use `cases`");
  s.rule(is_plain_name(filled(group.name, "{case}", "x")), "name", "consists of letters, digits and . _ + -");
  s.rule(group.cases.size() < 2 || group.name.find("{case}") != std::string::npos, "name",
         "must contain {case} if there are several cases");
}

std::vector<StudyRun> sampled_runs(const Samples& samples, KeptFiles keep, const std::string& prefix,
                                   const std::string& case_name, const std::vector<std::string>& settings) {
  std::vector<StudyRun> runs;
  for (const SweepMember& member : members_of(samples, prefix)) {
    StudyRun& run = runs.emplace_back(StudyRun{member.name, case_name, settings});
    run.settings.insert(run.settings.end(), member.settings.begin(), member.settings.end());
    if (keep == KeptFiles::all) continue;
    run.settings.push_back("--tables");
    run.settings.push_back(std::string("--keep=") + to_string(keep));
  }
  return runs;
}

std::vector<SampledRuns> ensembles_of(const RunGroup& group, const std::string& study) {
  std::vector<SampledRuns> ensembles;
  if (!group.ensemble) return ensembles;
  const Samples samples = draw_samples(*group.ensemble);
  for (const std::string& case_name : group.cases) {
    const std::string name = filled(group.name, "{case}", case_name);
    ensembles.push_back(
        {name, samples, group.ensemble->design,
         sampled_runs(samples, group.ensemble->keep, study + "/" + name + "_", case_name, group.settings)});
  }
  return ensembles;
}

std::vector<StudyRun> runs_of(const RunGroup& group, const std::string& study) {
  std::vector<StudyRun> runs;
  for (const std::string& name : group.names) runs.push_back({name, "", {}});
  for (const std::string& case_name : group.cases) {
    const std::string name = study + "/" + filled(group.name, "{case}", case_name);
    if (group.sweep.empty()) {
      runs.push_back({name, case_name, group.settings});
      continue;
    }
    for (const SweepMember& member : members_of(group.sweep, name)) {
      runs.push_back({member.name, case_name, group.settings});
      runs.back().settings.insert(runs.back().settings.end(), member.settings.begin(), member.settings.end());
    }
  }
  return runs;
}

}  // namespace cupola

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>
#include <utility>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "assembly/base/error.hpp"
#include "assembly/case/case_reader.hpp"
#include "assembly/case/case_tree.hpp"
#include "assembly/files/assembly_file.hpp"
#include "postproc/studies/study.hpp"
#include "postproc/studies/support_groups.hpp"

namespace cupola {
namespace {

namespace fs = std::filesystem;

void declare_comparison(Section& s, Comparison& comparison) {
  s.text("name", comparison.name, "subfolder of the study's folder; without it the folder itself");
  declare_names(s, "runs", comparison.runs, "two or more runs");
  s.rule(comparison.name.empty() || is_plain_name(comparison.name), "name",
         "consists of letters, digits and . _ + -");
  s.rule(comparison.runs.size() > 1, "runs", "must name at least two runs");
}

std::string name_of(const CaseOfStudy& of) {
  const fs::path path(of.name);
  return path.extension() == ".yaml" ? path.stem().string() : of.name;
}

/// Writes the name of the case for {case} in every text.
void fill_in_case(CaseNode* node, const std::string& name) {
  node->text = filled(node->text, "{case}", name);
  for (CaseNode& item : node->items) fill_in_case(&item, name);
  for (CaseNode::Entry& entry : node->entries) fill_in_case(&entry.value, name);
}

/// True if the map, or an item of the list, gives the key, whose path leads through maps and lists.
bool gives(const CaseNode& node, const std::string& key) {
  if (node.kind == CaseNode::Kind::list)
    return std::ranges::any_of(node.items, [&key](const CaseNode& item) { return gives(item, key); });
  const size_t dot = key.find('.');
  const CaseNode* inner = node.find(key.substr(0, dot));
  if (!inner || inner->kind == CaseNode::Kind::empty) return false;
  return dot == std::string::npos || gives(*inner, key.substr(dot + 1));
}

/// Why the runs of a group do not apply to the case; "": they do.
std::string reason_to_leave_out(const RunGroup& group, const CaseOfStudy& of) {
  if (group.needs.empty()) return "";
  const CaseNode tree = load_case_tree(of.name, {});
  if (std::ranges::any_of(group.needs, [&tree](const std::string& key) { return gives(tree, key); }))
    return "";
  return fmt::format("the case has no {}", fmt::join(group.needs, " and no "));
}

/// The folder of the cases that a study names: its own, or the one above it if that is studies/.
fs::path folder_of_cases(const fs::path& study) {
  fs::path folder = study.parent_path();
  if (folder.filename() == "studies") folder /= "..";
  return folder.empty() ? fs::path(".") : folder;
}

/// Adds the ensembles of a group. The values are checked as if they were set in each case.
void add_ensembles_of(const RunGroup& group, const std::string& path, Study* study) {
  for (SampledRuns& ensemble : ensembles_of(group, study->name)) {
    const fs::path file = folder_of_cases(path) / (ensemble.runs.front().case_name + ".yaml");
    if (fs::exists(file)) check_samples(file.string(), group.settings, "ensemble", ensemble.samples);
    study->runs.insert(study->runs.end(), ensemble.runs.begin(), ensemble.runs.end());
    study->ensembles.push_back(std::move(ensemble));
  }
}

void add_runs(const RunGroup& group, const std::string& path, const CaseOfStudy& of, Study* study) {
  if (group.ensemble) return add_ensembles_of(group, path, study);
  std::string reason = reason_to_leave_out(group, of);
  std::vector<StudyRun> runs;
  if (reason.empty() && group.settle > 0.0) {
    if (of.assembly.empty()) return;
    runs = settlement_runs(group, study->name, read_case(of.name), read_assembly(of.assembly), &reason);
  } else if (reason.empty()) {
    runs = runs_of(group, study->name);
  }
  if (!reason.empty()) study->left_out.push_back({group.name, reason});
  for (StudyRun& run : runs) study->runs.push_back(std::move(run));
}

void declare_study(Section& root, const std::string& path, Study& study, const CaseNode& tree,
                   const CaseOfStudy& of) {
  root.text("title", study.title, "what the study shows, and how long it takes");
  std::string own_case;
  root.text("case", own_case, "case of the trade-off");
  const std::string case_name = of.name.empty() ? own_case : name_of(of);
  std::vector<RunGroup> groups;
  root.list("runs", groups, "runs of the study", declare_run_group);
  for (const RunGroup& group : groups) add_runs(group, path, of, &study);
  root.text("script", study.script, "in tests/benchmark; prints the rows of the tables without columns");
  root.rule(study.script.empty() || is_plain_name(study.script), "script", "must be the name of a file");
  root.list("tables", study.tables, "one entry per table", declare_study_table);
  root.list("comparisons", study.comparisons, "runs side by side", declare_comparison);
  std::vector<TradeoffKnob> knobs;
  root.list("tradeoff", knobs, "computing time against error, one entry per knob", declare_tradeoff_knob);
  root.rule(knobs.empty() == own_case.empty(), "case", "must be given with `tradeoff`, and only then");
  root.list("claims", study.claims, "statements with a number and a verdict", declare_claim);
  root.list("figures", study.figures, "pictures of the runs", declare_figure);
  if (root.gives("answers"))
    root.section("answers", study.answers, "which runs answer which question", declare_answers);
  root.finish();
  if (!knobs.empty())
    study.tradeoff =
        runs_of(knobs, *tree.find("tradeoff"), case_name, fmt::format("{}/{}", study.name, case_name));
  for (const TradeoffRun& run : study.tradeoff) {
    study.runs.push_back({run.folder, case_name, run.settings});
    study.runs.back().settings.push_back("--tables");
  }
}

/// Names with * at the end are replaced by the runs of the study that begin so, those of runs left out by
/// none.
void expand_names(const Study& study, std::vector<std::string>* names) {
  std::vector<std::string> expanded;
  for (const std::string& name : *names) {
    if (!name.ends_with('*')) expanded.push_back(name);
    for (const StudyRun& run : study.runs)
      if (name.ends_with('*') && run.name.starts_with(name.substr(0, name.size() - 1)))
        expanded.push_back(run.name);
  }
  *names = std::move(expanded);
}

/// Drops runs of groups that were left out.
void drop_left_out(const Study& study, std::vector<std::string>* names) {
  std::erase_if(*names, [&study](const std::string& name) {
    return std::ranges::any_of(
        study.left_out, [&](const NotComputed& group) { return name == study.name + "/" + group.what; });
  });
}

/// The members that a case draws or reads.
SampledRuns sampled_runs_of(const Case& scene, const std::string& name) {
  SampledRuns own{name, {}, {}, {}};
  if (scene.ensemble) own.design = scene.ensemble->design;
  own.samples = scene.ensemble ? draw_samples(*scene.ensemble) : read_samples(scene.sample_file.file);
  own.runs = sampled_runs(own.samples, scene.ensemble ? scene.ensemble->keep : scene.sample_file.keep,
                          name + "/", name, {});
  return own;
}

/// Cases and variants that runs may name: those of the folder of this file, or above it if that is studies/.
std::set<std::string> known_runs(const fs::path& path) {
  const fs::path folder = folder_of_cases(path);
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".yaml") names.insert(entry.path().stem().string());
  std::ifstream variants(folder / "variants.txt");
  for (std::string line; std::getline(variants, line);)
    if (!line.empty() && line.front() != '#') names.insert(line.substr(0, line.find(' ')));
  return names;
}

}  // namespace

Study read_study(const std::string& path, const CaseOfStudy& of) {
  CaseNode tree = load_case_tree(path, {});
  Study study;
  study.name = fs::path(path).stem().string();
  if (!of.name.empty() && !tree.find("case")) {
    study.name = name_of(of) + "_" + study.name;
    fill_in_case(&tree, name_of(of));
  }
  if (tree.find("sweep") || tree.find("ensemble")) {
    const Case scene = read_case(path, {});
    study.title = scene.title;
    study.sweep = scene.sweep;
    if (scene.ensemble || !scene.sample_file.file.empty()) {
      study.ensembles = {sampled_runs_of(scene, study.name)};
      study.runs = study.ensembles.front().runs;
      return study;
    }
    for (const SweepMember& member : members_of(study.sweep, study.name))
      study.runs.push_back({member.name, study.name, member.settings});
    return study;
  }
  Section root(&tree, "", tree.where, path);
  declare_study(root, path, study, tree, of);
  expand_names(study, &study.answers.causes);
  drop_left_out(study, &study.answers.margins);
  for (StudyTable& table : study.tables) expand_names(study, &table.runs);
  for (StudyTable& table : study.tables)
    if (table.runs.empty() && study.answers.verdict.empty())
      for (const StudyRun& run : study.runs) table.runs.push_back(run.name);
  for (const StudyTable& table : study.tables)
    if (table.columns.empty() && study.script.empty() && study.ensembles.size() < 2)
      throw InputError(
          FileLocation{path},
          fmt::format("tables: {} has no columns; give them, a `script`, or two ensembles, whose "
                      "differences are the rows",
                      table.name));
  if (study.runs.empty() && study.tables.empty() && study.comparisons.empty() && study.claims.empty() &&
      study.figures.empty())
    throw InputError(FileLocation{path},
                     "contains no runs; give `runs`, `tables`, `comparisons`, `tradeoff`, `claims` or "
                     "`figures`, or a case with a `sweep` or an `ensemble`");
  return study;
}

std::vector<StudyRun> members_of(const Study& study) {
  std::vector<StudyRun> members = study.runs;
  const auto add = [&members](const std::vector<std::string>& names) {
    for (const std::string& name : names)
      if (std::ranges::find(members, name, &StudyRun::name) == members.end())
        members.push_back({name, "", {}});
  };
  for (const StudyTable& table : study.tables) add(runs_of(table));
  for (const Comparison& comparison : study.comparisons) add(comparison.runs);
  add(needed_runs(study.claims, study.figures));
  return members;
}

void require_known(const std::vector<StudyRun>& members, const std::string& path,
                   const std::string& runs_folder) {
  std::set<std::string> names = known_runs(path);
  for (const StudyRun& member : members)
    if (!member.case_name.empty() && names.contains(member.name))
      throw InputError(FileLocation{path},
                       fmt::format("a case or variant is named {}, like a member of the sweep, whose results "
                                   "it would replace; rename it",
                                   member.name));
  if (!runs_folder.empty())
    for (const auto& entry : fs::directory_iterator(runs_folder))
      if (entry.is_directory()) names.insert(entry.path().filename().string());
  for (const StudyRun& member : members) {
    const std::string& name = member.case_name.empty() ? member.name : member.case_name;
    const bool has_run = !runs_folder.empty() && fs::exists(fs::path(runs_folder) / member.name);
    if (has_run || names.contains(name)) continue;
    const std::string near = nearest_name(name, names);
    throw InputError(FileLocation{path},
                     fmt::format("{}: no case and no variant has this name{}{}", name,
                                 runs_folder.empty() ? "" : ", and no run in " + runs_folder,
                                 near.empty() ? "" : fmt::format("; did you mean {}?", near)));
  }
}

std::string members_text(const std::vector<StudyRun>& members, const std::string& path) {
  require_known(members, path);
  std::string out;
  for (const StudyRun& member : members) {
    out += member.name;
    if (!member.case_name.empty()) out += " " + member.case_name;
    for (const std::string& setting : member.settings) out += " " + setting;
    out += "\n";
  }
  return out;
}

}  // namespace cupola

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <set>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/case/case_reader.hpp"
#include "assembly/case/case_tree.hpp"
#include "postproc/studies/study.hpp"

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

void declare_study(Section& root, Study& study, const CaseNode& tree, std::string case_name) {
  root.text("title", study.title, "what the study shows, and how long it takes");
  std::string own_case;
  root.text("case", own_case, "case of the trade-off");
  if (case_name.empty()) case_name = own_case;
  std::vector<RunGroup> groups;
  root.list("runs", groups, "runs of the study", declare_run_group);
  for (const RunGroup& group : groups)
    for (StudyRun& run : runs_of(group, study.name)) study.runs.push_back(std::move(run));
  root.text("script", study.script, "in tests/benchmark; prints the rows of the tables without columns");
  root.rule(study.script.empty() || is_plain_name(study.script), "script", "must be the name of a file");
  root.list("tables", study.tables, "one entry per table", declare_study_table);
  root.list("comparisons", study.comparisons, "runs side by side", declare_comparison);
  std::vector<TradeoffKnob> knobs;
  root.list("tradeoff", knobs, "computing time against error, one entry per knob", declare_tradeoff_knob);
  root.rule(knobs.empty() == own_case.empty(), "case", "must be given with `tradeoff`, and only then");
  root.list("claims", study.claims, "statements with a number and a verdict", declare_claim);
  root.list("figures", study.figures, "pictures of the runs", declare_figure);
  root.finish();
  if (!knobs.empty())
    study.tradeoff =
        runs_of(knobs, *tree.find("tradeoff"), case_name, fmt::format("{}/{}", study.name, case_name));
  for (const TradeoffRun& run : study.tradeoff) {
    study.runs.push_back({run.folder, case_name, run.settings});
    study.runs.back().settings.push_back("--tables");
  }
}

/// Cases and variants that the runs of a study may name: those of the folder above studies/, or else of its own.
std::set<std::string> known_runs(const fs::path& study_path) {
  fs::path folder = study_path.parent_path();
  if (folder.filename() == "studies") folder /= "..";
  if (folder.empty()) folder = ".";
  std::set<std::string> names;
  for (const auto& entry : fs::directory_iterator(folder))
    if (entry.path().extension() == ".yaml") names.insert(entry.path().stem().string());
  std::ifstream variants(folder / "variants.txt");
  for (std::string line; std::getline(variants, line);)
    if (!line.empty() && line.front() != '#') names.insert(line.substr(0, line.find(' ')));
  return names;
}

}  // namespace

Study read_study(const std::string& path, const std::string& case_name) {
  const CaseNode tree = load_case_tree(path, {});
  Study study;
  study.name = fs::path(path).stem().string();
  if (tree.find("sweep")) {
    const Case scene = read_case(path, {});
    study.title = scene.title;
    study.sweep = scene.sweep;
    for (const SweepMember& member : members_of(study.sweep, study.name))
      study.runs.push_back({member.name, study.name, member.settings});
    return study;
  }
  Section root(&tree, "", tree.where, path);
  declare_study(root, study, tree, case_name);
  for (StudyTable& table : study.tables)
    if (table.runs.empty())
      for (const StudyRun& run : study.runs) table.runs.push_back(run.name);
  for (const StudyTable& table : study.tables)
    if (table.columns.empty() && study.script.empty())
      throw InputError(FileLocation{path},
                       fmt::format("tables: {} has no columns; give them, or a `script`", table.name));
  if (study.runs.empty() && study.tables.empty() && study.comparisons.empty() && study.claims.empty() &&
      study.figures.empty())
    throw InputError(FileLocation{path},
                     "contains no runs; give `runs`, `tables`, `comparisons`, `tradeoff`, `claims` or "
                     "`figures`, or a case with a `sweep`");
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

std::string members_text(const std::vector<StudyRun>& members, const std::string& study_path) {
  const std::set<std::string> known = known_runs(study_path);
  std::string out;
  for (const StudyRun& member : members) {
    const std::string& name = member.case_name.empty() ? member.name : member.case_name;
    if (!known.contains(name)) {
      const std::string near = nearest_name(name, known);
      throw InputError(FileLocation{study_path},
                       fmt::format("{}: no case and no variant has this name{}", name,
                                   near.empty() ? "" : fmt::format("; did you mean {}?", near)));
    }
    out += member.name;
    if (!member.case_name.empty()) out += " " + member.case_name;
    for (const std::string& setting : member.settings) out += " " + setting;
    out += "\n";
  }
  return out;
}

}  // namespace cupola

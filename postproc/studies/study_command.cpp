#include "postproc/studies/study_command.hpp"

#include <algorithm>
#include <filesystem>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/files/atomic_file.hpp"
#include "assembly/program/command_line.hpp"
#include "postproc/claims/claims_report.hpp"
#include "postproc/compare/compare.hpp"
#include "postproc/report/html.hpp"
#include "postproc/studies/docs_page.hpp"
#include "postproc/studies/ensemble.hpp"
#include "postproc/studies/study.hpp"
#include "postproc/studies/sweep.hpp"
#include "postproc/studies/tradeoff_figures.hpp"
#include "postproc/studies/tradeoff_text.hpp"

namespace cupola {
namespace {

namespace fs = std::filesystem;

struct StudyRequest {
  std::string study_path, members_file, runs_folder, output_folder, pages_folder;
  CaseOfStudy of;
  bool quiet = false;
};

/// A measured table and its definition.
struct MeasuredTable {
  StudyTable definition;
  Table table;
};

std::vector<MeasuredTable> add_tables(const Study& study, RunCache& runs, StudyPage* page,
                                      std::string* text) {
  std::vector<MeasuredTable> tables;
  for (const StudyTable& table : study.tables) {
    if (table.columns.empty() && study.script.empty()) {
      // The page has it already; there is none before two ensembles have a result of the same sample.
      const std::string differences = page->folder() + "/differences.csv";
      if (fs::exists(differences)) tables.push_back({table, printed_table(table, differences)});
      continue;
    }
    tables.push_back({table, table.columns.empty() ? printed_table(table, page->folder() + "/script.csv")
                                                   : measured_table(table, runs)});
    if (tables.back().table.rows.empty()) continue;  // none of its runs applies to the case
    page->add("<h2>" + html_text(table.name) + "</h2>\n");
    page->add_table(tables.back().table);
    *text += aligned_text(tables.back().table) + "\n";
  }
  return tables;
}

void add_comparisons(const Study& study, const StudyRequest& request, const RunCache& runs, StudyPage* page) {
  for (const Comparison& comparison : study.comparisons) {
    std::vector<std::string> folders;
    for (const std::string& run : comparison.runs)
      if (runs.finished(run)) folders.push_back(request.runs_folder + "/" + run + "/post");
    if (folders.size() < 2) continue;
    const fs::path folder = fs::path(page->folder()) / comparison.name;
    compare(folders, folder.string(), request.quiet);
    const std::string link = (fs::path(comparison.name) / "comparison.html").string();
    page->add(fmt::format("<p><a href=\"{0}\">{0}</a>: {1}</p>\n", link,
                          html_text(fmt::format("{}", fmt::join(comparison.runs, ", ")))));
  }
}

void add_tradeoff(const Study& study, const std::string& runs_folder, StudyPage* page, std::string* text) {
  if (study.tradeoff.empty()) return;
  const fs::path folder = (fs::path(runs_folder) / study.tradeoff.front().folder).parent_path();
  const std::vector<TradeoffRow> rows = measure_tradeoff(study.tradeoff, folder.string());
  for (const std::string& paragraph : tradeoff_text(rows)) {
    page->add_paragraph(paragraph);
    *text += paragraph + "\n\n";
  }
  page->add_figures(tradeoff_figures(rows));
  page->add("<h2>Numbers</h2>\n");
  page->add_table(tradeoff_table(rows));
}

void add_claims(const Study& study, const std::string& runs_folder, StudyPage* page, std::string* text) {
  if (!study.claims.empty()) {
    const std::vector<ClaimResult> results = evaluate_claims(study.claims, runs_folder);
    page->add(claims_html(study.claims, results));
    page->write_csv(claims_table(study.claims, results));
    *text += claims_text(study.claims, results);
  }
  page->add(figures_html(study.figures, runs_folder));
}

/// Writes what the study changes in the documentation.
void write_pages(const Study& study, const std::vector<MeasuredTable>& tables, const StudyRequest& request,
                 RunCache& runs) {
  std::vector<std::string> names;
  for (const StudyRun& member : members_of(study)) names.push_back(member.name);
  const fs::path root(request.pages_folder);
  for (const MeasuredTable& measured : tables) {
    if (measured.definition.page.empty()) continue;
    require_clean_tree(root.string());
    write_to_page((root / measured.definition.page).string(), measured.definition.name,
                  to_markdown(measured.definition, measured.table) + "\n" +
                      measured_line(common_revision(names, runs)));
  }
  for (const ClaimFigure& figure : study.figures) {
    if (figure.copy.empty()) continue;
    require_clean_tree(root.string());
    common_revision({figure.run}, runs);
    const std::string picture = fmt::format("{}/{}/post/{}", request.runs_folder, figure.run, figure.picture);
    write_text_atomically((root / figure.copy).string(), read_text(picture));
  }
}

/// The first twenty names, and how many more.
std::string first_names(const std::vector<std::string>& names, const char* between) {
  const size_t shown = std::min<size_t>(names.size(), 20);
  const std::string more =
      shown < names.size() ? fmt::format("{}and {} more", between, names.size() - shown) : "";
  return fmt::format(
      "{}{}", fmt::join(names.begin(), names.begin() + static_cast<std::ptrdiff_t>(shown), between), more);
}

/// "; dome/0001: blocks 0 and 10 overlap": of the first run that gave a reason, "" if none did.
std::string first_reason(const std::vector<std::string>& missing, const std::string& runs_folder) {
  for (const std::string& name : missing)
    if (const std::string error = error_of_run(runs_folder, name); !error.empty())
      return fmt::format("; {}: {}", name, error);
  return "";
}

ExitCode measure(const Study& study, const StudyRequest& request) {
  RunCache runs(request.runs_folder);
  std::vector<std::string> missing;
  for (const StudyRun& member : members_of(study))
    if (!runs.finished(member.name)) missing.push_back(member.name);
  StudyPage page(study.title.empty() ? study.name : study.title, request.output_folder);
  std::string text;
  if (study.answers.verdict.empty() && !missing.empty())
    page.add(fmt::format("<p class=\"warning\"><strong>Not run:</strong> {}.</p>\n",
                         html_text(first_names(missing, ", ") + first_reason(missing, request.runs_folder))));
  text += add_answers(study.answers, study.left_out, request.runs_folder, runs, &page);
  if (!study.sweep.empty()) text += add_sweep(study.sweep, study.runs, request.runs_folder, &page);
  text += add_ensembles(study.ensembles, request.runs_folder, &page);
  const std::vector<MeasuredTable> tables = add_tables(study, runs, &page, &text);
  add_comparisons(study, request, runs, &page);
  add_tradeoff(study, request.runs_folder, &page, &text);
  add_claims(study, request.runs_folder, &page, &text);
  if (!study.answers.verdict.empty()) page.add_report_links(study.runs, request.runs_folder);
  page.write();
  if (!request.quiet) fmt::print("{}\nopen {}/study.html\n", text, page.folder());
  if (!missing.empty()) {
    fmt::print(stderr, "cupola-post: not run: {}\n", first_names(missing, " "));
    // A page of answers says what was not computed and why.
    return runs.finished(study.answers.verdict) ? ExitCode::done : ExitCode::failed;
  }
  if (tables.size() < study.tables.size())
    throw InputError(FileLocation{request.study_path},
                     "tables: a table without columns needs two ensembles with the same samples");
  if (!request.pages_folder.empty()) write_pages(study, tables, request, runs);
  return ExitCode::done;
}

}  // namespace

ExitCode run_study(int argc, const char* const* argv) {
  // 1. Command line
  StudyRequest request;
  CLI::App app("Lists the runs of a study, or measures the finished ones.", "cupola-post study");
  app.add_option("STUDY", request.study_path, "study file, or a case with a `sweep` or `ensemble` (.yaml)")
      ->required();
  app.add_option("--members", request.members_file, "write the list of runs to this file and exit")
      ->type_name("FILE");
  app.add_option("--runs", request.runs_folder, "folder with one subfolder per run")->type_name("FOLDER");
  app.add_option("--output", request.output_folder, "folder for study.html, tables and figures/")
      ->type_name("FOLDER");
  app.add_option("--pages", request.pages_folder, "write the tables of the pages below this folder")
      ->type_name("FOLDER");
  app.add_option("--case", request.of.name, "case of a trade-off, or of a study with {case}: its file")
      ->type_name("CASE");
  app.add_option("--assembly", request.of.assembly, "assembly of the case, for runs with settled supports")
      ->type_name("FILE");
  app.add_flag("--quiet", request.quiet, "print errors only");
  app.footer("Sample runs:\n  cupola-post study cases/studies/chains.yaml --runs out/ --output out/chains/");
  if (const auto ended = parse_arguments(app, argc, argv)) return *ended;

  // 2. Runs
  const Study study = read_study(request.study_path, request.of);
  const std::string& beside = request.of.name.ends_with(".yaml") ? request.of.name : request.study_path;
  if (!request.members_file.empty()) {
    write_text_atomically(request.members_file, members_text(members_of(study), beside));
    return ExitCode::done;
  }
  if (request.runs_folder.empty() || request.output_folder.empty())
    throw InputError("give --members, or --runs and --output; see cupola-post study --help");

  if (!fs::is_directory(request.runs_folder))
    throw InputError(FileLocation{request.runs_folder}, "--runs: no such folder");
  require_known(members_of(study), beside, request.runs_folder);

  // 3. Measure and write
  return measure(study, request);
}

}  // namespace cupola

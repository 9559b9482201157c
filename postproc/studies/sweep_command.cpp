#include <algorithm>
#include <filesystem>
#include <map>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/base/error.hpp"
#include "assembly/case/case_reader.hpp"
#include "assembly/files/atomic_file.hpp"
#include "assembly/program/command_line.hpp"
#include "postproc/report/html.hpp"
#include "postproc/studies/sweep.hpp"
#include "postproc/studies/sweep_figure.hpp"

namespace cupola {
namespace {

/// The table as text, each column as wide as its widest cell.
std::string aligned_text(const Table& table) {
  std::vector<size_t> width;
  for (const Table::Column& column : table.columns) width.push_back(column.key.size());
  for (const auto& row : table.rows)
    for (size_t k = 0; k < row.size(); ++k) width[k] = std::max(width[k], to_display(row[k]).size());
  std::string out;
  for (size_t k = 0; k < width.size(); ++k) out += fmt::format("{:<{}}  ", table.columns[k].key, width[k]);
  out += "\n";
  for (const auto& row : table.rows) {
    for (size_t k = 0; k < row.size(); ++k) out += fmt::format("{:<{}}  ", to_display(row[k]), width[k]);
    out += "\n";
  }
  return out;
}

/// The table without columns in which all cells are empty.
Table without_empty_columns(const Table& table) {
  Table out{table.name, table.title, {}, std::vector<std::vector<Table::Cell>>(table.rows.size())};
  for (size_t k = 0; k < table.columns.size(); ++k) {
    if (std::all_of(table.rows.begin(), table.rows.end(),
                    [k](const auto& row) { return to_display(row[k]).empty(); }))
      continue;
    out.columns.push_back(table.columns[k]);
    for (size_t r = 0; r < table.rows.size(); ++r) out.rows[r].push_back(table.rows[r][k]);
  }
  return out;
}

/// How the members ended: "6 stable, 2 moving".
std::string endings(const Table& table) {
  std::map<std::string, int> count;
  for (const auto& row : table.rows)
    for (size_t k = 0; k < row.size(); ++k)
      if (table.columns[k].key == "status") ++count[to_display(row[k])];
  std::string text;
  for (const auto& [status, members] : count)
    text = fmt::format("{} {}{}{}", members, status, text.empty() ? "" : ", ", text);  // stable before moving
  return text;
}

/// The page: a figure, the table, and links to the reports of the members.
std::string sweep_page(const Case& scene, const std::vector<SweepMember>& members, const Table& table,
                       const std::string& verdict, const std::string& runs_folder,
                       const std::string& output_folder) {
  std::string body =
      fmt::format("<h1>{}</h1>\n<p class=\"verdict\"><strong>{}.</strong> <small>{}.</small></p>\n",
                  markup_text(scene.title), endings(table), verdict);
  const Figure figure = sweep_figure(scene.sweep, table);
  if (!figure.commands.empty()) {
    const std::filesystem::path figures = std::filesystem::path(output_folder) / "figures";
    for (const std::string& problem : draw_figures(figures.string(), {figure}))
      body += "<p class=\"warning\">" + markup_text(problem) + "</p>\n";
    if (const std::string picture = html_picture((figures / "sweep.svg").string(), figure.title);
        !picture.empty())
      body += fmt::format("<figure>\n{}\n<figcaption><strong>{}.</strong> {}</figcaption>\n</figure>\n",
                          picture, markup_text(figure.title), markup_text(figure.caption));
  }
  body += html_table(without_empty_columns(table)) + "<p>Reports: ";
  std::string separator;
  for (const SweepMember& member : members) {
    body += separator + report_link(member.name, runs_folder + "/" + member.name + "/post", output_folder);
    separator = ", ";
  }
  return html_page(scene.title, body + ".</p>\n");
}

}  // namespace

ExitCode run_sweep(int argc, const char* const* argv) {
  // 1. Command line
  std::string case_path, members_file, runs_folder, output_folder;
  CLI::App app("Lists the runs of a case's sweep, or tabulates the finished ones.", "cupola-post sweep");
  app.add_option("CASE", case_path, "case file with a `sweep` (.yaml)")->required();
  app.add_option("--members", members_file, "write the list of runs to this file, one per line, and exit")
      ->type_name("FILE");
  app.add_option("--runs", runs_folder, "folder with one subfolder per run")->type_name("FOLDER");
  app.add_option("--output", output_folder, "folder for sweep.csv, sweep.html and figures/")
      ->type_name("FOLDER");
  if (const auto ended = parse_arguments(app, argc, argv)) return *ended;

  // 2. Members of the sweep
  const Case scene = read_case(case_path, {});
  const std::string name = std::filesystem::path(case_path).stem().string();
  const std::vector<SweepMember> members = members_of(scene.sweep, name);
  if (!members_file.empty()) {
    write_text_atomically(members_file, members_text(members, name));
    return ExitCode::done;
  }
  if (runs_folder.empty()) throw InputError("option --runs is missing; see cupola-post sweep --help");

  // 3. Table
  const Table table = sweep_table(scene.sweep, members, runs_folder);
  const int missing = num_missing(table);
  const std::string verdict = fmt::format("finished: {} of {}, {} missing", members.size() - missing,
                                          counted(members.size(), "member"), missing);
  fmt::print("{}\n{}\n", aligned_text(table), verdict);
  if (!output_folder.empty()) {
    make_folder(output_folder);
    const std::filesystem::path folder(output_folder);
    write_text_atomically((folder / "sweep.csv").string(), to_csv(table));
    write_text_atomically((folder / "sweep.html").string(),
                          sweep_page(scene, members, table, verdict, runs_folder, output_folder));
  }
  return missing > 0 ? ExitCode::failed : ExitCode::done;
}

}  // namespace cupola

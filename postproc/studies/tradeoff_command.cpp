#include "postproc/studies/tradeoff_command.hpp"

#include <filesystem>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "assembly/files/atomic_file.hpp"
#include "assembly/program/command_line.hpp"
#include "postproc/report/html.hpp"
#include "postproc/studies/study_figures.hpp"
#include "postproc/studies/study_text.hpp"

namespace cupola {
namespace {

namespace fs = std::filesystem;

std::string study_html(const std::vector<StudyRow>& rows, const std::vector<Figure>& figures,
                       const std::string& figure_folder) {
  std::string body = "<h1>Speed and accuracy</h1>\n";
  for (const std::string& paragraph : study_text(rows)) body += "<p>" + markup_text(paragraph) + "</p>\n";
  for (const Figure& figure : figures)
    body += fmt::format(
        "<h2>{}</h2>\n<figure>{}<figcaption>{}</figcaption></figure>\n", markup_text(figure.title),
        html_picture((fs::path(figure_folder) / (figure.name + ".svg")).string(), figure.title),
        markup_text(figure.caption));
  return html_page("Speed and accuracy", body + "<h2>Numbers</h2>\n" + html_table(study_table(rows)));
}

void write_study(const std::vector<StudyRow>& rows, const std::string& folder) {
  make_folder(folder);
  const std::string figure_folder = (fs::path(folder) / "figures").string();
  const std::vector<Figure> figures = study_figures(rows);
  for (const std::string& problem : draw_figures(figure_folder, figures))
    fmt::print(stderr, "cupola-post: warning: {}\n", problem);
  write_text_atomically((fs::path(folder) / "tradeoff.csv").string(), to_csv(study_table(rows)));
  write_text_atomically((fs::path(folder) / "tradeoff.html").string(),
                        study_html(rows, figures, figure_folder));
}

}  // namespace

ExitCode run_tradeoff(int argc, const char* const* argv) {
  std::vector<std::string> study_paths;
  std::string runs_folder, output_folder;
  bool quiet = false;
  CLI::App app("Compares the cost and error of runs with their references.", "cupola-post tradeoff");
  app.add_option("STUDY", study_paths,
                 "study files; a line is KNOB NAME REFERENCE key.path=value ... --threads=N")
      ->required();
  app.add_option("--runs", runs_folder, "folder with one subfolder per run")->type_name("FOLDER")->required();
  app.add_option("--output", output_folder, "folder for tradeoff.csv, tradeoff.html and figures/")
      ->type_name("FOLDER")
      ->required();
  app.add_flag("--quiet", quiet, "print errors only");
  app.footer(
      "Sample runs:\n  cupola-post tradeoff cases/tradeoff.txt --runs out/tradeoff/dome --output study/");
  if (const auto ended = parse_arguments(app, argc, argv)) return *ended;
  const std::vector<StudyRow> rows = measure_study(read_study(study_paths), runs_folder);
  write_study(rows, output_folder);
  if (!quiet)
    for (const std::string& paragraph : study_text(rows)) fmt::print("{}\n\n", paragraph);
  return ExitCode::done;
}

}  // namespace cupola

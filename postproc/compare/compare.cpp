#include "postproc/compare/compare.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <limits>
#include <set>

#include <CLI/CLI.hpp>
#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/files/atomic_file.hpp"
#include "assembly/program/command_line.hpp"
#include "postproc/compare/findings.hpp"
#include "postproc/compare/side_by_side.hpp"
#include "postproc/figures/gnuplot.hpp"
#include "postproc/figures/plot_style.hpp"
#include "postproc/report/html.hpp"
#include "postproc/tables/csv_file.hpp"
#include "postproc/tables/mesh_output.hpp"
#include "postproc/viewer/viewer.hpp"

namespace cupola {
namespace {

namespace fs = std::filesystem;

/// A quantity over the height, from a table that several runs have.
struct Overlay {
  std::string table;   // name of the CSV file
  std::string column;  // drawn over height_m
  double scale = 1.0;  // factor from the SI value of the column
  std::string label;   // with unit
  std::string title;
};

/// Names, without `ending`, of the files in the folders that begin with `start` and end with `ending`.
std::set<std::string> common_files(const std::vector<std::string>& folders, const std::string& start,
                                   const std::string& ending) {
  std::set<std::string> names;
  for (const std::string& folder : folders) {
    if (!fs::is_directory(folder)) continue;
    for (const auto& entry : fs::directory_iterator(folder)) {
      const std::string name = entry.path().filename().string();
      if (name.starts_with(start) && name.ends_with(ending) && !name.starts_with("."))
        names.insert(name.substr(0, name.size() - ending.size()));
    }
  }
  return names;
}

std::vector<std::vector<double>> curve(const CsvFile& csv, const Overlay& overlay) {
  const size_t height = csv.column("height_m"), value = csv.column(overlay.column);
  std::vector<std::vector<double>> rows;
  for (size_t i = 0; i < csv.rows.size(); ++i)
    rows.push_back({csv.number(i, height), overlay.scale * csv.number(i, value)});
  return rows;
}

/// One panel per run with its curve, over the curves of the others in grey, all on one scale. A figure
/// without commands if fewer than two runs have the table, or if the column is negligible in all of them.
Figure multiples_figure(const Overlay& overlay, const std::vector<std::string>& folders,
                        const std::vector<std::string>& labels) {
  CUPOLA_ASSERT(labels.size() == folders.size());
  constexpr size_t kMostInARow = 5;
  std::string data;
  std::vector<size_t> drawn;
  double least = 0.0, most = 0.0, lowest = 0.0, highest = -std::numeric_limits<double>::infinity();
  for (size_t i = 0; i < folders.size(); ++i) {
    const std::string path = (fs::path(folders[i]) / (overlay.table + ".csv")).string();
    if (!fs::exists(path)) continue;
    const CsvFile csv = read_csv(path);
    if (std::ranges::find(csv.columns, overlay.column) == csv.columns.end()) continue;  // nothing was sought
    const std::vector<std::vector<double>> rows = curve(csv, overlay);
    for (const auto& row : rows) {
      if (!std::isfinite(row[1])) continue;
      least = std::min(least, row[1]);
      most = std::max(most, row[1]);
      lowest = std::min(lowest, row[0]);
      highest = std::max(highest, row[0]);
    }
    data += data_block(fmt::format("run{}", i), rows);
    drawn.push_back(i);
  }
  Figure f;
  f.name = overlay.table + "_" + overlay.column;
  f.title = overlay.title;
  if (drawn.size() < 2 || most <= least) return f;
  const size_t columns = std::min(drawn.size(), kMostInARow), rows = (drawn.size() + columns - 1) / columns;
  f.caption = fmt::format(
      "{}, over the height in m: one panel per run, the others in grey, all on one scale.", overlay.label);
  f.width = static_cast<int>(60 + 210 * columns);
  f.height = static_cast<int>(40 + 320 * rows);
  const double edge = 0.03 * (highest - lowest);
  f.commands = plot_style() + data +
               fmt::format("unset key\nset xrange [{}:{}]\nset yrange [{}:{}]\nset xtics {}\n", 1.05 * least,
                           1.05 * most, lowest < 0.0 ? lowest - edge : 0.0, highest + edge,
                           round_down(0.5 * (most - least)));
  std::vector<std::string> plots;
  for (size_t k = 0; k < drawn.size(); ++k) {
    std::string plot;
    for (const size_t other : drawn)
      if (other != drawn[k]) plot += fmt::format("$run{} using 2:1 w l lc rgb '#cccccc', ", other);
    plots.push_back(fmt::format(
        "set title '{}'\nset format y '{}'\nplot {}$run{} using 2:1 w lp lc rgb '{}' pt 7 ps 0.4 lw 1.8\n",
        gnuplot_text(labels[drawn[k]]), k % columns == 0 ? "%g" : "", plot, drawn[k], kBlue));
  }
  f.commands +=
      panels(panel_grid(rows, columns, {55.0 / f.width, 0.98, 50.0 / f.height, 1.0 - 35.0 / f.height}, 0.025,
                        90.0 / f.height),
             plots);
  return f;
}

std::vector<Figure> overlay_figures(const std::vector<std::string>& folders,
                                    const std::vector<std::string>& labels) {
  std::vector<Overlay> overlays{
      {"rings", "cv_pressure", 100.0, "Variation of the bed pressure in a ring (%)",
       "Uniformity of the bed pressure"},
      {"rings", "largest_friction_use", 100.0, "Largest friction use of a bed (%)",
       "Friction utilisation of the beds"},
      {"rings", "largest_kern_use", 1.0, "Largest kern use of a bed", "Eccentricity of the bed forces"}};
  for (const auto& [column, scale, property] :
       {std::tuple{"least_stands", 1.0, "friction"}, {"least_stands_Pa", 1e-3, "cohesion (kPa)"}})
    overlays.push_back({"stages", column, scale, fmt::format("Least {} of fresh mortar", property),
                        "Construction, stage by stage"});
  for (const std::string& table : common_files(folders, "thrust_", ".csv")) {
    const std::string name = table.substr(7);
    overlays.push_back({table, "r_N", 1e-6, "Resultant (MN)", "Resultant along the meridian " + name});
    overlays.push_back(
        {table, "couple_length_m", 1.0, "Couple length (m)", "Couple length along the meridian " + name});
    overlays.push_back({table, "position", 1.0, "Place of the thrust line, 0: intrados, 1: extrados",
                        "Thrust line through the thickness, meridian " + name});
  }
  for (const std::string& table : common_files(folders, "hoop_", ".csv"))
    overlays.push_back({table, "hoop_force_N", 1e-6, "Hoop force of a ring (MN), compression positive",
                        "Hoop force across the meridian " + table.substr(5)});
  std::vector<Figure> figures;
  for (const Overlay& overlay : overlays) {
    Figure figure = multiples_figure(overlay, folders, labels);
    if (!figure.commands.empty()) figures.push_back(std::move(figure));
  }
  return figures;
}

/// The 3-D views of the reports of the runs, as many as fit into a page that browsers open quickly.
std::string views_html(const std::vector<std::string>& labels, const std::vector<std::string>& folders) {
  constexpr size_t kMostBytes = 40'000'000;
  std::vector<LabelledScene> scenes;
  std::string without;
  size_t bytes = 0;
  for (size_t i = 0; i < folders.size(); ++i) {
    const std::string report = (fs::path(folders[i]) / "report.html").string();
    std::string scene = fs::exists(report) ? scene_of_report(read_text(report)) : "";
    bytes += scene.size();
    if (scene.empty() || bytes > kMostBytes)
      without += (without.empty() ? "" : ", ") + labels[i];
    else
      scenes.push_back({labels[i], std::move(scene)});
  }
  if (scenes.empty()) return "";
  return linked_views_html(scenes) +
         (without.empty()
              ? ""
              : fmt::format("<p>Without a view, because the report has none or the page would exceed {} "
                            "MB: {}.</p>\n",
                            kMostBytes / 1'000'000, without));
}

std::string comparison_html(const std::vector<PostSummary>& runs, const std::vector<std::string>& folders,
                            const std::string& output_folder, const std::vector<Figure>& figures,
                            const std::vector<Figure>& maps, const std::string& figure_folder,
                            const std::vector<std::string>& problems) {
  const std::vector<std::string> labels = run_labels(runs.size());
  std::string body = "<h1>Comparison</h1>\n<dl>\n";
  for (size_t i = 0; i < runs.size(); ++i)
    body += fmt::format("<dt>{}</dt><dd>{} <small>({}, {})</small></dd>\n", html_text(labels[i]),
                        report_link(runs[i].title, folders[i], output_folder), html_text(runs[i].status),
                        html_text(folders[i]));
  body += "</dl>\n";
  for (const std::string& problem : problems)
    body += "<p class=\"warning\"><strong>Warning:</strong> " + html_text(problem) + "</p>\n";
  body += views_html(labels, folders);
  body += "<h2>Findings</h2>\n<ul>\n";
  for (const std::string& sentence : findings(runs)) body += "<li>" + html_text(sentence) + "</li>\n";
  body += "</ul>\n<h2>Numbers</h2>\n" + html_table(plain_table(runs));
  constexpr int kHalfPage = 500;  // px
  body += "<h2>Over the height</h2>\n<div class=\"side\">\n";
  for (const Figure& figure : figures)
    body += fmt::format("<figure{}>{}<figcaption><strong>{}.</strong> {}</figcaption></figure>\n",
                        figure.width > kHalfPage ? " class=\"wide\"" : "",
                        figure_picture(figure_folder, figure, figure.title), html_text(figure.title),
                        html_text(figure.caption));
  body += "</div>\n";
  if (!maps.empty()) body += "<h2>Over the shell</h2>\n" + maps_html(maps, figure_folder);
  return html_page("Comparison", body);
}

}  // namespace

ExitCode compare(const std::vector<std::string>& post_folders, const std::string& output_folder, bool quiet) {
  std::vector<PostSummary> runs;
  for (const std::string& folder : post_folders) runs.push_back(read_post_summary(folder));
  // Graphs and maps interpret equilibria: they leave out runs that have none.
  std::vector<std::string> folders, labels;
  for (size_t i = 0; i < runs.size(); ++i) {
    if (!runs[i].largest_friction_use) continue;
    folders.push_back(post_folders[i]);
    labels.push_back(run_labels(runs.size())[i]);
  }
  const std::vector<Figure> figures = overlay_figures(folders, labels);
  make_folder(output_folder);
  const std::string figure_folder = (fs::path(output_folder) / "figures").string();
  const std::vector<Figure> maps = common_maps(folders, labels);
  std::vector<Figure> drawn = figures;
  drawn.insert(drawn.end(), maps.begin(), maps.end());
  const std::vector<std::string> problems = draw_figures(figure_folder, drawn);
  write_text_atomically((fs::path(output_folder) / "comparison.csv").string(),
                        to_csv(comparison_table(runs)));
  write_text_atomically((fs::path(output_folder) / "comparison.tex").string(), to_latex(plain_table(runs)));
  write_text_atomically(
      (fs::path(output_folder) / "comparison.html").string(),
      comparison_html(runs, post_folders, output_folder, figures, maps, figure_folder, problems));
  for (const std::string& problem : problems) fmt::print(stderr, "cupola-post: warning: {}\n", problem);
  if (!quiet) {
    for (size_t i = 0; i < runs.size(); ++i)
      fmt::print("{}: {} ({})\n", run_labels(runs.size())[i], runs[i].title, post_folders[i]);
    for (const std::string& sentence : findings(runs)) fmt::print("{}\n", sentence);
    fmt::print("open {}\n", (fs::path(output_folder) / "comparison.html").string());
  }
  return ExitCode::done;
}

ExitCode run_compare(int argc, const char* const* argv) {
  std::vector<std::string> folders;
  std::string output;
  bool quiet = false;
  CLI::App app("Compares runs: findings, table, overlaid graphs, figures side by side.",
               "cupola-post compare");
  app.add_option("POST", folders, "two or more output folders of `cupola-post analyse`")->required();
  app.add_option("--output", output, "folder for comparison.html, comparison.csv and figures/")
      ->type_name("FOLDER")
      ->required();
  app.add_flag("--quiet", quiet, "print errors only");
  app.footer("Sample runs:\n  cupola-post compare out/A/post out/B/post --output comparison/");
  if (const auto ended = parse_arguments(app, argc, argv)) return *ended;
  if (folders.size() < 2)
    throw InputError("compare needs at least two output folders of `cupola-post analyse`, but got only one");
  return compare(folders, output, quiet);
}

}  // namespace cupola

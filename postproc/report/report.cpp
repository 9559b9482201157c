#include "postproc/report/report.hpp"

#include <algorithm>
#include <filesystem>
#include <set>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/base/process.hpp"
#include "assembly/base/with_capital.hpp"
#include "postproc/evaluation/quantity_text.hpp"
#include "postproc/report/first_screen.hpp"
#include "postproc/report/html.hpp"
#include "postproc/report/motion.hpp"
#include "postproc/report/ranges.hpp"
#include "postproc/tables/range_values.hpp"

namespace cupola {
namespace {

/// What counts as zero in this run.
std::string floor_text(const Evaluation& e) {
  const Floor& floor = e.last.joints.floor;
  return fmt::format(
      "Forces up to {}, {:.0e} of the largest joint force, are negligible: they count as zero, and no "
      "utilisation, direction or length is computed from them. Gaps up to {} count as closed.",
      force_text(floor.force), floor.share, length_text(floor.length));
}

std::string paragraph(const std::string& text) {
  return "<p>" + html_text(text) + "</p>\n";
}

std::string list_section(const std::string& heading, const std::vector<std::string>& sentences) {
  std::string out = "<h2>" + heading + "</h2>\n<ul>\n";
  for (const std::string& sentence : sentences) out += "<li>" + html_text(sentence) + "</li>\n";
  return out + "</ul>\n";
}

/// Every page needs a title: that of the case, else the name of its file.
std::string title_of(const Case& scene) {
  if (!scene.title.empty()) return scene.title;
  return scene.file.empty() ? "Case without a title" : std::filesystem::path(scene.file).stem().string();
}

/// The title, and below it the settings that it names: "Dome (with joints.friction=0.3)".
std::string heading(const std::string& title) {
  const size_t settings = title.find(" (with ");
  std::string out = "<h1>" + html_text(title.substr(0, settings)) + "</h1>\n";
  if (settings != std::string::npos)
    out += "<p class=\"settings\">" + html_text(title.substr(settings + 1)) + "</p>\n";
  return out;
}

/// Of a range analysis the findings belong to one state of many.
std::string findings_heading(const Summary& s) {
  if (s.ranges.empty()) return "Findings";
  return has_chosen(s.ranges) ? "Findings in the chosen state" : "Findings in one admissible state";
}

/// Of the free blocks, to which a file may give densities of their own; without free blocks that of the case.
std::string unit_weight_text(const Evaluation& e) {
  const double gravity = e.scene.material.unit_weight / e.scene.material.density();
  std::vector<double> weights;  // kN/m3
  for (const Block& block : e.assembly.blocks)
    if (!block.fixed) weights.push_back(1e-3 * gravity * block.mass / block.volume);
  if (weights.empty()) weights.push_back(1e-3 * e.scene.material.unit_weight);
  const auto [least, greatest] = std::ranges::minmax(weights);
  const std::string low = fmt::format("{:.4g}", least), high = fmt::format("{:.4g}", greatest);
  return (low == high ? low : low + " to " + high) + " kN/m³";
}

std::string case_section(const Evaluation& e) {
  std::string out = "<h2>The case</h2>\n<dl>\n";
  const auto row = [&out](const std::string& name, const std::string& value) {
    out += "<dt>" + html_text(name) + "</dt><dd>" + html_text(value) + "</dd>\n";
  };
  const Summary& s = e.summary;
  row("Analysis", fmt::format("{}, method {}, friction law {}, tangential spring {}", to_string(s.analysis),
                              to_string(s.method), to_string(s.friction_law), to_string(s.tangential)));
  const bool all = s.parts.empty() || !at_rest(e);
  row("Blocks", fmt::format("{}, of which {} {}; {}", s.blocks, s.free_blocks,
                            all ? "free" : "free and standing", counted(s.unknowns, "unknown")));
  row("Joints", fmt::format("{} with {}", s.joints, counted(s.contacts, "contact point")));
  row(all ? "Weight of the free blocks" : "Weight of what stands", force_text(s.weight_N));
  row("Total load, weight included", force_text(s.applied_load_N.norm()));
  row("Friction coefficient", fmt::format("{:g}", e.scene.joints.friction));
  row("Unit weight", unit_weight_text(e));
  const Compliance& c = e.scene.joints.compliance;
  const char* unit = c.per == Compliance::Per::point ? "m/N per contact point" : "m³/N per joint area";
  row("Joint compliance",
      fmt::format("normal {:g}, tangential {:g} {}", c.normal, c.tangential, unit) +
          (c.relative ? fmt::format(": {:g} of a block's size under its weight", *c.relative) : ""));
  const bool stages = is_stage(e.last.frame.role);
  if (!s.ranges.empty())
    row("State shown",
        has_chosen(s.ranges) ? "the one that the compliances choose" : "one of the admissible ones");
  else
    row(stages ? "Stage shown" : "Time shown",
        fmt::format("{}, frame {} of {}",
                    stages ? e.last.frame.owner : fmt::format("{:g} s", e.last.frame.time), e.last_frame + 1,
                    e.times.size()));
  out += "</dl>\n";
  if (!e.assembly.check_report.empty())
    out += "<details><summary>Checks of the geometry</summary><pre>" + markup_text(e.assembly.check_report) +
           "</pre></details>\n";
  return out + "<details><summary>All keys of the case</summary><pre>" + markup_text(e.scene.effective_yaml) +
         "</pre></details>\n";
}

std::string figure_html(const std::string& picture, const std::string& title, const std::string& caption,
                        bool half = false) {
  if (picture.empty()) return "";
  return fmt::format("<figure{}>\n{}\n<figcaption><strong>{}</strong> {}</figcaption>\n</figure>\n",
                     half ? " class=\"half\"" : "", picture, html_text(title), html_text(caption));
}

std::string figure_html(const ReportInput& input, const Figure& figure) {
  constexpr int kHalfWidth = 720;  // pixels; narrower figures stand two in a row
  return figure_html(html_picture(picture_file(input.figure_folder, figure), figure.title),
                     figure.title + ".", figure.caption, figure.width <= kHalfWidth);
}

bool shows_ranges(const Figure& figure) {
  return figure.name == "ranges";
}

/// The figure that belongs to the section of the ranges; "" without one.
std::string range_picture(const ReportInput& input) {
  const auto figure = std::find_if(input.figures.begin(), input.figures.end(), shows_ranges);
  return figure == input.figures.end() ? "" : figure_html(input, *figure);
}

std::string motion_picture(const ReportInput& input) {
  const std::string file = (std::filesystem::path(input.picture_folder) / "motion.png").string();
  if (input.picture_folder.empty() || !std::filesystem::exists(file)) return "";
  const bool mechanism = is_mechanism(input.evaluation->last.frame.role) || at_rest(*input.evaluation);
  return mechanism ? figure_html(html_picture(file, "Mechanism"), "Mechanism.",
                                 "How the blocks begin to move. A mechanism has directions but no amplitude: "
                                 "the displacements are drawn large enough to be seen.")
                   : figure_html(html_picture(file, "Displaced shape"), "Displaced shape.",
                                 "The blocks where the motion has carried them, to scale.");
}

std::string figures_section(const ReportInput& input) {
  std::string out = motion_picture(input);
  for (const Figure& figure : input.figures)
    if (!shows_ranges(figure)) out += figure_html(input, figure);
  return out.empty() ? "" : "<h2>Figures</h2>\n<div class=\"figures\">\n" + out + "</div>\n";
}

/// True for a table that reads like the result of an equilibrium: rings, thrust lines, cuts.
bool interprets(const Table& table) {
  static const std::set<std::string> kPlain{"joints", "blocks", "stages", "ranges", "path", "chains", "ties"};
  return !kPlain.contains(table.name);
}

std::string files_section(bool equilibrium, bool ties, bool pictures) {
  std::string out = "<h2>Files</h2>\n<dl>\n";
  const auto row = [&out](const char* file, const char* what) {
    out += fmt::format("<dt><a href=\"{0}\">{0}</a></dt><dd>{1}</dd>\n", file, what);
  };
  row("blocks.pvd", "displaced blocks and their fields in every frame, for ParaView");
  row("joints.vtp", "the wrench on every joint, one point per joint");
  row("joint_forces.vtp", "the resultants of the joints as segments to scale");
  row("wrenches.vtp", "the wrench on every block from the course below, on its central axis");
  if (equilibrium) row("thrust_lines.vtp", "thrust lines, envelopes and lines of action");
  if (equilibrium) row("sections.vtp", "sections and planes with the resultants across them");
  row("cracks.vtp", "open joints as lines");
  if (ties) row("ties.vtp", "bars of chains and other ties, with their tension");
  row("open_in_paraview.py", "opens the run in ParaView: paraview --script=open_in_paraview.py");
  row("summary.json", "the numbers used to compare runs");
  if (pictures) row("pictures", "standard views as PNG");
  return out + "</dl>\n";
}

std::string run_section(const ReportInput& input) {
  const Summary& s = input.evaluation->summary;
  std::string out = "<h2>Run</h2>\n";
  out += paragraph(fmt::format(
      "Solved by cupola-solve {} in {:.3g} s ({:.3g} s in the contact solver) on {}, peak memory "
      "{:.0f} MB. Report written by cupola-post {}. Hash of the case {}, of the assembly {}.",
      s.program_version, s.wall_time_seconds, s.solve_time_seconds, counted(s.threads, "thread"),
      1e-6 * static_cast<double>(s.peak_memory_bytes), program_version(), s.case_hash, s.assembly_hash));
  if (!input.run_yaml.empty())
    out += "<details><summary>run.yaml: the effective options</summary><pre>" + markup_text(input.run_yaml) +
           "</pre></details>\n";
  return out;
}

}  // namespace

std::string tables_html(const std::vector<Table>& tables, bool equilibrium) {
  constexpr size_t kMaxRows = 200;  // longer tables are linked as CSV only
  std::string out = "<h2>Tables</h2>\n";
  for (const Table& table : tables) {
    if (!equilibrium && interprets(table)) continue;
    const std::string link = fmt::format("<a href=\"{0}.csv\">{0}.csv</a>", markup_text(table.name));
    if (table.num_rows() > kMaxRows) {
      out += fmt::format("<p>{}: {} in {}.</p>\n", html_text(table.title), counted(table.num_rows(), "row"),
                         link);
      continue;
    }
    out += fmt::format("<details><summary>{}</summary>\n{}<p>Full precision: {}.</p></details>\n",
                       html_text(table.title), html_table(table), link);
  }
  return out;
}

std::string report_html(const ReportInput& input) {
  const Evaluation& e = *input.evaluation;
  const std::string title = title_of(e.scene);
  std::string body = heading(title);
  body += first_screen(e, input.history, input.construction ? &*input.construction : nullptr, input.viewer);
  body += ranges_section(e, range_picture(input));
  body += at_rest(e) ? list_section(findings_heading(e.summary), finding_sentences(e))
                     : list_section("Motion", motion_sentences(e, input.history));
  body += figures_section(input);
  body += input.tables;
  const Summary& s = e.summary;
  std::vector<std::string> quality = quality_sentences(e);
  if (e.last.joints.floor.force > 0.0) quality.push_back(floor_text(e));
  quality.insert(quality.begin(), with_capital(s.message) + ".");
  if (at_rest(e)) quality.insert(quality.begin(), how_sure(e));
  body += list_section("How exact", quality);
  body += case_section(e);
  body += files_section(at_rest(e), e.last.frame.ties.size() > 0, !input.picture_folder.empty());
  body += run_section(input);
  return html_page(title, body);
}

}  // namespace cupola

#include "postproc/report/report.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "assembly/base/process.hpp"
#include "postproc/figures/plot_style.hpp"
#include "postproc/report/html.hpp"
#include "postproc/tables/post_summary.hpp"

namespace cupola {
namespace {

std::string force_text(double newtons) {
  const ForceUnit unit = force_unit(std::abs(newtons));
  return fmt::format("{:.5g} {}", unit.per_newton * newtons, unit.name);
}

std::string paragraph(const std::string& text) {
  return "<p>" + markup_text(text) + "</p>\n";
}

std::string verdict_section(const Evaluation& e) {
  std::string out;
  for (const std::string& warning : notices(e))
    out += "<p class=\"warning\"><strong>Warning:</strong> " + markup_text(warning) + "</p>\n";
  const bool good = e.summary.status == Status::stable;
  return out + fmt::format("<p class=\"verdict{}\"><strong>{}</strong> {}</p>\n", good ? "" : " bad",
                           markup_text(verdict_text(e.summary)), markup_text(e.summary.message + "."));
}

std::string thrust_text(const ThrustLine& line) {
  const int placed = static_cast<int>(line.points.size()) - line.undefined;
  if (placed == 0) return fmt::format("Thrust line {}: no bed presses, so that there is none.", line.name);
  return fmt::format(
      "Thrust line {}: {} inside the thickness; nearest face {:.3g} m, geometric safety {:.3g}{}.", line.name,
      line.inside ? "stays" : "does not stay", line.least_face_distance, line.least_geometric_safety,
      line.undefined == 0 ? ""
                          : fmt::format("; {} of {} beds have none, their resultants run along them",
                                        line.undefined, line.points.size()));
}

/// What the numbers say about the structure, each sentence with its number.
std::string findings_section(const Evaluation& e) {
  const PostSummary s = post_summary(e);
  std::string out = "<h2>What the forces say</h2>\n<ul>\n";
  const auto item = [&out](const std::string& text) { out += "<li>" + markup_text(text) + "</li>\n"; };
  for (const MeridianEvaluation& m : e.meridians) item(thrust_text(m.thrust));
  for (const PlaneCut& cut : e.planes)
    item(fmt::format("Across the plane {} the joints press with {} on what lies beyond.", cut.name,
                     force_text(cut.across.force.dot(cut.normal))));
  if (!e.rings.empty()) {
    item(fmt::format("In every ring the joint forces carry the load above to {:.1e} of it.",
                     s.largest_ring_difference));
    item(fmt::format(
        "Bed pressures within a ring vary by {:.1f} % in the mean over the rings, {:.1f} % at most "
        "(coefficient of variation).",
        100.0 * s.mean_cv_pressure, 100.0 * s.largest_cv_pressure));
    if (is_vault(e))
      item(fmt::format("The base pushes outwards with {} in all, {:.4f} of the weight.",
                       force_text(e.rings.front().radial_thrust), s.thrust_over_weight));
  }
  if (s.rib_over_mid_sail)
    item(fmt::format("The rib carries {:.3f} times the resultant of the mid-sail.", *s.rib_over_mid_sail));
  item(fmt::format("The couples of the block wrenches have arms of at most {:.3g} m.",
                   s.largest_couple_length_m));
  item(fmt::format("The most used joint needs {:.1f} % of its friction{}.", 100.0 * s.largest_friction_use,
                   s.largest_friction_use > 0.999 ? ": it slides" : ""));
  item(
      fmt::format("The bed forces lie at {:.2f} of the kern's edge in the mean; above 1 a part of a joint is "
                  "unloaded.",
                  s.mean_kern_use));
  item(fmt::format("The largest displacement of a block is {:.4g} mm.", 1e3 * s.max_displacement_m));
  return out + "</ul>\n";
}

std::string model_section(const Evaluation& e) {
  std::string out = "<h2>What was modelled</h2>\n<dl>\n";
  const auto row = [&out](const std::string& name, const std::string& value) {
    out += "<dt>" + markup_text(name) + "</dt><dd>" + markup_text(value) + "</dd>\n";
  };
  const Summary& s = e.summary;
  row("Case", e.scene.title);
  row("Analysis", fmt::format("{}, method {}, friction law {}, tangential spring {}", to_string(s.analysis),
                              to_string(s.method), to_string(s.friction_law), to_string(s.tangential)));
  row("Blocks", fmt::format("{}, of which {} free; {} unknowns", s.blocks, s.free_blocks, s.unknowns));
  row("Joints", fmt::format("{} with {} contact points", s.joints, s.contacts));
  row("Weight of the free blocks", force_text(s.weight_N));
  row("Load with weight", force_text(s.applied_load_N.norm()));
  row("Friction coefficient", fmt::format("{:g}", e.scene.joints.friction));
  row("Unit weight", fmt::format("{:g} kN/m³", 1e-3 * e.scene.material.unit_weight));
  const Compliance& c = e.scene.joints.compliance;
  const char* unit = c.per == Compliance::Per::point ? "m/N per contact point" : "m³/N per area of joint";
  row("Joint compliance", fmt::format("normal {:g}, tangential {:g} {}", c.normal, c.tangential, unit));
  row("Instant", fmt::format("{:g} s, frame {} of {}", e.last.frame.time, e.times.size(), e.times.size()));
  return out + "</dl>\n<details><summary>Every key of the case</summary><pre>" +
         markup_text(e.scene.effective_yaml) + "</pre></details>\n";
}

std::string figure_html(const std::string& picture, const std::string& title, const std::string& caption) {
  if (picture.empty()) return "";
  return fmt::format("<figure>\n{}\n<figcaption><strong>{}</strong> {}</figcaption>\n</figure>\n", picture,
                     markup_text(title), markup_text(caption));
}

std::string figures_section(const ReportInput& input) {
  std::string out;
  for (const Picture& picture : input.pictures)
    out += figure_html(html_picture(picture.path, picture.caption), "", picture.caption);
  for (const Figure& figure : input.figures) {
    const auto file = [&](const char* ending) {
      return (std::filesystem::path(input.figure_folder) / (figure.name + ending)).string();
    };
    out += figure_html(html_picture(file(figure.vector ? ".svg" : ".png"), figure.title), figure.title + ".",
                       figure.caption);
  }
  return out.empty() ? "" : "<h2>Figures</h2>\n" + out;
}

std::string tables_section(const std::vector<Table>& tables) {
  constexpr size_t kMostRows = 200;  // more are for the CSV
  std::string out = "<h2>Tables</h2>\n";
  for (const Table& table : tables) {
    const std::string link = fmt::format("<a href=\"{0}.csv\">{0}.csv</a>", markup_text(table.name));
    if (table.rows.size() > kMostRows) {
      out += fmt::format("<p>{}: {} rows in {}.</p>\n", markup_text(table.title), table.rows.size(), link);
      continue;
    }
    out += fmt::format("<details><summary>{}</summary>\n{}<p>All digits: {}.</p></details>\n",
                       markup_text(table.title), html_table(table), link);
  }
  return out;
}

std::string files_section() {
  std::string out = "<h2>Files</h2>\n<dl>\n";
  const auto row = [&out](const char* file, const char* what) {
    out += fmt::format("<dt><a href=\"{0}\">{0}</a></dt><dd>{1}</dd>\n", file, what);
  };
  row("blocks.pvd", "displaced blocks of every frame with their fields, for ParaView");
  row("joints.vtp", "every joint's wrench as points and as segments to scale");
  row("wrenches.vtp", "the wrench on every block from the ring below, on its central axis");
  row("thrust_lines.vtp", "thrust lines, envelopes and lines of action");
  row("sections.vtp", "sections and planes with the resultants across them");
  row("cracks.vtp", "open joints as lines");
  row("views.py", "the standard views, for pvbatch or as a macro of ParaView");
  row("summary.json", "the numbers that compare runs");
  return out + "</dl>\n";
}

std::string run_section(const ReportInput& input) {
  const Summary& s = input.evaluation->summary;
  std::string out = "<h2>How it was run</h2>\n";
  out += paragraph(fmt::format(
      "Solved by cupola-solve {} in {:.3g} s ({:.3g} s in the contact solver) on {} thread{}, peak memory "
      "{:.0f} MB; "
      "this report by cupola-post {}. Case {}, assembly {}.",
      s.program_version, s.wall_time_seconds, s.solve_time_seconds, s.threads, s.threads == 1 ? "" : "s",
      1e-6 * static_cast<double>(s.peak_memory_bytes), program_version(), s.case_hash, s.assembly_hash));
  if (!input.run_yaml.empty())
    out += "<details><summary>run.yaml: the options in force</summary><pre>" + markup_text(input.run_yaml) +
           "</pre></details>\n";
  return out;
}

}  // namespace

std::string verdict_text(const Summary& s) {
  if (s.analysis == AnalysisType::limit && s.critical)
    return fmt::format(
        "The structure stands at a {0} of {1:.5g} and moves at {2:.5g}. Forces below are those at {1:.5g}.",
        s.critical->parameter, s.critical->stable, s.critical->moving);
  switch (s.status) {
    case Status::stable:
      return "The structure is at rest.";
    case Status::moving:
      return "The structure is moving: no equilibrium was found.";
    case Status::collapsed:
      return "The structure has collapsed.";
    case Status::unconverged:
      return "No verdict: the accuracy asked was not reached.";
  }
  return "";
}

std::string quality_text(const Summary& s) {
  std::string out = fmt::format(
      "The largest unbalanced force on a free block is {:.1e} of the mean block weight (asked {:.1e}, "
      "reached {:.1e}). "
      "The contact law holds to {:.1e} of the forces, the friction cone to {:.1e}. ",
      s.equilibrium_residual, s.accuracy_asked, s.accuracy_reached, s.contact_law_residual,
      s.friction_cone_violation);
  if (s.certified_force_error)
    out += fmt::format("The forces are certified to lie within {:.1e} of this model's exact ones. ",
                       *s.certified_force_error);
  else
    out += "The forces carry no certificate of their error. ";
  if (s.friction_law == FrictionLaw::associated)
    out += fmt::format(
        "The associated law was solved: sliding joints also open by the friction coefficient times the slip, "
        "and "
        "what stands under it may fall under Coulomb's law; {} of {} contacts slip. ",
        s.slipping_contacts, s.contacts);
  out += fmt::format("Joints yield by at most {:.3g} mm.", 1e3 * s.max_penetration_m);
  return out;
}

std::string report_html(const ReportInput& input) {
  const Evaluation& e = *input.evaluation;
  std::string body = "<h1>" + markup_text(e.scene.title) + "</h1>\n";
  body += verdict_section(e);
  body += "<h2>How good the answer is</h2>\n" + paragraph(quality_text(e.summary));
  body += findings_section(e);
  body += model_section(e);
  if (!e.assembly.check_report.empty())
    body += "<h2>Geometry check</h2>\n<pre>" + markup_text(e.assembly.check_report) + "</pre>\n";
  body += figures_section(input);
  body += tables_section(input.tables);
  body += files_section();
  body += run_section(input);
  return html_page(e.scene.title, body);
}

}  // namespace cupola

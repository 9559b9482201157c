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
  out += fmt::format("<p class=\"verdict{}\"><strong>{}</strong> {}</p>\n", good ? "" : " bad",
                     markup_text(verdict_text(e.summary)), markup_text(e.summary.message + "."));
  if (!e.summary.forces_unique.value) out += paragraph(to_sentence(e.summary.forces_unique));
  return out;
}

std::string thrust_text(const ThrustLine& line) {
  const int placed = static_cast<int>(line.points.size()) - line.undefined;
  if (placed == 0)
    return fmt::format("The meridian {} has no thrust line: none of its beds is in compression.", line.name);
  return fmt::format(
      "The thrust line of the meridian {} {} inside the thickness. Its smallest distance from a face is "
      "{:.3g} m, its smallest geometric safety {:.3g}.{}",
      line.name, line.inside ? "stays" : "does not stay", line.least_face_distance,
      line.least_geometric_safety,
      line.undefined == 0
          ? ""
          : fmt::format(" It is undefined at {} of {} beds, whose resultants are parallel to the bed.",
                        line.undefined, line.points.size()));
}

/// Findings about the structure, each sentence with its number.
std::string findings_section(const Evaluation& e) {
  const PostSummary s = post_summary(e);
  std::string out = "<h2>Findings</h2>\n<ul>\n";
  const auto item = [&out](const std::string& text) { out += "<li>" + markup_text(text) + "</li>\n"; };
  for (const MeridianEvaluation& m : e.meridians) item(thrust_text(m.thrust));
  for (const PlaneCut& cut : e.planes)
    item(
        fmt::format("The joints across the plane {} transmit a normal force of {} (compression positive) to "
                    "the part beyond.",
                    cut.name, force_text(cut.across.force.dot(cut.normal))));
  if (!e.rings.empty()) {
    item(fmt::format(
        "In every ring the joint forces balance the load above; the largest relative difference is {:.1e}.",
        s.largest_ring_difference));
    item(
        fmt::format("The coefficient of variation of the bed pressure within a ring is {:.1f} % on average "
                    "over the rings and {:.1f} % at most.",
                    100.0 * s.mean_cv_pressure, 100.0 * s.largest_cv_pressure));
    if (is_vault(e))
      item(fmt::format(
          "The outward thrust at the base, summed over the blocks, is {}, {:.4f} times the weight.",
          force_text(e.rings.front().radial_thrust), s.thrust_over_weight));
  }
  if (s.rib_over_mid_sail)
    item(fmt::format(
        "The resultant in the rib is on average {:.3f} times that at mid-sail, and between {:.2f} and "
        "{:.2f} times on a single bed (compliance per {}).",
        *s.rib_over_mid_sail, *s.rib_over_mid_sail_smallest, *s.rib_over_mid_sail_largest, s.compliance_per));
  item(fmt::format("The largest couple length of a block wrench is {:.3g} m.", s.largest_couple_length_m));
  item(fmt::format("The largest friction utilisation of a joint is {:.1f} %{}.",
                   100.0 * s.largest_friction_use,
                   s.largest_friction_use > 0.999 ? ": this joint slides" : ""));
  item(
      fmt::format("The mean eccentricity of the bed forces is {:.2f} of the distance to the edge of the "
                  "kern. Where it exceeds 1, part of the joint is unloaded.",
                  s.mean_kern_use));
  if (s.max_displacement_m)
    item(fmt::format("The largest displacement of a block is {:.4g} mm.", 1e3 * *s.max_displacement_m));
  return out + "</ul>\n";
}

std::string model_section(const Evaluation& e) {
  std::string out = "<h2>Model</h2>\n<dl>\n";
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
  row("Total load, weight included", force_text(s.applied_load_N.norm()));
  row("Friction coefficient", fmt::format("{:g}", e.scene.joints.friction));
  row("Unit weight", fmt::format("{:g} kN/m³", 1e-3 * e.scene.material.unit_weight));
  const Compliance& c = e.scene.joints.compliance;
  const char* unit = c.per == Compliance::Per::point ? "m/N per contact point" : "m³/N per joint area";
  row("Joint compliance", fmt::format("normal {:g}, tangential {:g} {}", c.normal, c.tangential, unit));
  row("Time shown", fmt::format("{:g} s, frame {} of {}", e.last.frame.time, e.times.size(), e.times.size()));
  return out + "</dl>\n<details><summary>All keys of the case</summary><pre>" +
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
  constexpr size_t kMaxRows = 200;  // longer tables are linked as CSV only
  std::string out = "<h2>Tables</h2>\n";
  for (const Table& table : tables) {
    const std::string link = fmt::format("<a href=\"{0}.csv\">{0}.csv</a>", markup_text(table.name));
    if (table.rows.size() > kMaxRows) {
      out += fmt::format("<p>{}: {} rows in {}.</p>\n", markup_text(table.title), table.rows.size(), link);
      continue;
    }
    out += fmt::format("<details><summary>{}</summary>\n{}<p>Full precision: {}.</p></details>\n",
                       markup_text(table.title), html_table(table), link);
  }
  return out;
}

std::string files_section() {
  std::string out = "<h2>Files</h2>\n<dl>\n";
  const auto row = [&out](const char* file, const char* what) {
    out += fmt::format("<dt><a href=\"{0}\">{0}</a></dt><dd>{1}</dd>\n", file, what);
  };
  row("blocks.pvd", "displaced blocks and their fields in every frame, for ParaView");
  row("joints.vtp", "the wrench on every joint, as points and as segments to scale");
  row("wrenches.vtp", "the wrench on every block from the course below, on its central axis");
  row("thrust_lines.vtp", "thrust lines, envelopes and lines of action");
  row("sections.vtp", "sections and planes with the resultants across them");
  row("cracks.vtp", "open joints as lines");
  row("views.py", "the standard views, for pvbatch or as a ParaView macro");
  row("summary.json", "the numbers used to compare runs");
  return out + "</dl>\n";
}

std::string run_section(const ReportInput& input) {
  const Summary& s = input.evaluation->summary;
  std::string out = "<h2>Run</h2>\n";
  out += paragraph(fmt::format(
      "Solved by cupola-solve {} in {:.3g} s ({:.3g} s in the contact solver) on {} thread{}, peak memory "
      "{:.0f} MB. Report written by cupola-post {}. Hash of the case {}, of the assembly {}.",
      s.program_version, s.wall_time_seconds, s.solve_time_seconds, s.threads, s.threads == 1 ? "" : "s",
      1e-6 * static_cast<double>(s.peak_memory_bytes), program_version(), s.case_hash, s.assembly_hash));
  if (!input.run_yaml.empty())
    out += "<details><summary>run.yaml: the effective options</summary><pre>" + markup_text(input.run_yaml) +
           "</pre></details>\n";
  return out;
}

}  // namespace

std::string verdict_text(const Summary& s) {
  if (s.analysis == AnalysisType::limit && s.critical)
    return fmt::format(
        "The structure stands at a {0} of {1:.5g} and moves at {2:.5g}. The forces below are those at "
        "{1:.5g}.",
        s.critical->parameter, s.critical->stable, s.critical->moving);
  switch (s.status) {
    case Status::stable:
      return "The structure is at rest.";
    case Status::moving:
      return "The structure is moving: no equilibrium was found.";
    case Status::collapsed:
      return "The structure has collapsed.";
    case Status::unconverged:
      return "No verdict: the requested accuracy was not reached.";
  }
  return "";
}

std::string quality_text(const Summary& s) {
  std::string out = to_sentence(s.accuracy) + " ";
  if (s.analysis == AnalysisType::limit && s.critical)
    out += fmt::format("The residuals below are those of the equilibrium at {:.5g}. ", s.critical->stable);
  if (s.equilibrium_residual)
    out += fmt::format("The largest unbalanced force on a free block is {:.1e} of the mean block weight. ",
                       *s.equilibrium_residual);
  if (s.contact_law_residual)
    out += fmt::format("The contact law holds to within {:.1e} of the forces{}. ", *s.contact_law_residual,
                       s.steps > 1 && s.analysis != AnalysisType::limit ? " in every step" : "");
  if (const auto& worst = s.largest_law_violation)
    out += fmt::format(
        "At the worst contact, between the blocks {} and {}, the law holds to within {:.1e} of the force of "
        "its joint. ",
        worst->block_a, worst->block_b, worst->value);
  if (s.friction_cone_violation)
    out += fmt::format("The friction cone holds to within {:.1e}. ", *s.friction_cone_violation);
  out += to_sentence(s.certified_force_error) + " ";
  if (s.friction_law == FrictionLaw::associated)
    out += fmt::format(
        "The associated friction law was used: sliding joints also open, by the friction coefficient times "
        "the slip. A structure that stands under this law may collapse under Coulomb's law. {} of {} "
        "contacts slip. ",
        s.slipping_contacts, s.contacts);
  out += fmt::format("The largest penetration at a contact is {:.3g} mm.", 1e3 * s.max_penetration_m);
  return out;
}

std::string report_html(const ReportInput& input) {
  const Evaluation& e = *input.evaluation;
  std::string body = "<h1>" + markup_text(e.scene.title) + "</h1>\n";
  body += verdict_section(e);
  body += "<h2>Solution quality</h2>\n" + paragraph(quality_text(e.summary));
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

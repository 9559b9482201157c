#include "postproc/analyse.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/files/assembly_file.hpp"
#include "assembly/files/atomic_file.hpp"
#include "assembly/files/content_hash.hpp"
#include "assembly/model/block_names.hpp"
#include "postproc/evaluation/evaluation.hpp"
#include "postproc/figures/figures.hpp"
#include "postproc/pictures/paraview_views.hpp"
#include "postproc/report/report.hpp"
#include "postproc/report/stages.hpp"
#include "postproc/tables/mesh_output.hpp"
#include "postproc/tables/mesh_parts.hpp"
#include "postproc/tables/post_summary.hpp"
#include "postproc/tables/result_tables.hpp"

namespace cupola {
namespace {

std::string in_folder(const std::string& folder, const std::string& name) {
  return (std::filesystem::path(folder) / name).string();
}

HistoryRow history_row(const Evaluation& e, const Frame& frame) {
  HistoryRow row{.time = frame.time};
  for (const Vec3& d : frame.blocks.displacement)
    row.max_displacement = std::max(row.max_displacement, d.norm());
  for (const Vec3& v : frame.blocks.velocity) row.max_speed = std::max(row.max_speed, v.norm());
  const ContactTable& c = frame.contacts;
  for (int i = 0; i < c.size(); ++i) {
    const bool a = e.assembly.blocks[c.block_a[i]].fixed, b = e.assembly.blocks[c.block_b[i]].fixed;
    if (a != b) row.reaction += (a ? 1.0 : -1.0) * c.force[i].dot(e.up);
  }
  return row;
}

/// Writes the displaced blocks of every readable frame and returns one history row per frame. Unreadable
/// frames are left out.
std::vector<HistoryRow> write_frames(const ResultsReader& results, const std::string& folder,
                                     Evaluation* evaluation) {
  const Evaluation& e = *evaluation;
  const DisplacedBlocks blocks(e);
  std::vector<PvdEntry> entries;
  std::vector<HistoryRow> history;
  for (size_t i = 0; i < e.times.size(); ++i) {
    FrameEvaluation frame;
    if (e.times[i] == e.last.frame.time) {
      frame = e.last;
    } else {
      try {
        frame = evaluate_frame(e, results.read_frame(static_cast<int>(i)));
      } catch (const InputError& error) {
        leave_out(fmt::format("frame {}", i), error.what(), evaluation);
        continue;
      }
    }
    const std::string name = fmt::format("blocks_{:04}.vtu", i);
    Mesh mesh = blocks.at(frame);
    for (MeshArray& array : about(e, 0.0)) mesh.field_data.push_back(std::move(array));
    write_mesh(in_folder(folder, name), mesh);
    entries.push_back({e.times[i], name});
    history.push_back(history_row(e, frame.frame));
  }
  write_pvd(in_folder(folder, "blocks.pvd"), entries);
  return history;
}

void write_meshes(const Evaluation& e, const std::string& folder) {
  write_mesh(in_folder(folder, "joints.vtp"), joints_mesh(e));
  write_mesh(in_folder(folder, "wrenches.vtp"), wrenches_mesh(e));
  write_mesh(in_folder(folder, "thrust_lines.vtp"), thrust_lines_mesh(e));
  write_mesh(in_folder(folder, "sections.vtp"), sections_mesh(e));
  write_mesh(in_folder(folder, "cracks.vtp"), cracks_mesh(e));
}

/// Throws InputError if the assembly or the results belong to another case, unless --force is given.
void check_provenance(const AnalyseRequest& request, const Assembly& assembly, const Summary& summary) {
  if (request.force) return;
  if (assembly.geometry_hash != request.scene.geometry_hash)
    throw InputError(FileLocation{request.assembly_path},
                     fmt::format("was generated from another case: geometry or material differ from {}. "
                                 "Generate it again, or pass --force to accept it",
                                 request.scene.file));
  if (summary.case_hash != request.scene.hash)
    throw InputError(FileLocation{request.results_folder},
                     fmt::format("was solved from another case: loads, joints or analysis differ from {}. "
                                 "Solve it again, or pass --force to accept it",
                                 request.scene.file));
}

struct Drawn {
  std::vector<Figure> figures;
  std::vector<Picture> pictures;
};

/// Writes meshes for ParaView, figures and pictures. Figures that cannot be drawn become warnings.
Drawn draw(const AnalyseRequest& request, const ResultsReader& results, const std::optional<Table>& stages,
           Evaluation* e) {
  const std::string& folder = request.output_folder;
  const std::vector<HistoryRow> history = write_frames(results, folder, e);
  write_meshes(*e, folder);
  Drawn drawn{result_figures(*e, history), {}};
  if (const auto figure = stages ? stage_figure(*stages) : std::nullopt)
    drawn.figures.insert(drawn.figures.begin(), *figure);
  for (std::string& problem : draw_figures(in_folder(folder, "figures"), drawn.figures))
    e->warnings.push_back(std::move(problem));
  write_views(folder);
  if (!request.pvbatch.empty()) drawn.pictures = draw_pictures(folder, request.pvbatch, &e->warnings);
  return drawn;
}

void write_report(const AnalyseRequest& request, const std::vector<Table>& tables, const Drawn& drawn,
                  const std::string& run_yaml, const Evaluation& e) {
  const std::string& folder = request.output_folder;
  write_text_atomically(in_folder(folder, "report.html"),
                        report_html({.evaluation = &e,
                                     .tables = tables,
                                     .figures = drawn.figures,
                                     .pictures = drawn.pictures,
                                     .figure_folder = in_folder(folder, "figures"),
                                     .run_yaml = run_yaml}));
}

/// Text of a result file; "" if it cannot be read, which is recorded in the evaluation.
std::string readable_text(const ResultsReader& results, const std::string& name, Evaluation* e) {
  try {
    return results.read_text_file(name);
  } catch (const InputError& error) {
    leave_out(name, error.what(), e);
    return "";
  }
}

/// Throws InputError if parts were left out, so that make does not take the output for complete.
void throw_if_incomplete(const Evaluation& e, const std::string& output_folder) {
  if (e.unreadable.empty()) return;
  for (size_t i = 0; i + 1 < e.unreadable.size(); ++i)
    fmt::print(stderr, "cupola-post: error: {}\n", e.unreadable[i]);
  throw InputError(
      fmt::format("{}; {} contains the results of the readable parts", e.unreadable.back(), output_folder));
}

}  // namespace

ExitCode analyse(const AnalyseRequest& request) {
  Assembly assembly = read_assembly(request.assembly_path);
  const ResultsReader results(request.results_folder, content_hash(assembly), request.force);
  check_provenance(request, assembly, results.summary());
  Case scene = request.scene;
  resolve_block_names(assembly, &scene.loads, &scene.ties, &scene.supports);
  Evaluation e = evaluate(scene, std::move(assembly), results);

  const std::string& folder = request.output_folder;
  make_folder(folder);
  // The summary marks the folder as complete: remove the old one before the first file is replaced.
  std::filesystem::remove(in_folder(folder, "summary.json"));
  std::vector<Table> tables = result_tables(e);
  std::optional<Table> stages;
  if (e.summary.analysis == AnalysisType::staged)
    if (const std::string text = readable_text(results, "stages.csv", &e); !text.empty())
      stages = tables.emplace(tables.begin(), stage_table(e, parse_csv(text, "stages.csv")))[0];
  for (const Table& table : tables)
    write_text_atomically(in_folder(folder, table.name + ".csv"), to_csv(table));
  const std::string run_yaml = readable_text(results, "run.yaml", &e);
  Drawn drawn;
  if (!request.tables_only) drawn = draw(request, results, stages, &e);
  write_text_atomically(in_folder(folder, "summary.json"), post_summary_json(e));
  if (!request.tables_only) write_report(request, tables, drawn, run_yaml, e);

  for (const std::string& warning : e.warnings) fmt::print(stderr, "cupola-post: warning: {}\n", warning);
  if (!request.quiet)
    fmt::print("{} tables, {} figures, {} pictures; open {}\n", tables.size(), drawn.figures.size(),
               drawn.pictures.size(),
               in_folder(folder, request.tables_only ? "summary.json" : "report.html"));
  throw_if_incomplete(e, folder);
  return ExitCode::done;
}

}  // namespace cupola

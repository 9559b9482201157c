#include "postproc/analyse.hpp"

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <future>
#include <map>
#include <string>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/base/error.hpp"
#include "assembly/files/atomic_file.hpp"
#include "assembly/files/folder_lock.hpp"
#include "assembly/program/warnings.hpp"
#include "postproc/evaluation/evaluation.hpp"
#include "postproc/figures/figures.hpp"
#include "postproc/pictures/pictures.hpp"
#include "postproc/report/answers.hpp"
#include "postproc/report/load_path.hpp"
#include "postproc/report/report.hpp"
#include "postproc/report/stages.hpp"
#include "postproc/tables/csv_file.hpp"
#include "postproc/tables/mesh_output.hpp"
#include "postproc/tables/mesh_parts.hpp"
#include "postproc/tables/post_summary.hpp"
#include "postproc/tables/result_tables.hpp"
#include "postproc/tables/written_files.hpp"
#include "postproc/viewer/viewer.hpp"

namespace cupola {
namespace {

/// The evaluation of a frame, which lies in `e` or is read into `other`; null if it cannot be read, which is
/// recorded.
const FrameEvaluation* frame_at(size_t index, const ResultsReader& results, Evaluation* e,
                                FrameEvaluation* other) {
  if (static_cast<int>(index) == e->last_frame) return &e->last;
  try {
    *other = evaluate_frame(*e, results.read_frame(static_cast<int>(index)));
    return other;
  } catch (const InputError& error) {
    leave_out(fmt::format("frame {}", index), error.what(), e);
    return nullptr;
  }
}

/// The frames that show the motion: mechanisms, or instants of a motion in time; at most four, evenly spaced,
/// with the last. `moving`: all that could be shown.
std::vector<Frame> moments_of(const std::vector<size_t>& moving, const ResultsReader& results,
                              Evaluation* e) {
  constexpr size_t kMost = 4;
  std::vector<Frame> moments;
  const size_t count = std::min(moving.size(), kMost);
  for (size_t i = 1; i <= count; ++i) {
    FrameEvaluation other;
    const FrameEvaluation* frame = frame_at(moving[moving.size() * i / count - 1], results, e, &other);
    if (frame != nullptr) moments.push_back(frame->frame);
  }
  return moments;
}

/// Writes the displaced blocks of every readable frame, adds them to the film, and returns those that the
/// picture of the motion shows.
std::vector<Frame> write_frames(const ResultsReader& results, const std::string& folder, Evaluation* e,
                                Film* film) {
  DisplacedBlocks blocks(*e);
  std::vector<PvdEntry> entries;
  std::vector<size_t> moving;
  for (size_t i = 0; i < e->times.size(); ++i) {
    FrameEvaluation other;
    const FrameEvaluation* frame = frame_at(i, results, e, &other);
    if (frame == nullptr) continue;
    const std::string name = fmt::format("blocks_{:04}.vtu", i);
    Mesh& mesh = blocks.at(*frame);
    for (MeshArray& array : about(*e, 0.0)) mesh.field_data.push_back(std::move(array));
    write_mesh(in_folder(folder, name), mesh);
    film->add(i, *frame);
    entries.push_back({e->times[i], name});
    if (is_mechanism(frame->frame.role) || (frame->frame.role == FrameRole::step && !at_rest(*e) && i > 0))
      moving.push_back(i);
  }
  write_pvd(in_folder(folder, "blocks.pvd"), entries);
  return moments_of(moving, results, e);
}

void write_meshes(const Evaluation& e, const std::string& folder) {
  write_mesh(in_folder(folder, "joints.vtp"), joints_mesh(e));
  write_mesh(in_folder(folder, "joint_forces.vtp"), joint_forces_mesh(e));
  write_mesh(in_folder(folder, "wrenches.vtp"), wrenches_mesh(e));
  write_mesh(in_folder(folder, "thrust_lines.vtp"), thrust_lines_mesh(e));
  write_mesh(in_folder(folder, "sections.vtp"), sections_mesh(e));
  write_mesh(in_folder(folder, "cracks.vtp"), cracks_mesh(e));
  if (e.last.frame.ties.size() > 0) write_mesh(in_folder(folder, "ties.vtp"), ties_mesh(e));
}

struct Drawn {
  std::string viewer;  ///< the 3-D view, as HTML
  std::vector<Figure> figures;
  std::string picture_folder;  ///< "" without pictures
};

/// Writes meshes for ParaView, figures and pictures. `own`: the figure that only this type of analysis has.
/// Figures that cannot be drawn become warnings.
Drawn draw(const AnalyseRequest& request, const ResultsReader& results, const std::optional<Figure>& own,
           const std::vector<HistoryRow>& history, Evaluation* e) {
  const std::string& folder = request.output_folder;
  Drawn drawn{"", result_figures(*e, history), ""};
  if (own) drawn.figures.insert(drawn.figures.begin(), *own);
  // Takes as long as what follows on this thread; runs at get() if no second thread can be started.
  std::future<std::vector<std::string>> drawing = std::async(std::launch::async | std::launch::deferred, [&] {
    return draw_figures(in_folder(folder, "figures"), drawn.figures);
  });
  Film film(*e);
  const std::vector<Frame> motion = write_frames(results, folder, e, &film);
  write_meshes(*e, folder);
  drawn.viewer = viewer_html(*e, film);
  for (std::string& problem : drawing.get()) e->warnings.push_back(std::move(problem));
  write_paraview_script(folder);
  if (request.pictures) {
    drawn.picture_folder = in_folder(folder, "pictures");
    if (std::string problem = draw_pictures(*e, motion, drawn.picture_folder); !problem.empty())
      e->warnings.push_back(std::move(problem));
  }
  return drawn;
}

/// Writes all tables, and returns what the report shows of them: those of joints and blocks may be large.
std::string write_tables(std::vector<Table> first, const Evaluation& e, const std::string& folder) {
  std::vector<Table> shown;
  std::vector<std::string> pieces;  // of the last of them
  const auto write_last = [&] {
    if (shown.empty()) return;
    write_atomically(in_folder(folder, shown.back().name + ".csv"), [&](const std::string& side) {
      std::ofstream out(side, std::ios::binary);
      for (const std::string& piece : pieces) out << piece;
      out.close();
      return static_cast<bool>(out);
    });
  };
  const auto add = [&](Table table) {
    if (!shown.empty() && shown.back().name == table.name) {
      append_csv_rows(table, &pieces.emplace_back());
      shown.back().rows_elsewhere += table.rows.size();
      return;
    }
    write_last();
    pieces = {to_csv(table)};
    shown.push_back(std::move(table));
  };
  for (Table& table : first) add(std::move(table));
  visit_tables(e, add);
  write_last();
  return tables_html(shown, at_rest(e));
}

void write_report(const AnalyseRequest& request, const std::string& tables,
                  const std::optional<StageReport>& construction, const Drawn& drawn,
                  const std::vector<HistoryRow>& history, const std::string& run_yaml, const Evaluation& e) {
  const std::string& folder = request.output_folder;
  write_text_atomically(in_folder(folder, "report.html"),
                        report_html({.evaluation = &e,
                                     .tables = tables,
                                     .construction = construction,
                                     .history = history,
                                     .viewer = drawn.viewer,
                                     .figures = drawn.figures,
                                     .figure_folder = in_folder(folder, "figures"),
                                     .picture_folder = drawn.picture_folder,
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

/// The motion after every step of a dynamic run, from history.csv; empty for other runs.
std::vector<HistoryRow> read_history(const ResultsReader& results, Evaluation* e) {
  std::vector<HistoryRow> history;
  const std::string name = "history.csv";
  if (e->last.frame.role != FrameRole::step || !e->summary.text_files.contains(name)) return history;
  const std::string text = readable_text(results, name, e);
  if (text.empty()) return history;
  const CsvFile csv = parse_csv(text, name);
  const size_t time = csv.column("time_s"), displacement = csv.column("max_displacement_m");
  const size_t speed = csv.column("max_speed_m_per_s"), reaction = csv.column("support_reaction_x_N");
  for (size_t i = 0; i < csv.rows.size(); ++i) {
    const Vec3 force(csv.number(i, reaction), csv.number(i, reaction + 1), csv.number(i, reaction + 2));
    history.push_back(
        {csv.number(i, time), csv.number(i, displacement), csv.number(i, speed), force.dot(e->up)});
  }
  return history;
}

/// A table of the results; none if there is none or it cannot be read, which is recorded.
std::optional<CsvFile> readable_table(const ResultsReader& results, const std::string& name, Evaluation* e) {
  if (!e->summary.text_files.contains(name)) return std::nullopt;
  const std::string text = readable_text(results, name, e);
  return text.empty() ? std::nullopt : std::optional(parse_csv(text, name));
}

/// What the joints of the stages that stand bear at most, of those with a readable frame.
std::map<int, StagePeaks> read_peaks(const ResultsReader& results, Evaluation* e) {
  std::map<int, StagePeaks> peaks;
  for (size_t i = 0; i < e->times.size(); ++i) {
    FrameEvaluation other;
    const FrameEvaluation* frame = frame_at(i, results, e, &other);
    const std::string number = frame && frame->frame.role == FrameRole::stage ? frame->frame.owner : "";
    if (const std::string stage = "stage "; number.starts_with(stage))
      peaks[std::stoi(number.substr(stage.size()))] = peaks_of(*frame);
  }
  return peaks;
}

/// The stages of a staged run.
std::optional<StageReport> read_construction(const ResultsReader& results, Evaluation* e) {
  if (const auto old = readable_table(results, "stages.csv", e))
    return report_stages(*e, StagedConstruction::Least::friction, from_stages_csv(*old), std::nullopt);
  if (const auto stages = readable_table(results, "construction.csv", e))
    return report_stages(*e, e->scene.analysis.staged.least, *stages,
                         readable_table(results, "failures.csv", e), read_peaks(results, e));
  return std::nullopt;
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
  const std::string& folder = request.output_folder;
  std::error_code not_there;
  if (std::filesystem::equivalent(folder, request.run.results_folder, not_there))
    throw InputError(FileLocation{folder}, "--output: is the folder of the results; give another");
  EvaluatedRun run = evaluate_run(request.run);
  Evaluation& e = run.evaluation;
  const FolderLock lock(folder);
  // The summary marks the folder as complete: remove the old one before the first file is replaced.
  std::filesystem::remove(in_folder(folder, "summary.json"));
  const WrittenFiles written(folder);
  std::vector<Table> own_tables;
  std::optional<Figure> own;
  if (const auto path = readable_table(run.results, "path.csv", &e)) {
    own = path_figure(own_tables.emplace_back(path_table(*path)));
    if (path->rows.size() == e.times.size()) e.times = path_times(*path);  // not their numbers
  }
  const std::optional<StageReport> construction = read_construction(run.results, &e);
  if (construction) {
    own_tables.push_back(construction->table);
    own = construction->figure;
  }
  const std::string tables = write_tables(std::move(own_tables), e, folder);
  const std::string run_yaml = readable_text(run.results, "run.yaml", &e);
  const std::vector<HistoryRow> history = read_history(run.results, &e);
  Drawn drawn;
  if (!request.tables_only) drawn = draw(request, run.results, own, history, &e);
  write_text_atomically(in_folder(folder, "answers.json"), answers_json(e));
  write_text_atomically(in_folder(folder, "summary.json"), post_summary_json(e));
  if (!request.tables_only) write_report(request, tables, construction, drawn, history, run_yaml, e);

  report_warnings("cupola-post", e.warnings, run.doubts, false);
  if (!request.quiet)
    for (const std::string& line :
         terminal_lines(e, in_folder(folder, request.tables_only ? "summary.json" : "report.html")))
      fmt::print("{}\n", line);
  throw_if_incomplete(e, folder);
  return ExitCode::done;
}

}  // namespace cupola

#pragma once

#include "assembly/files/content_hash.hpp"
#include "assembly/files/old_frames.hpp"
#include "postproc/evaluation/evaluation.hpp"
#include "tests/postproc/models.hpp"

namespace cupola::test {

inline constexpr double kGravity = 9.81;

/// The case of a column of three blocks.
inline Case column_case() {
  Case scene;
  scene.title = "Column <b>&amp; \"beds\"";  // must be escaped in HTML
  scene.geometry.surface = WallSurface{1.2, 1.5, 0.8};
  scene.geometry_hash = "geometry of the column";
  scene.hash = "case of the column";
  scene.postproc.sections = {0.8};
  return scene;
}

inline Summary column_summary(const Assembly& a) {
  Summary s;
  s.status = Status::stable;
  s.message = "equilibrium residual 1.0e-12 <= 1.0e-09 asked";
  s.equilibrium_residual = 1e-12;
  s.max_displacement_m = 0.0;
  s.assembly_hash = content_hash(a);
  s.geometry_hash = "geometry of the column";
  s.case_hash = "case of the column";
  s.weight_N = free_weight(a, kGravity);
  s.free_blocks = static_cast<int>(a.blocks.size()) - 1;
  return s;
}

/// Writes frames with the roles that they have in a run with this summary.
inline void write_frames(const std::vector<Frame>& frames, const Summary& summary, ResultsWriter* writer) {
  for (size_t i = 0; i < frames.size(); ++i) {
    Frame frame = frames[i];
    set_role_of_old_frame(summary, static_cast<int>(i), &frame);
    writer->write_frame(frame);
  }
}

/// Writes frames and a summary, and evaluates them.
inline Evaluation evaluated(const Assembly& a, const std::vector<Frame>& frames, const Summary& summary,
                            const Case& scene, const std::string& folder) {
  ResultsWriter writer(folder, content_hash(a));
  write_frames(frames, summary, &writer);
  writer.write_summary(summary);
  return evaluate(scene, a, ResultsReader(folder, content_hash(a)));
}

/// Three blocks with the resultant of every bed at (x, y), and a load of `fraction` times their weight on
/// top.
inline Evaluation column_evaluation(double x, double y, double fraction = 0.0) {
  const Assembly a = column(3);
  Case scene = column_case();
  if (fraction > 0.0) scene.loads.top_load = TopLoad{fraction};
  const double load = fraction * free_weight(a, kGravity);
  return evaluated(a, {column_at_rest(a, kGravity, load, x, y)}, column_summary(a), scene,
                   fresh_folder("results"));
}

/// A frame as a step of a path, with a plane at the height of the section.
inline Evaluation evaluated_path(const Assembly& a, const Frame& frame,
                                 const std::optional<BaseMotion>& ground = {}) {
  Summary summary = column_summary(a);
  summary.analysis = AnalysisType::path;
  summary.steps = 1;
  Case scene = column_case();
  scene.supports.base_motion = ground;
  scene.postproc.planes = {{"middle", {0.0, 0.0, 0.8}, Vec3::UnitZ()}};
  return evaluated(a, {frame}, summary, scene, fresh_folder("results"));
}

}  // namespace cupola::test

#pragma once

#include "tests/postproc/scene.hpp"

namespace cupola::test {

inline RangeEnd bounded_end(double value, double bound, int frame) {
  return {RangeOutcome::bounded, value, bound, frame};
}

/// A thrust with both ends, a hoop force without maximum, a share, and a joint force whose minimum was not
/// found.
inline std::vector<ForceRange> some_ranges() {
  return {
      {"thrust", "N", bounded_end(12.1e6, 12.1e6 * (1 - 1e-8), 1), bounded_end(40e6, 40e6, 2), 20e6},
      {"hoop force of ring 1", "N", bounded_end(-3e5, -3e5, 3), {RangeOutcome::unbounded, {}, {}, 4}, 1e5},
      {"share of the ribs", "", bounded_end(-1e-12, -2e-12, 5), bounded_end(1.0, 1.0, 6), 0.43},
      {"normal force of joint 2-3",
       "N",
       {RangeOutcome::unconverged, 150.0, {}, {}},
       bounded_end(4e3, 4.8e3, 7),
       {},
       std::pair{2, 3}}};
}

inline Summary range_summary(const Assembly& a) {
  Summary s = column_summary(a);
  s.analysis = AnalysisType::range;
  s.ranges = some_ranges();
  return s;
}

/// A range analysis without an admissible state, whose only frame is a mechanism.
struct MovingRun {
  Summary summary;
  Frame frame;
};
inline MovingRun moving_range_run(const Assembly& a) {
  MovingRun run{range_summary(a), column_at_rest(a, kGravity, 0.0, 0.6, 0.4)};
  run.summary.ranges.clear();
  run.summary.status = Status::moving;
  run.frame.blocks.velocity[3] = Vec3(1.0, 0, 0);
  return run;
}

/// Frame 0 of a column at rest, and frames 1 to 7 whose resultants act at other points; the time is the
/// number.
inline std::vector<Frame> range_frames(const Assembly& a) {
  std::vector<Frame> frames;
  for (int i = 0; i <= 7; ++i) {
    frames.push_back(column_at_rest(a, kGravity, 0.0, 0.6, 0.4 + 0.05 * i));
    frames.back().time = i;
  }
  return frames;
}

}  // namespace cupola::test

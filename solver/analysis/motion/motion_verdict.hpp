#pragma once

#include <string>
#include <vector>

#include "solver/analysis/motion/dynamic_history.hpp"
#include "solver/analysis/motion/rest_window.hpp"
#include "solver/analysis/record/record_archive.hpp"
#include "solver/collision/fast_blocks.hpp"

namespace cupola {

/// Progress of a run, apart from the simulation itself.
struct RunProgress {
  int steps = 0;
  int iterations = 0;
  int missed_steps = 0;           // steps whose solve missed the tolerance
  int rounded_steps = 0;          // steps accepted above the tolerance because of rounding
  int coarse_steps = 0;           // shortest steps allowed that missed the time error
  double worst_time_error = 0.0;  // m, of those
  double worst_error = 0.0;       // of the solves in their measure; of the missed steps if there are any
  ErrorMeasure measure = ErrorMeasure::momentum;  // of the worst error
  WorstOfRun worst;
  RunEnergy energy;
  RestWindow rest;
  double farthest = 0.0;       // m, largest displacement of a free block so far, relative to the ground
  double farthest_time = 0.0;  // s
  double calm_since = 0.0;     // s, time since which no block has been faster than the settled speed
  int elastic_steps = 0;       // steps in which contacts begin to bounce, and their longest time of impact, s
  double elastic_impact = 0.0;   // (elastic_impact.hpp)
  double deepest = 0.0;          // m, largest overlap of two blocks in a contact
  bool starts_unstable = false;  // the static start is an unstable balance
  int fast_steps = 0;            // steps with a fast_pair(), the first of them, and when, s
  FastPair fast;
  double fast_time = 0.0;
};

template <class Archive>
void visit(Archive& archive, StepWork& x) {
  archive(x.loads, x.supports, x.dilatancy, x.friction, x.damping, x.impact, x.scheme);
}

template <class Archive>
void visit(Archive& archive, RunEnergy& x) {
  archive(x.start, x.work, x.error, x.worst_error, x.peak_kinetic);
}

template <class Archive>
void visit(Archive& archive, RunProgress& x) {
  archive(x.steps, x.iterations, x.missed_steps, x.rounded_steps, x.coarse_steps, x.worst_time_error,
          x.worst_error, x.measure, x.worst, x.energy, x.rest, x.farthest, x.farthest_time, x.calm_since,
          x.elastic_steps, x.elastic_impact, x.deepest, x.starts_unstable, x.fast_steps, x.fast, x.fast_time);
}

/// Warnings of an unstable balance at the start, of blocks that may have passed others undetected, and of
/// elastic impacts.
std::vector<std::string> motion_warnings(const Analysis& analysis, const RunProgress& progress);

/// Sets status, accuracy, message and the largest displacement from that and the speed at the end. `last`: the
/// solve of the last step.
void judge_motion(const Analysis& analysis, const RunProgress& progress, const SolveSummary& last,
                  Summary* summary);

}  // namespace cupola

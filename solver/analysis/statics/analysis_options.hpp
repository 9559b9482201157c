#pragma once

#include "assembly/case/case_times.hpp"
#include "solver/analysis/statics/static_solve.hpp"

namespace cupola {

/// Options of static solves whose forces are the answer.
StaticOptions static_options(const Analysis& analysis);
/// Options of the static start of a motion.
StaticOptions start_options(const Analysis& analysis);
/// Options of static solves of which only the verdict counts: trials of a limit analysis and of the searches
/// in a construction.
StaticOptions verdict_options(const Analysis& analysis);

/// True if a limit analysis computes its critical value by conic programmes instead of bisection.
bool uses_direct_limit(const Analysis& analysis);
/// The parameter changes what the joints can bear, not the loads: its direct search takes several conic
/// programmes.
bool changes_joints(LimitSearch::Parameter parameter);
/// The relative width of the final bracket of a limit analysis, given or by default.
double bracket_width(const Analysis& analysis);
/// A clause for the message of a limit analysis whose bracket is wider than asked.
std::string missed_width(double width, double asked);

/// Number of steps of a dynamic analysis with fixed steps: the fewest that cover its duration.
int num_steps(const Analysis& analysis);
/// True if a dynamic analysis has reached its duration at `time` (s), after `steps`.
bool is_over(const Analysis& analysis, int steps, double time);
/// Longest step of a dynamic analysis from `time`, s. Adaptive steps end at the times of frames, where one of
/// the functions of time bends, and at the end of the analysis.
double step_limit(const Case& scene, const std::vector<KeyedTime>& times, double time);

}  // namespace cupola

#pragma once

#include "assembly/case/case.hpp"
#include "solver/analysis/statics/static_solve.hpp"

namespace cupola {

/// Options of the static solves of any analysis: of the static analysis itself, of the static start of a
/// motion, of each trial of a limit analysis and of each stage of a construction.
StaticOptions static_options(const Analysis& analysis);

/// True if a limit analysis computes its critical value by conic programmes instead of bisection.
bool uses_direct_limit(const Analysis& analysis);
/// The parameter changes what the joints can bear, not the loads: its direct search takes several conic programmes.
bool changes_joints(LimitSearch::Parameter parameter);
/// The relative width of the final bracket of a limit analysis, given or by default.
double bracket_width(const Analysis& analysis);

/// Static solves of the whole model in one analysis, on average. A limit analysis by bisection takes one for each end of
/// the bracket and one per halving; a construction takes one per ring, of half the model on average.
double num_equilibria(const Analysis& analysis, int num_rings);

/// Longest step of a dynamic analysis from `time`, s. Adaptive steps end at the times of frames and at the
/// end of the analysis.
double step_limit(const Case& scene, double time);

}  // namespace cupola

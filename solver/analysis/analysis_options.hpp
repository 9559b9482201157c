#pragma once

#include "assembly/case/case.hpp"
#include "solver/analysis/static_solve.hpp"

namespace cupola {

/// Options of the static solves of any analysis: of the static analysis itself, of the static start of a
/// motion, of each trial of a limit analysis and of each stage of a construction.
StaticOptions static_options(const Analysis& analysis);

/// Longest step of a dynamic analysis from `time`, s. Adaptive steps end at the times of frames and at the
/// end of the analysis.
double step_limit(const Case& scene, double time);

}  // namespace cupola

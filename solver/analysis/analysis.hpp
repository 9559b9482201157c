#pragma once

#include <functional>
#include <string>

#include "assembly/assembly.hpp"
#include "assembly/case/case.hpp"
#include "assembly/results.hpp"

namespace cupola {

/// Where an analysis hands its frames and lines of log; it writes no files itself.
struct AnalysisSinks {
  std::function<void(const Frame&)> frame;
  std::function<void(const std::string&)> log;      ///< one line per step, fixed columns
  std::function<void(const std::string&)> history;  ///< one CSV row per step, header first
};

/// Runs the analysis that the case asks for and returns its summary, times and provenance left to the caller.
Summary run_analysis(const Case& scene, const Assembly& assembly, const AnalysisSinks& sinks);

/// Equilibrium under dead load in one contact problem with v = 0 and a large step (paper 2.1). The inertia
/// term carries a share of the load that falls with h^2: h is raised until the equilibrium residual, share
/// included, is below `analysis.tolerance`. A structure without equilibrium keeps speeding up: its
/// |v| / (g h) does not fall as h grows, and the status is `moving`.
Summary run_static(const Case& scene, const Assembly& assembly, const AnalysisSinks& sinks);

/// Time stepping from rest under the full dead load (paper eq. 8-15).
Summary run_dynamic(const Case& scene, const Assembly& assembly, const AnalysisSinks& sinks);

}  // namespace cupola

#pragma once

#include <optional>

#include "assembly/case/case.hpp"
#include "assembly/model/assembly.hpp"
#include "assembly/model/results.hpp"
#include "solver/analysis/record/analysis_sinks.hpp"

namespace cupola {

/// Runs the analysis of the case. Returns its summary, in which the caller fills in times and provenance, or
/// nothing if it was interrupted.
std::optional<Summary> run_analysis(const Case& scene, const Assembly& assembly, const AnalysisSinks& sinks);

/// Equilibrium of the assembly as built under its loads: solve_static().
Summary run_static(const Case& scene, const Assembly& assembly, const AnalysisSinks& sinks);

/// Time stepping (paper eq. 8-15) from the unloaded assembly or from its static equilibrium.
std::optional<Summary> run_dynamic(const Case& scene, const Assembly& assembly, const AnalysisSinks& sinks);

/// Searches for the critical value of one parameter: the structure stands at one end of the bracket and moves
/// at the other. Each value takes one static solve; `spread` follows the equilibria while the supports move.
/// Frames: the last equilibrium, and the mechanism with its largest speed scaled to 1 m/s.
std::optional<Summary> run_limit(const Case& scene, const Assembly& assembly, const AnalysisSinks& sinks);

/// run_limit() by conic programmes (direct_limit.hpp). Frames: the admissible state at the critical value,
/// and the mechanism.
std::optional<Summary> run_direct_limit(const Case& scene, const Assembly& assembly,
                                        const AnalysisSinks& sinks);

/// Smallest and largest values of the quantities of the case over all admissible states, beside the state
/// that the compliances choose. Frames: that state, or any admissible one; on request the two ends of each
/// range.
std::optional<Summary> run_range(const Case& scene, const Assembly& assembly, const AnalysisSinks& sinks);

/// Construction by courses or by blocks, from unloaded joints or from the state that the last stage left
/// (construction.hpp). On request, the least cohesion or friction of fresh mortar is searched for with which
/// each stage stands. Frames: every stage, at the time ring - 1 + share of the course that is laid.
std::optional<Summary> run_staged(const Case& scene, const Assembly& assembly, const AnalysisSinks& sinks);

/// Equilibria along a path of loads and support motions. Frames: every equilibrium, at its time.
std::optional<Summary> run_path(const Case& scene, const Assembly& assembly, const AnalysisSinks& sinks);

}  // namespace cupola

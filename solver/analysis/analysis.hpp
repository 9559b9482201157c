#pragma once

#include <functional>
#include <optional>
#include <string>

#include "assembly/case/case.hpp"
#include "assembly/model/assembly.hpp"
#include "assembly/model/results.hpp"
#include "solver/collision/contact_set.hpp"
#include "solver/contact/problem/contact_problem.hpp"

namespace cupola {

/// Receives the output of an analysis, which writes no files itself.
struct AnalysisSinks {
  std::function<void(const Frame&)> frame = [](const Frame&) {};
  /// One log line per step, fixed columns.
  std::function<void(const std::string&)> log = [](const std::string&) {};
  /// One CSV row per step, header first.
  std::function<void(const std::string&)> history = [](const std::string&) {};
  /// A complete table that belongs to this analysis: file name (ending in .csv) and text.
  std::function<void(const std::string& name, const std::string& text)> table = [](const std::string&,
                                                                                   const std::string&) {};
  /// The contact problem of the static solve or of the last step, and its impulses.
  std::function<void(const ContactProblem&, const VecX& gamma)> problem = [](const ContactProblem&,
                                                                             const VecX&) {};
  /// Fraction of the work that is done, in [0, 1], and where the run is, in words.
  std::function<void(double share, const std::string& state)> progress = [](double, const std::string&) {};
  /// The state after the last frame and row, as bytes from which the analysis resumes with the same bits.
  std::function<void(const std::string& bytes)> checkpoint = [](const std::string&) {};
  /// True if the user wants to stop. The analysis then finishes its step, passes a checkpoint and returns.
  std::function<bool()> interrupted = [] { return false; };
  /// The contacts of the assembly as built. Called only by the static analysis, which detects no others.
  std::function<void(const ContactSet&)> as_built = [](const ContactSet&) {};
  std::string resume_from = {};  ///< bytes of a checkpoint; empty: start from the beginning
};

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

/// Smallest and largest values of the quantities of the case over all admissible states, beside the state that the
/// compliances choose. Frames: that state, or any admissible one; on request the two ends of each range.
std::optional<Summary> run_range(const Case& scene, const Assembly& assembly, const AnalysisSinks& sinks);

/// Construction ring by ring. Each stage is a static solve of the rings laid so far; the bed of the last ring
/// has fresh mortar. On request, the critical fresh friction of each stage is searched for.
std::optional<Summary> run_staged(const Case& scene, const Assembly& assembly, const AnalysisSinks& sinks);

/// Construction by courses or by blocks, from the state that the last stage left (construction.hpp). On request, the least
/// cohesion or friction of fresh mortar is searched for with which each stage stands. Frames: every stage, at the time
/// ring - 1 + share of the course that is laid.
std::optional<Summary> run_construction(const Case& scene, const Assembly& assembly,
                                        const AnalysisSinks& sinks);

/// Equilibria along a path of loads and support motions. Frames: every equilibrium, at its time.
std::optional<Summary> run_path(const Case& scene, const Assembly& assembly, const AnalysisSinks& sinks);

}  // namespace cupola

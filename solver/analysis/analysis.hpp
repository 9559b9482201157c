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

/// Where an analysis hands its frames and lines of log; it writes no files itself.
struct AnalysisSinks {
  std::function<void(const Frame&)> frame = [](const Frame&) {};
  /// One line per step, fixed columns.
  std::function<void(const std::string&)> log = [](const std::string&) {};
  /// One CSV row per step, header first.
  std::function<void(const std::string&)> history = [](const std::string&) {};
  /// A table of the analysis' own, whole: file name (ending .csv) and text.
  std::function<void(const std::string& name, const std::string& text)> table = [](const std::string&,
                                                                                   const std::string&) {};
  /// The contact problem of the static solve or of the last step, and its impulses.
  std::function<void(const ContactProblem&, const VecX& gamma)> problem = [](const ContactProblem&,
                                                                             const VecX&) {};
  /// How much is done, in [0, 1].
  std::function<void(double share)> progress = [](double) {};
  /// Everything needed to go on with the same bits after the last frame and row handed over.
  std::function<void(const std::string& bytes)> checkpoint = [](const std::string&) {};
  /// True when the user wants to stop: the analysis finishes its step, hands over a checkpoint and returns.
  std::function<bool()> interrupted = [] { return false; };
  /// Contacts of the assembly as built, from analyses that keep no others; not called by the rest.
  std::function<void(const ContactSet&)> as_built = [](const ContactSet&) {};
  std::string resume_from = {};  ///< bytes of a checkpoint; empty: from the start
};

/// Runs the analysis that the case asks for and returns its summary, times and provenance left to the caller;
/// none when it was interrupted.
std::optional<Summary> run_analysis(const Case& scene, const Assembly& assembly, const AnalysisSinks& sinks);

/// Equilibrium under dead load: solve_static() on the assembly as built.
Summary run_static(const Case& scene, const Assembly& assembly, const AnalysisSinks& sinks);

/// Time stepping (paper eq. 8-15) from the unloaded assembly, or from its static equilibrium.
std::optional<Summary> run_dynamic(const Case& scene, const Assembly& assembly, const AnalysisSinks& sinks);

/// Searches the critical value of one parameter: the structure stands on one side of the bracket and moves on
/// the other. Every value is judged by a static solve; `spread` follows the equilibria while supports move.
/// Frames: the last equilibrium, and the mechanism with its velocities scaled to 1 m/s.
std::optional<Summary> run_limit(const Case& scene, const Assembly& assembly, const AnalysisSinks& sinks);

/// Builds ring after ring. Each stage is a static solve of what stands so far, the bed of its last ring with
/// the friction of fresh mortar; the critical fresh friction of each stage is searched on request.
std::optional<Summary> run_staged(const Case& scene, const Assembly& assembly, const AnalysisSinks& sinks);

}  // namespace cupola

#pragma once

#include <functional>
#include <string>

#include "assembly/model/results.hpp"
#include "solver/collision/contact_set.hpp"

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

}  // namespace cupola

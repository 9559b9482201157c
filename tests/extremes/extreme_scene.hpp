#pragma once

#include <functional>
#include <limits>
#include <string>
#include <vector>

#include "assembly/base/named_enum.hpp"
#include "assembly/case/case.hpp"
#include "assembly/model/assembly.hpp"
#include "assembly/model/results.hpp"

namespace cupola {

/// How a run may end. `timeout`: stopped after kTimeLimit; `failed`: an exception or a signal.
enum class Ending { stable, moving, collapsed, unconverged, refused, timeout, failed };
constexpr auto enum_names(Ending) {
  return std::array{"stable", "moving", "collapsed", "unconverged", "refused", "timeout", "failed"};
}

/// `right`: the answer is correct to the accuracy that the run states. `not_met`: the run reports that it has
/// no answer. `wrong`: a wrong answer is presented as a good one.
enum class Verdict { right, not_met, wrong };
constexpr auto enum_names(Verdict) {
  return std::array{"right", "not met", "WRONG"};
}

/// Processor time that a row may take, s.
constexpr double kTimeLimit = 60.0;

/// Input of the solver: the case and the assembly.
struct Scene {
  Case input;
  Assembly assembly;
};

/// Errors of the forces of a frame against forces that are known independently. NaN: not known.
struct TrueError {
  /// Largest |F - exact| / |exact| of the known resultants F that carry more than 1 % of their mean.
  double largest = std::numeric_limits<double>::quiet_NaN();
  /// Lower bound of the largest relative error of a joint wrench, the quantity that a static analysis
  /// certifies.
  double wrench = std::numeric_limits<double>::quiet_NaN();
  /// A statement of the summary that these forces refute, with the numbers; "" if there is none.
  std::string refuted = {};
  /// False if the reference itself found no forces.
  bool has_reference = true;
};

/// One row of the table of extremes.
struct ExtremeScene {
  std::string group;            ///< e.g. "compliance contrast"
  std::string name;             ///< what is hard about it
  std::string reference;        ///< the exact answer and its source
  std::vector<Ending> correct;  ///< correct endings; `unconverged` and `timeout` are honest in every row
  std::function<Scene()> make;  ///< throws InputError if the scene is refused
  std::function<TrueError(const Scene&, const Summary&, const Frame&)> truth = {};
  /// Further condition on the result: "" if it holds, otherwise a message with the numbers.
  std::function<std::string(const Summary&, const Frame&)> check = {};
  bool slow = false;  ///< takes more than a second
};

/// All rows in the order of the table.
const std::vector<ExtremeScene>& extreme_scenes();

/// Result of one row.
struct ExtremeResult {
  Ending ending = Ending::failed;
  Verdict verdict = Verdict::wrong;
  std::string reason;   ///< why the answer is wrong, or what the run reports if it has none
  std::string message;  ///< of the solver, or of the exception
  std::string stated;   ///< accuracy that the run states, for the table
  TrueError error;
  double asked = 0.0;
  int iterations = 0;
  double seconds = 0.0;  ///< processor time of the analysis
};
/// Runs the row in a process of its own, which is stopped after kTimeLimit of processor time.
ExtremeResult run_extreme(const ExtremeScene& scene);

}  // namespace cupola

#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "assembly/base/named_enum.hpp"
#include "assembly/case/case.hpp"
#include "assembly/model/assembly.hpp"
#include "assembly/model/results.hpp"

namespace cupola {

/// How an extreme scene may end. `missed`: the run reports that it did not reach the requested accuracy.
enum class Ending { stable, moving, collapsed, refused, missed };
constexpr auto enum_names(Ending) {
  return std::array{"stable", "moving", "collapsed", "refused", "not reached"};
}

/// Input of the solver: the case and the assembly.
struct Scene {
  Case input;
  Assembly assembly;
};

/// One row of the table of extremes.
struct ExtremeScene {
  std::string group;            ///< e.g. "compliance"
  std::string name;             ///< e.g. "1e-14 m/N"
  std::string expected;         ///< expected result in words, for the table
  std::vector<Ending> endings;  ///< endings that are accepted
  std::function<Scene()> make;  ///< throws InputError if the scene is refused
  /// Further condition on the result: "" if it holds, otherwise a message with the numbers.
  std::function<std::string(const Summary&, const Frame&)> check = {};
  bool slow = false;  ///< takes more than a few seconds
};

/// All rows in the order of the table.
const std::vector<ExtremeScene>& extreme_scenes();

/// Result of one row.
struct ExtremeResult {
  Ending ending = Ending::missed;
  std::string message;                ///< of the solver or of the InputError
  double asked = 0.0, reached = 0.0;  ///< accuracy
  double seconds = 0.0;               ///< processor time
  /// "" if the row passes: the ending is accepted, all numbers are finite, a run that ends `stable` reached
  /// its requested accuracy, and `check` holds. Otherwise the reason.
  std::string fault;
};
ExtremeResult run_extreme(const ExtremeScene& scene);

}  // namespace cupola

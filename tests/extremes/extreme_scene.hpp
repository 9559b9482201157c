#pragma once

#include <functional>
#include <string>
#include <utility>
#include <vector>

#include "assembly/case/case.hpp"
#include "assembly/model/assembly.hpp"
#include "assembly/model/results.hpp"

namespace cupola {

/// How a scene at the edge may end. `missed`: the accuracy asked was not reached, and the run says so.
enum class Ending { stable, moving, collapsed, refused, missed };
std::string to_string(Ending ending);

/// A scene: what the three programs would hand to the solver.
struct Scene {
  Case input;
  Assembly assembly;
};

/// One row of the table of extremes.
struct ExtremeScene {
  std::string group;            ///< e.g. "compliance"
  std::string name;             ///< e.g. "1e-14 m/N"
  std::string expected;         ///< in words, for the table
  std::vector<Ending> endings;  ///< those that count as right
  std::function<Scene()> make;  ///< may throw InputError: refused
  /// What else must hold of the result; "" where it does, else a sentence with the numbers.
  std::function<std::string(const Summary&, const Frame&)> check = {};
  bool slow = false;  ///< takes more than a few seconds
};

/// Every row, in the order of the table.
const std::vector<ExtremeScene>& extreme_scenes();

/// What a row gave.
struct ExtremeResult {
  Ending ending = Ending::missed;
  std::string message;  ///< of the solver, or the sentence of the refusal
  double asked = 0.0, reached = 0.0;
  double seconds = 0.0;  ///< processor time
  /// "" where the row is right: ended as expected, every number finite, the accuracy asked reached where it
  /// claims so, and its own check holds.
  std::string fault;
};
ExtremeResult run_extreme(const ExtremeScene& scene);

}  // namespace cupola

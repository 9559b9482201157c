#pragma once

#include <functional>
#include <optional>
#include <string>

#include "solver/analysis/analysis.hpp"
#include "solver/analysis/rigid_scene.hpp"

namespace cupola {

/// One solve of a direct limit analysis.
struct DirectTrial {
  double value = 0.0;
  bool admissible = false;  ///< forces in equilibrium and within the cones exist
  std::optional<double>
      pull;  ///< f of limit_of_joints(); infinite: no pull helps, or any pressure is possible
  int iterations = 0;
};

/// The critical value between a value with an admissible state and one for which a mechanism proves that there
/// is none.
struct DirectLimit {
  bool found = false;
  double admissible = 0.0, moving = 0.0;
  RigidScene at_admissible, at_moving;
  VecX gamma;      ///< N: the admissible state (3 nc)
  VecX mechanism;  ///< its velocities prove the motion (6 nb)
  int trials = 0, iterations = 0;
  std::string message;  ///< how the search ended
  double middle() const { return 0.5 * (admissible + moving); }
  double relative_width() const;
};

/// The scene at one value of the parameter.
using SceneAt = std::function<RigidScene(double value)>;
using ReportTrial = std::function<void(const DirectTrial&)>;

/// Critical value of a parameter on which the loads depend smoothly. Each iteration maximises (or minimises)
/// the multiplier t of the loads w(x) + t w'(x), linear in x, and moves x by t: one solve where the loads are
/// linear in the parameter, a few for a tilt. `low` and `high`: an admissible state exists at one of them.
DirectLimit limit_of_loads(const SceneAt& scene_at, double low, double high, double relative_width,
                           const ReportTrial& report);

/// Critical value of a parameter of the joints: friction or thickness. f(x) is the least pull alpha, over the
/// mean block weight, that every contact would have to bear for the loads to be balanced:
///
///     minimise alpha,   D (gamma - alpha a) + w = 0,   gamma in Y,   a = (1, 0, 0) times the mean block weight
///
/// An admissible state exists where f <= 0. The root is found by Newton's method where `friction` gives the
/// derivative df/dx = -sum_i |s_t,i| gamma_n,i dmu_i/dx from the dual s, else by the secant method, within a
/// bracket that always contains it.
DirectLimit limit_of_joints(const SceneAt& scene_at, double low, double high, double relative_width,
                            bool friction, const ReportTrial& report);

/// run_limit() by these searches, to a relative width of 1e-5. Frames: the admissible state
/// at the critical value, and the mechanism.
std::optional<Summary> run_direct_limit(const Case& scene, const Assembly& assembly,
                                        const AnalysisSinks& sinks);

}  // namespace cupola

#pragma once

#include <map>
#include <string>
#include <tuple>

#include "postproc/mechanics/wrench.hpp"
#include "postproc/tables/run_files.hpp"

namespace cupola {

/// What a run says about the forces that users care for.
struct RunForces {
  /// By the two blocks and the kind: a joint that one run has and another has not counts as unloaded there.
  std::map<std::tuple<int, int, std::string>, Wrench> beds;
  double mean_area = 0.0;  ///< m2, of those joints
  std::map<std::string, std::map<int, double>>
      thrust;                ///< table of the meridian -> bed -> position in the thickness
  double base_thrust = 0.0;  ///< N, outward, sum over the base; 0 where no rings
};
RunForces read_forces(RunFiles& run);

/// How far a run is from its reference. All relative, without unit.
struct ForceErrors {
  /// sqrt(sum e_j^2 / sum w_j^2) over the bed and base joints: e_j^2 = |dF|^2 + |dM|^2 / A, moments about the
  /// reference's centre of pressure, A the reference's mean area of a joint; w_j the same of its wrench.
  double wrench_rms = 0.0;
  double wrench_worst = 0.0;  ///< largest e_j over the root mean square of w_j
  double thrust_line = 0.0;   ///< largest shift of a thrust line's point, over the thickness
  double base_thrust = 0.0;   ///< difference over the reference's; 0 where that has none
};
ForceErrors compare_forces(const RunForces& reference, const RunForces& run);

}  // namespace cupola

#pragma once

#include <map>
#include <string>
#include <tuple>

#include "postproc/mechanics/wrench.hpp"
#include "postproc/tables/run_files.hpp"

namespace cupola {

/// The forces of a run that a study compares.
struct RunForces {
  /// By the two blocks and the kind. A joint that only one of two runs has counts as unloaded in the other.
  std::map<std::tuple<int, int, std::string>, Wrench> beds;
  double mean_area = 0.0;  ///< m2, of these joints
  /// Name of the meridian's table -> bed -> position of the thrust line in the thickness.
  std::map<std::string, std::map<int, double>> thrust;
};
RunForces read_forces(RunFiles& run);

/// 2 `fine` - `coarse`: the forces at a time step of zero, if their error is proportional to the time step
/// and `coarse` has twice that of `fine` (Richardson's extrapolation). Second-order errors remain. A joint
/// that one run lacks counts as unloaded in it.
RunForces extrapolated(const RunForces& fine, const RunForces& coarse);

/// Errors of a run against its reference, all relative and without unit.
struct ForceErrors {
  ///   sqrt(sum_j e_j^2 / sum_j w_j^2)    over the bed and base joints j
  ///
  /// with e_j^2 = |dF|^2 + |dM|^2 / A and w_j^2 = |F|^2 + |M|^2 / A. dF, dM: error of the wrench; F, M:
  /// wrench of the reference; moments about the reference's centre of pressure; A: mean joint area of the
  /// reference.
  double wrench_rms = 0.0;
  double wrench_worst = 0.0;  ///< largest e_j / root mean square of w_j
  double thrust_line = 0.0;   ///< largest shift of a point of a thrust line / thickness
};
ForceErrors compare_forces(const RunForces& reference, const RunForces& run);

}  // namespace cupola

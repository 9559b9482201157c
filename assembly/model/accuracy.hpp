#pragma once

#include <optional>
#include <string>

namespace cupola {

/// The accuracy that decides whether a run has converged: the error measure of one quantity in one norm.
struct Accuracy {
  std::string quantity;  ///< what is in error, e.g. `force balance of the blocks`
  std::string norm;      ///< how its error is measured, e.g. `largest over the blocks, relative to ...`
  double asked = 0.0;    ///< largest error accepted
  double reached = 0.0;  ///< error of the state that the results show
  double worst_over_run = 0.0;                          ///< largest error of all steps or stages of the run
  bool met() const { return worst_over_run <= asked; }  ///< false for NaN
};

/// Upper bound of the error of the forces that requires no reference solution.
struct ForceCertificate {
  std::optional<double> value;
  std::string bounds;  ///< what `value` bounds and in which norm; without a value, why nothing is certified
};

/// Whether the model determines its forces uniquely.
struct ForcesUnique {
  bool value = true;
  std::string reason;
};

}  // namespace cupola

#pragma once

namespace cupola {

/// What every method is told.
struct SolveOptions {
  /// The stopping rule of the method is met when its measure <= tolerance, in (0, 1), no unit: the momentum
  /// residual for newton, contact-law residual or certified force error for first-order methods (see each).
  double tolerance = 1e-10;
  double reference_speed =
      0.0;                 ///< m/s, > 0: h |g|, the speed a free block picks up; makes residuals relative
  int max_iterations = 0;  ///< >= 0; 0: the method's own default
  /// Newton only: keep a factor from step to step as preconditioner of conjugate gradients and renew it when
  /// they need more than 25 iterations. Faster while few contacts change state; the answer's accuracy is the
  /// same.
  bool lag_factor = false;

  /// Throws std::invalid_argument with name, value and rule.
  void validate() const;
};

}  // namespace cupola

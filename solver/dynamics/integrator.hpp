#pragma once

#include "assembly/model/choices.hpp"

namespace cupola {

/// Coefficients of a step from time t to t + h. With the velocities v at its ends, the forces r of a contact
/// at its ends and its filtered force s at the start:
///
///     M (v+ - v) = h f + D p,   p = h (filtered s + start r + end r+)
///     q+ - q     = h (v_start v + v_end v+) + h^2 a (f + D s) / M
///     s+         = (end r+ + start r) / (end + start)
///
/// where D and f are those of the configuration q + middle h v. Contacts that have just closed take an
/// impulse p = h r+ as in implicit Euler, so that no impact enters s; so do those that pass it on, after it.
struct Integrator {
  double filtered, start, end;
  double v_start, v_end, a;
  double middle;

  bool is_euler() const { return middle == 0.0; }

  /// Implicit Euler (paper eq. 10, 11): first order.
  static constexpr Integrator euler() { return {0.0, 0.0, 1.0, 0.0, 1.0, 0.0, 0.0}; }
  /// Generalized alpha method of J. Chung and G. M. Hulbert (1993), J. Appl. Mech. 60, 371, with spectral
  /// radius rho = 1/2 at infinity:
  ///
  ///     alpha_m = (2 rho - 1) / (rho + 1) = 0,       alpha_f = rho / (rho + 1) = 1/3,
  ///     gamma = 1/2 - alpha_m + alpha_f = 5/6,       beta = (1 - alpha_m + alpha_f)^2 / 4 = 4/9
  ///
  /// Second order for contacts that stay closed. Differences: the loads f are integrated by their value in
  /// the middle of the step, and filtered accelerations are kept as forces of the contacts, which follow the
  /// contacts where these turn or vanish.
  static constexpr Integrator generalized_alpha() {
    return {1.0 / 6.0, 5.0 / 18.0, 5.0 / 9.0, 7.0 / 15.0, 8.0 / 15.0, -1.0 / 30.0, 0.5};
  }
  static constexpr Integrator of(TimeIntegrator which) {
    return which == TimeIntegrator::euler ? euler() : generalized_alpha();
  }
};

}  // namespace cupola

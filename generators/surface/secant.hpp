#pragma once

#include <cmath>

namespace cupola {

/// Root of a smooth function near x0 by the secant method, to the rounding of x. Converges in a handful of
/// steps from the guesses used here; stops when the step no longer changes x, or after 50.
template <class Function>
double secant_root(const Function& f, double x0, double x1) {
  double f0 = f(x0);
  for (int i = 0; i < 50; ++i) {
    const double f1 = f(x1);
    if (f1 == f0 || f1 == 0.0) break;
    const double x2 = x1 - f1 * (x1 - x0) / (f1 - f0);
    x0 = x1;
    f0 = f1;
    x1 = x2;
    if (std::abs(x1 - x0) <= 1e-16 * std::abs(x1)) break;
  }
  return x1;
}

}  // namespace cupola

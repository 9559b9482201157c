#pragma once

#include <cmath>

#include "assembly/base/error.hpp"

namespace cupola {

/// Root of a smooth function near x0 by the secant method, accurate to rounding. It needs about four steps
/// from the guesses used here, and stops when a step no longer changes x or after 50 steps.
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
  CUPOLA_ASSERT(std::isfinite(x1));
  return x1;
}

}  // namespace cupola

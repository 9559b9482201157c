#include "generators/surface/azimuth.hpp"

#include <cmath>
#include <numbers>

namespace cupola {

double abscissa_at(const std::function<Vec3(double abscissa)>& point, double azimuth, double guess) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  constexpr double kRounding = 1e-12;  // rad, far above that of sines and below any difference of abscissae
  const auto ahead = [&](double abscissa) {  // rad, from -pi to pi
    const Vec3 p = point(abscissa);
    return std::remainder(azimuth - std::atan2(p.y(), p.x()), kTurn);
  };
  const double missing = ahead(guess);
  if (std::abs(missing) < kRounding) return guess;
  // Azimuths grow with abscissae, both by a turn.
  const double sign = missing > 0.0 ? 1.0 : -1.0;
  double near = 0.0, far = kTurn;  // from the guess
  for (int i = 0; i < 60; ++i) {
    const double middle = 0.5 * (near + far);
    double passed = sign * (missing - ahead(guess + sign * middle));  // rad, of azimuth
    if (passed < 0.0) passed += kTurn;
    (passed < std::abs(missing) ? near : far) = middle;
  }
  return guess + sign * 0.5 * (near + far);
}

}  // namespace cupola

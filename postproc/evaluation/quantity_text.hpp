#pragma once

#include <string>

namespace cupola {

/// The unit N, kN or MN in which forces up to `largest` (N) have few zeros.
struct ForceUnit {
  double per_newton = 1.0;
  const char* name = "N";
};
ForceUnit force_unit(double largest);

/// "1.235 MN"; "negligible" for 0.
std::string force_text(double newtons);

/// "a normal force of 1.235 MN"; "a pull of 5.66 kN" of a negative one.
std::string normal_force_text(double newtons);

/// "12.3 mm", "1.23 m"; "negligible" for 0.
std::string length_text(double metres);

}  // namespace cupola

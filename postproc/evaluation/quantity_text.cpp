#include "postproc/evaluation/quantity_text.hpp"

#include <cmath>

#include <fmt/format.h>

namespace cupola {

ForceUnit force_unit(double largest) {
  if (largest >= 1e5) return {1e-6, "MN"};
  if (largest >= 100.0) return {1e-3, "kN"};
  return {1.0, "N"};
}

std::string force_text(double newtons) {
  if (newtons == 0.0) return "negligible";
  const double size = std::abs(newtons);  // an axis ends in MN from 0.1 MN on, a single number from 1 MN on
  const ForceUnit unit = size >= 1e5 && size < 1e6 ? ForceUnit{1e-3, "kN"} : force_unit(size);
  return fmt::format("{:.4g} {}", unit.per_newton * newtons, unit.name);
}

std::string normal_force_text(double newtons) {
  if (newtons < 0.0) return "a pull of " + force_text(-newtons);
  return newtons == 0.0 ? "a negligible normal force" : "a normal force of " + force_text(newtons);
}

std::string length_text(double metres) {
  if (metres == 0.0) return "negligible";
  if (std::abs(metres) >= 1e3) return fmt::format("{:.0f} m", metres);
  if (std::abs(metres) < 1e-6) return fmt::format("{:.2g} µm", 1e6 * metres);
  constexpr double kRoundsToOne = 0.9995;  // to three digits
  return std::abs(metres) < kRoundsToOne ? fmt::format("{:.3g} mm", 1e3 * metres)
                                         : fmt::format("{:.3g} m", metres);
}

}  // namespace cupola

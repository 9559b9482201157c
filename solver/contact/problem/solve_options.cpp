#include "solver/contact/problem/solve_options.hpp"

#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace cupola {

void SolveOptions::validate() const {
  const auto require = [](bool rule, std::string_view name, double value, std::string_view text) {
    if (!rule)
      throw std::invalid_argument(fmt::format("contact solver: {} = {}: must be {}", name, value, text));
  };
  require(tolerance > 0.0 && tolerance < 1.0, "tolerance", tolerance, "in (0, 1)");
  require(reference_speed > 0.0 && std::isfinite(reference_speed), "reference_speed", reference_speed, "> 0");
  require(max_iterations.value_or(1) >= 1, "max_iterations", max_iterations.value_or(1), ">= 1");
}

}  // namespace cupola

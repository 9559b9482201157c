#include "solver/analysis/admissible/direct_limit.hpp"

#include <cmath>

#include <fmt/format.h>

#include "solver/analysis/statics/limit_search.hpp"

namespace cupola {

bool DirectLimit::is_zero() const {
  return std::abs(middle()) <= kZeroLimit * span;
}

double DirectLimit::relative_width() const {
  return std::abs(admissible - moving) / (is_zero() ? span : std::abs(middle()));
}

DirectLimit not_found(DirectLimit searched, std::string message) {
  DirectLimit limit;
  limit.trials = searched.trials;
  limit.iterations = searched.iterations;
  limit.message = std::move(message);
  return limit;
}

std::string unsolved_end(double value) {
  return fmt::format(
      "the solve at {:g}, an end of the search (analysis.limit.low or high), did not converge; move that end",
      value);
}

std::string at_both_ends(bool admissible, double low, double high) {
  return admissible
             ? fmt::format(
                   "the structure stands at both ends of the bracket, {:g} and {:g}; widen the bracket", low,
                   high)
             : fmt::format(
                   "the structure moves at both ends of the bracket, {:g} and {:g}; it must stand at one",
                   low, high);
}

}  // namespace cupola

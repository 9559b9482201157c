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

DirectLimit not_found(DirectLimit searched, Sought why) {
  DirectLimit limit;
  limit.trials = searched.trials;
  limit.iterations = searched.iterations;
  limit.sought = std::move(why);
  return limit;
}

Sought unsolved_end(double value) {
  return {
      .reason = fmt::format(
          "the solve at {:g}, an end of the search (analysis.limit.low or high), did not converge", value),
      .advice = "move that end"};
}

}  // namespace cupola

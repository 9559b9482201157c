#include "postproc/figures/range_text.hpp"

#include <cmath>

#include <fmt/format.h>

#include "postproc/evaluation/quantity_text.hpp"
#include "postproc/tables/range_values.hpp"

namespace cupola {

RangeUnit range_unit(const ForceRange& range) {
  if (range.unit != "N") return {1.0, range.unit};
  const ForceUnit unit = force_unit(size_of(range));
  return {unit.per_newton, unit.name};
}

std::string range_name(const ForceRange& range) {
  return (range.quantity.starts_with("thrust") ? "outward " : "") + range.quantity;
}

std::string range_number(double value, const ForceRange& range) {
  if (std::abs(value) <= kNegligibleShare * size_of(range)) return "0";
  return fmt::format("{:.4g}", range_unit(range).per_si * value);
}

}  // namespace cupola

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

std::string range_ends(const ForceRange& range) {
  const auto text = [&range](const RangeEnd& end, double value) -> std::string {
    if (std::isnan(value)) return "unknown";
    const std::string number = std::isinf(value) ? (value > 0.0 ? "∞" : "-∞") : range_number(value, range);
    return end.outcome == RangeOutcome::unconverged ? number + "?" : number;
  };
  const std::string from = text(range.min, least(range)), to = text(range.max, greatest(range));
  return (from == to ? from : fmt::format("{} to {}", from, to)) + range_unit(range).after_blank();
}

}  // namespace cupola

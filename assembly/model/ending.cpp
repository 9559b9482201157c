#include "assembly/model/ending.hpp"

#include <optional>

namespace cupola {

bool falls(const Summary& summary) {
  return summary.status == Status::collapsed || (moves(summary.status) && !summary.max_speed_m_per_s);
}

bool falls(std::string_view ending) {
  const std::optional<Status> known = enum_from_name<Status>(ending);
  return known && (moves(*known) || *known == Status::collapsed);
}

std::string words_of(const Summary& summary) {
  if (summary.bears_loads_until_s) return "it bears part of its loads";
  return moves(summary.status) && !falls(summary) ? "it has not come to rest" : words_of(summary.status);
}

}  // namespace cupola

#include "assembly/model/ending.hpp"

#include <optional>

namespace cupola {

bool falls(std::string_view ending) {
  const std::optional<Status> known = enum_from_name<Status>(ending);
  return known && (moves(*known) || *known == Status::collapsed);
}

std::string words_of(Status status, AnalysisType analysis) {
  return moves(status) && !falls(status, analysis) ? "it has not come to rest" : words_of(status);
}

}  // namespace cupola

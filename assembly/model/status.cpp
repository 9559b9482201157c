#include "assembly/model/status.hpp"

#include <optional>

namespace cupola {

bool stands(std::string_view status) {
  const std::optional<Status> known = enum_from_name<Status>(status);
  return known && stands(*known);
}

bool missed(std::string_view status) {
  const std::optional<Status> known = enum_from_name<Status>(status);
  return known && !reached(*known);
}

std::string words_of(Status status) {
  switch (status) {
    case Status::stable:
      return "it stands";
    case Status::stable_unproven:
      return "it stands, not proven";
    case Status::moving:
    case Status::collapsed:
      return "it falls";
    case Status::moving_unproven:
      return "it falls, not proven";
    case Status::bracketed:
    case Status::unconverged:
      break;
  }
  return "undecided";
}

}  // namespace cupola

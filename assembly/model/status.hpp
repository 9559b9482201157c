#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>

#include "assembly/base/named_enum.hpp"

namespace cupola {

/// How a run ended. A solve proves its verdict in exact arithmetic or says that it did not. A motion says how
/// the history that was followed ended: at rest (`stable`), moving or collapsed.
enum class Status : std::uint8_t {
  stable,           ///< forces in exact equilibrium within the limits of the joints are proven to exist
  stable_unproven,  ///< forces balance the loads to the tolerance; that exact ones exist is not proven
  moving,           ///< no forces balance the loads: proven
  moving_unproven,  ///< a motion was found; that no forces balance the loads is not proven
  collapsed,        ///< of a motion: a block was displaced beyond the threshold
  bracketed,        ///< a limit between two proven ends that are farther apart than was asked
  unconverged       ///< the accuracy asked for was not reached
};
constexpr auto enum_names(Status) {
  return std::array{"stable",    "stable_unproven", "moving",     "moving_unproven",
                    "collapsed", "bracketed",       "unconverged"};
}

constexpr bool stands(Status s) {
  return s == Status::stable || s == Status::stable_unproven;
}
constexpr bool moves(Status s) {
  return s == Status::moving || s == Status::moving_unproven;
}
constexpr bool proven(Status s) {
  return s != Status::stable_unproven && s != Status::moving_unproven;
}
/// False if the accuracy asked for was missed: exit code 3.
constexpr bool reached(Status s) {
  return s != Status::bracketed && s != Status::unconverged;
}
constexpr Status standing(bool proven) {
  return proven ? Status::stable : Status::stable_unproven;
}
constexpr Status motion(bool proven) {
  return proven ? Status::moving : Status::moving_unproven;
}

/// The same questions to a name in a file; false for a name that is no status.
bool stands(std::string_view status);
bool missed(std::string_view status);

/// "it stands, not proven".
std::string words_of(Status status);

}  // namespace cupola

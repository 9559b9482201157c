#pragma once

#include <string>
#include <vector>

namespace cupola {

/// One key of the case that a study varies. Several keys are combined, each value with each.
struct SweptKey {
  std::string key;  ///< path, as after --set
  std::vector<std::string> values;
};

/// One run of a study: the case with some keys changed.
struct SweepMember {
  std::string name;                   ///< of its folder: CASE_friction0.2
  std::vector<std::string> settings;  ///< key.path=value, in the order of the swept keys
};

/// The members in the order in which the values are given, the last key's fastest. `case_name` begins each
/// name; keys appear by their last word, or whole where two share it. Throws InputError without a sweep, and
/// for values that cannot be part of a file name.
std::vector<SweepMember> members_of(const std::vector<SweptKey>& sweep, const std::string& case_name);

}  // namespace cupola

#pragma once

#include <string>
#include <vector>

#include "assembly/base/error.hpp"

namespace cupola {

/// One key of the case varied in a study. All combinations of the values of several keys are run.
struct SweptKey {
  std::string key;  ///< key path, as after --set
  std::vector<std::string> values;
};

/// One run of a study: the case with the swept keys set.
struct SweepMember {
  std::string name;                   ///< name of its folder, e.g. CASE_friction0.2
  std::vector<std::string> settings;  ///< key.path=value, in the order of the swept keys
};

/// Values of keys, one row per member of a study.
struct Samples {
  std::vector<std::string> keys;               ///< key paths, as after --set
  std::vector<std::vector<std::string>> rows;  ///< (members x keys)
  std::vector<FileLocation> places = {};       ///< of the rows in their file; empty if they were drawn
  /// The same members, wherever they come from.
  bool operator==(const Samples& other) const { return keys == other.keys && rows == other.rows; }
};

/// Reads samples: a header line of key paths, then a line of values per member, separated by commas. Throws
/// InputError with file and line.
Samples read_samples(const std::string& path);

/// One member per row, named `prefix` with the number of the row, from 0001.
std::vector<SweepMember> members_of(const Samples& samples, const std::string& prefix);

/// All members, in the order of the values; those of the last key vary fastest. Names start with `case_name`
/// and contain the last word of each key, or the whole key if two keys share that word. Throws InputError if
/// there is no sweep and for values that cannot be part of a file name.
std::vector<SweepMember> members_of(const std::vector<SweptKey>& sweep, const std::string& case_name);

}  // namespace cupola

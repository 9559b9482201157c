#pragma once

#include <string>
#include <string_view>

#include "assembly/model/results.hpp"

namespace cupola {

/// True if a run says that the structure falls. A motion in time, which has a largest speed, says neither
/// that it falls nor that it stands while it goes on below the threshold of collapse.
bool falls(const Summary& summary);

/// The same of a name in a file, where `not at rest` stands for such a motion; false for it and for any other
/// name that is no status.
bool falls(std::string_view ending);

/// The words of a status, "it has not come to rest" for such a motion, "it bears part of its loads" for a path
/// that ends before all of them.
std::string words_of(const Summary& summary);

}  // namespace cupola

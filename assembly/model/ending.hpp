#pragma once

#include <string>
#include <string_view>

#include "assembly/model/choices.hpp"
#include "assembly/model/status.hpp"

namespace cupola {

/// True if a run says that the structure falls. A motion in time that goes on below the threshold of collapse
/// says neither that it falls nor that it stands.
constexpr bool falls(Status status, AnalysisType analysis) {
  return status == Status::collapsed || (moves(status) && analysis != AnalysisType::dynamic);
}

/// The same of a name in a file, where `not at rest` stands for such a motion; false for it and for any other
/// name that is no status.
bool falls(std::string_view ending);

/// The words of a status, "it has not come to rest" for such a motion.
std::string words_of(Status status, AnalysisType analysis);

}  // namespace cupola

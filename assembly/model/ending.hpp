#pragma once

#include <string>

#include "assembly/model/choices.hpp"
#include "assembly/model/status.hpp"

namespace cupola {

/// True if a run says that the structure falls. A motion in time that goes on below the threshold of collapse
/// says neither that it falls nor that it stands.
constexpr bool falls(Status status, AnalysisType analysis) {
  return status == Status::collapsed || (moves(status) && analysis != AnalysisType::dynamic);
}

/// The words of a status, "it has not come to rest" for such a motion.
std::string words_of(Status status, AnalysisType analysis);

}  // namespace cupola

#include "assembly/model/ending.hpp"

namespace cupola {

std::string words_of(Status status, AnalysisType analysis) {
  return moves(status) && !falls(status, analysis) ? "it has not come to rest" : words_of(status);
}

}  // namespace cupola

#pragma once

#include "assembly/case/case.hpp"
#include "tests/solver/course_scenes.hpp"

namespace cupola::testing {

/// A limit analysis of blocks with hardly compliant joints.
inline Case limit_case(LimitSearch::Parameter parameter, double low, double high, double friction) {
  Case scene = make_case(friction, 1e-8, 0.01);
  scene.analysis.type = AnalysisType::limit;
  scene.analysis.limit.parameter = parameter;
  scene.analysis.limit.low = low;
  scene.analysis.limit.high = high;
  return scene;
}

}  // namespace cupola::testing

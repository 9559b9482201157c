#include "tests/extremes/known_verdicts.hpp"

namespace cupola {

Verdict known_verdict(const std::string& group, const std::string& name) {
  struct Known {
    const char* group;
    const char* name;
    Verdict verdict;
  };
  static const Known list[] = {
      {"motion", "wall of 210 blocks by SPG, 20 iterations a step", Verdict::not_met},
      {"scales", "cubes of 1 mm to 1 km in one stack, the smallest one below", Verdict::not_met},
  };
  for (const Known& known : list)
    if (group == known.group && name == known.name) return known.verdict;
  return Verdict::right;
}

}  // namespace cupola

#pragma once

#include <string>
#include <vector>

#include "assembly/case/case.hpp"

namespace cupola {

struct KeyedTime {
  std::string key;
  const TimeFunction& function;
};

/// The functions of time of a case, which must outlive them; those of supports and loads first.
std::vector<KeyedTime> times_of(const Case& scene);

/// A sentence for each function of time that the analysis leaves out: all but motions and paths take its value
/// at the time 0.
std::vector<std::string> unused_times(const Case& scene);

}  // namespace cupola

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

/// Sentences on the functions of time and the motion of the ground that the analysis leaves out: all but
/// motions and paths take their values at the time 0.
std::vector<std::string> unused_times(const Case& scene);

}  // namespace cupola

#pragma once

#include <string>
#include <vector>

#include "assembly/case/case.hpp"

namespace cupola {

/// Displacement of the ground over time, from that at the time 0, in units of the direction. Reads the file.
TimeFunction ground_time(const BaseMotion& motion);

struct KeyedTime {
  std::string key;
  TimeFunction function;
};

/// The functions of time of a case; those of supports and loads first, that of the ground last.
std::vector<KeyedTime> times_of(const Case& scene);

/// s, default of analysis.duration: long enough to come to rest after the last change.
double default_duration(const Case& scene);

/// True if a motion starts in static equilibrium: base motion, and friction that varies in time, act on a
/// structure that already stands.
bool starts_static(const Case& scene);

/// Sentences on the functions of time and the motion of the ground that the analysis leaves out: all but
/// motions and paths take their values at the time 0.
std::vector<std::string> unused_times(const Case& scene);

/// Sentences on what motions and paths leave out: changes after their end, pulses shorter than a fixed step.
std::vector<std::string> missed_changes(const Case& scene);

}  // namespace cupola

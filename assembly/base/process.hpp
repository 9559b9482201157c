#pragma once

#include <string>

namespace cupola {

/// Version with the git revision compiled in, e.g. "0.1.0 (3f2a9c1)".
std::string program_version();

/// Largest resident memory of this process so far, bytes.
long long peak_memory_bytes();

/// Seconds of a monotonic clock.
double wall_seconds();

/// Seconds of processor time that this process has used so far, its own and the system's for it.
double cpu_seconds();

}  // namespace cupola

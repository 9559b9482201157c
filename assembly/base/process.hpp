#pragma once

#include <cstddef>
#include <string>

namespace cupola {

/// Version and git revision of this build, e.g. "0.3.0-dev (3f2a9c1)".
std::string program_version();

/// Peak resident memory of this process so far, bytes.
long long peak_memory_bytes();

/// Throws std::bad_alloc if so many bytes cannot be allocated now: for libraries that crash where memory ends.
void require_memory(std::size_t bytes);

/// Time of a monotonic clock, s.
double wall_seconds();

/// Processor time used by this process so far, user and system, s.
double cpu_seconds();

}  // namespace cupola

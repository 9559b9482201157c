#pragma once

#include <functional>
#include <string>
#include <string_view>

namespace cupola {

/// Exit codes of every program.
enum class ExitCode { done = 0, failed = 1, bad_input = 2, accuracy_not_reached = 3, interrupted = 4 };

/// Version with the git revision compiled in, e.g. "0.1.0 (3f2a9c1)".
std::string program_version();

/// Runs `body` and turns what it throws into one clear line on stderr and the right exit code: the only try
/// block of each program.
int run_program(std::string_view name, const std::function<ExitCode()>& body);

/// Largest resident memory of this process so far, bytes.
long long peak_memory_bytes();

/// Seconds of a monotonic clock.
double wall_seconds();

/// Seconds of processor time that this process has used so far, its own and the system's for it.
double cpu_seconds();

}  // namespace cupola

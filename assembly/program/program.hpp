#pragma once

#include <functional>
#include <string_view>

namespace cupola {

/// Exit codes of every program.
enum class ExitCode { done = 0, failed = 1, bad_input = 2, accuracy_not_reached = 3, interrupted = 4 };

/// Runs `body`. Turns an exception into one line on stderr and the corresponding exit code; it is the only
/// try block of a program.
int run_program(std::string_view name, const std::function<ExitCode()>& body);

/// Keeps freed memory for the next vectors of that size, as every program does, and backs the first 256 MB by
/// pages of 2 MB. By default glibc returns memory to the system at once, and a solve then spends a third of
/// its time on page faults. release_freed_memory() still returns much memory.
void keep_freed_memory();

}  // namespace cupola

#pragma once

#include <string>
#include <vector>

namespace cupola {

/// Runs a program on the PATH without a shell and waits for it; its output goes to the file `log`. Returns
/// its exit code, or kNotFound if there is no such program. SystemError if the program exists but cannot be
/// started or is ended by a signal, usually for lack of memory.
int run_process(const std::vector<std::string>& words, const std::string& log);

inline constexpr int kNotFound = -1;

std::string last_line(const std::string& text);  ///< last line that is not blank, or ""

}  // namespace cupola

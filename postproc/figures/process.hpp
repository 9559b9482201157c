#pragma once

#include <string>
#include <vector>

namespace cupola {

/// Runs a program found on the PATH, without a shell, and waits for it. What it prints goes to the file
/// `log`. Returns its exit code; 127 when it cannot be started, 128 + n when signal n ended it.
int run_process(const std::vector<std::string>& words, const std::string& log);

inline constexpr int kNotFound = 127;

}  // namespace cupola

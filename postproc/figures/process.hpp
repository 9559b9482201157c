#pragma once

#include <string>
#include <vector>

namespace cupola {

/// Runs a program found on the PATH, without a shell, and waits for it. What it prints goes to the file
/// `log`. Returns its exit code, kNotFound when there is none of that name. SystemError when it cannot be
/// started though it is there, or was ended by a signal: too little memory, as a rule.
int run_process(const std::vector<std::string>& words, const std::string& log);

inline constexpr int kNotFound = -1;

std::string last_line(const std::string& text);  ///< that is not blank; "" where there is none

}  // namespace cupola

#pragma once

#include <functional>
#include <string>

namespace cupola {

/// During its lifetime, iterative solves that take long print where they are. There is at most one.
class IterationLog {
 public:
  /// `print` gets a line for every `interval` seconds that a solve takes, or a little later.
  explicit IterationLog(std::function<void(const std::string&)> print, double interval = 10.0);
  ~IterationLog();
  IterationLog(const IterationLog&) = delete;
  IterationLog& operator=(const IterationLog&) = delete;
};

/// Called in each iteration, with the accuracy reached so far and the tolerance. Not for use in the threads
/// of a team.
void report_iteration(const char* method, int iteration, double accuracy, double tolerance);

}  // namespace cupola

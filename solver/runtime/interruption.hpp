#pragma once

#include <exception>

namespace cupola {

/// During its lifetime the first Ctrl-C or SIGTERM requests the run to stop; the second one kills the
/// program. Analyses look at made() between steps. Long loops inside a step call throw_if_interrupted().
class StopRequest {
 public:
  StopRequest();
  ~StopRequest();
  StopRequest(const StopRequest&) = delete;
  StopRequest& operator=(const StopRequest&) = delete;

  bool made() const;
};

/// During its lifetime, work that takes longer than a number of seconds is abandoned as after a stop request.
/// There is at most one.
class TimeLimit {
 public:
  explicit TimeLimit(double seconds);
  ~TimeLimit();
  TimeLimit(const TimeLimit&) = delete;
  TimeLimit& operator=(const TimeLimit&) = delete;
};

/// Thrown by a solve that is abandoned because the user wants to stop, or because of a time limit.
class Interrupted : public std::exception {
 public:
  const char* what() const noexcept override { return "interrupted"; }
};

/// True if a stop was requested more than a second ago, or after a time limit. A step that ends within that
/// second is completed, so that a motion can be resumed after it.
bool must_abandon() noexcept;

/// Throws Interrupted if must_abandon(). Not for use in the threads of a team, which must not throw.
void throw_if_interrupted();

}  // namespace cupola

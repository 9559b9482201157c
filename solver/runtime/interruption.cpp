#include "solver/runtime/interruption.hpp"

#include <atomic>
#include <csignal>
#include <ctime>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

/// Monotonic time in milliseconds; async-signal-safe.
long long monotonic_milliseconds() noexcept {
  timespec now{};
  clock_gettime(CLOCK_MONOTONIC, &now);
  return 1000LL * now.tv_sec + now.tv_nsec / 1000000;
}

constexpr long long kNever = -1;
std::atomic<long long> time_of_request = kNever, deadline = kNever;
static_assert(std::atomic<long long>::is_always_lock_free);  // as a signal handler requires

/// The second request kills. A terminal or a scheduler signals all processes of a list of runs
/// (assembly/program/batch.hpp), which then passes the signal on: what comes at once is one request.
void request_stop(int signal) {
  constexpr long long kAtOnce = 200;  // ms
  const long long now = monotonic_milliseconds(), before = time_of_request;
  if (before == kNever) {
    time_of_request = now;
  } else if (now - before > kAtOnce) {
    std::signal(signal, SIG_DFL);
    std::raise(signal);  // delivered when this handler returns
  }
}

}  // namespace

StopRequest::StopRequest() {
  time_of_request = kNever;
  std::signal(SIGINT, request_stop);
  std::signal(SIGTERM, request_stop);
}

StopRequest::~StopRequest() {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  time_of_request = kNever;
}

bool StopRequest::made() const {
  return time_of_request != kNever;
}

TimeLimit::TimeLimit(double seconds) {
  CUPOLA_ASSERT(deadline == kNever);
  deadline = monotonic_milliseconds() + static_cast<long long>(1000.0 * seconds);
}

TimeLimit::~TimeLimit() {
  deadline = kNever;
}

bool must_abandon() noexcept {
  constexpr long long kGrace = 1000;  // ms
  const long long requested = time_of_request, last = deadline;
  if (requested == kNever && last == kNever) return false;
  const long long now = monotonic_milliseconds();
  return (requested != kNever && now - requested > kGrace) || (last != kNever && now >= last);
}

void throw_if_interrupted() {
  if (must_abandon()) throw Interrupted();
}

}  // namespace cupola

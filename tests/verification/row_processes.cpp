#include "tests/verification/row_processes.hpp"

#include <algorithm>
#include <atomic>
#include <cstdio>
#include <cstring>
#include <limits>
#include <new>
#include <thread>

#include <sys/mman.h>
#include <sys/wait.h>
#include <unistd.h>

#include "assembly/base/error.hpp"

namespace cupola::verification {
namespace {

constexpr std::size_t kLongestFailure = 1000;  // characters

/// A result in memory that the processes share.
struct SharedResult {
  bool done, passed;
  double computed, error, cpu_seconds;
  char failure[kLongestFailure];
};

struct SharedTasks {
  std::atomic<int> next;
  SharedResult results[1];  ///< (count)
};

SharedTasks* share_tasks(int count) {
  const std::size_t size = sizeof(SharedTasks) + sizeof(SharedResult) * static_cast<std::size_t>(count);
  void* memory = mmap(nullptr, size, PROT_READ | PROT_WRITE, MAP_SHARED | MAP_ANONYMOUS, -1, 0);
  if (memory == MAP_FAILED) throw std::bad_alloc();
  return static_cast<SharedTasks*>(memory);  // zero-initialised
}

void work(SharedTasks* tasks, int count, const std::function<RowResult(int)>& compute) {
  for (int task = tasks->next++; task < count; task = tasks->next++) {
    const RowResult r = compute(task);
    SharedResult& shared = tasks->results[task];
    shared.passed = r.passed;
    shared.computed = r.computed;
    shared.error = r.error;
    shared.cpu_seconds = r.cpu_seconds;
    std::strncpy(shared.failure, r.failure.c_str(), kLongestFailure - 1);
    shared.done = true;
  }
}

}  // namespace

std::vector<RowResult> run_in_processes(int count, const std::function<RowResult(int)>& compute) {
  SharedTasks* tasks = share_tasks(count);
  const auto start_process = [&] {
    std::fflush(stdout);
    const pid_t child = fork();
    if (child < 0) throw SystemError("cannot start a process");
    if (child > 0) return;
    work(tasks, count, compute);
    _exit(0);
  };
  for (unsigned k = 0; k < std::max(1u, std::thread::hardware_concurrency()); ++k) start_process();
  for (int status = 0; waitpid(-1, &status, 0) > 0;)
    if (!(WIFEXITED(status) && WEXITSTATUS(status) == 0) && tasks->next < count) start_process();

  std::vector<RowResult> results;
  for (int task = 0; task < count; ++task) {
    const SharedResult& shared = tasks->results[task];
    const double nan = std::numeric_limits<double>::quiet_NaN();
    if (shared.done)
      results.push_back({shared.computed, shared.error, shared.passed, shared.failure, shared.cpu_seconds});
    else
      results.push_back({nan, nan, false, "the computation ended without a result", 0.0});
  }
  return results;
}

}  // namespace cupola::verification

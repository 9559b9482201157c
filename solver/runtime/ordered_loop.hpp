#pragma once

#include <condition_variable>
#include <mutex>
#include <vector>

#include "solver/runtime/threads.hpp"

namespace cupola {

/// Calls make(i) for i in [0, count) on a team (see run_team), and use(i) one after the other in the order of
/// i: by a thread that has just made one, while the others go on. At most four per thread are made before
/// they are used. Returns false, and begins no further call, when use(i) returns false. When a call throws,
/// none begins either, and the exception of the smallest i is rethrown.
template <class Make, class Use>
bool share_in_order(double work, int count, const Make& make, const Use& use) {
  constexpr int kAhead = 4;
  const int most = kAhead * num_threads();
  std::mutex mutex;
  std::condition_variable progress;
  std::vector<char> made(static_cast<std::size_t>(count));
  int next = 0;  // to be used
  bool in_use = false, ended = false;
  const auto use_made = [&](std::unique_lock<std::mutex>& lock) {
    if (in_use) return;
    in_use = true;
    while (!ended && next < count && made[next]) {
      lock.unlock();
      const bool goes_on = use(next);
      lock.lock();
      ++next;
      ended = ended || !goes_on;
      progress.notify_all();
    }
    in_use = false;
  };
  share_loop(work, count, [&](int i) {
    std::unique_lock lock(mutex);
    progress.wait(lock, [&] { return ended || i < next + most; });
    if (ended) return;
    lock.unlock();
    try {
      make(i);
      lock.lock();
      made[i] = 1;
      use_made(lock);
    } catch (...) {
      if (!lock.owns_lock()) lock.lock();
      ended = true;
      progress.notify_all();
      throw;
    }
  });
  return !ended;
}

}  // namespace cupola

#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>

namespace cupola {

/// A number that threads await the change of: awake for some ten microseconds, as the next change mostly comes
/// within them, then asleep. Without std::atomic::wait and std::barrier, which call sched_yield(): beside
/// other programs on all cores that costs milliseconds.
class Epoch {
 public:
  unsigned now() const { return now_.load(std::memory_order_acquire); }
  void advance() {
    {
      const std::lock_guard lock(mutex_);
      now_.fetch_add(1, std::memory_order_release);
    }
    changed_.notify_all();
  }
  /// Returns when now() is no longer `last`.
  void await(unsigned last) {
    constexpr int kAwake = 500;
    for (int i = 0; i < kAwake; ++i) {
      if (now() != last) return;
      pause();
    }
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return now() != last; });
  }

 private:
  static void pause() {
#if defined(__x86_64__)
    __builtin_ia32_pause();
#endif
  }
  std::atomic<unsigned> now_ = 0;
  std::mutex mutex_;
  std::condition_variable changed_;
};

}  // namespace cupola

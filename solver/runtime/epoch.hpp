#pragma once

#include <atomic>
#include <condition_variable>
#include <mutex>

#include <sys/resource.h>

namespace cupola {

/// A number that threads await the change of: awake for about a tenth of a millisecond, then asleep. (Chosen:
/// with a tenth of it, a motion of 1,296 blocks on two threads takes 7 % longer.) Where other programs share
/// the processors, awake for some ten microseconds only: the change may need the processor of the thread that
/// awaits it. Without std::atomic::wait and std::barrier, which call sched_yield(): beside other programs on
/// all cores that costs milliseconds.
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
    constexpr int kAwake = 5000, kAwakeBesideOthers = 500;
    for (int i = 0, most = beside_others > 0 ? kAwakeBesideOthers : kAwake; i < most; ++i) {
      if (now() != last) return;
      pause();
    }
    note_others();
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [&] { return now() != last; });
  }

 private:
  /// A thread that the system has interrupted for another one shares its processor.
  static void note_others() {
    constexpr int kWaits = 64;  // until it looks again
    if (beside_others > 0 && --beside_others > 0) return;
    static thread_local long interruptions = 0;
    rusage usage{};
    getrusage(RUSAGE_THREAD, &usage);
    if (usage.ru_nivcsw != interruptions) beside_others = kWaits;
    interruptions = usage.ru_nivcsw;
  }
  static void pause() {
#if defined(__x86_64__)
    __builtin_ia32_pause();
#endif
  }
  static inline thread_local int beside_others = 0;  ///< waits in which others are assumed on its processor
  std::atomic<unsigned> now_ = 0;
  std::mutex mutex_;
  std::condition_variable changed_;
};

}  // namespace cupola

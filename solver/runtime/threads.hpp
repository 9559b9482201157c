#pragma once

#include <algorithm>
#include <atomic>
#include <cstdint>
#include <exception>
#include <functional>
#include <utility>
#include <vector>

#include "solver/runtime/workers.hpp"

namespace cupola {

/// Number of threads that contact detection and the contact solvers may use, >= 1; 1 until set. Results do
/// not depend on it.
int num_threads();
void set_num_threads(int count);  ///< throws SystemError if the address space is too small for them

/// A team of threads that run the same program and share its loops.
class Team {
 public:
  explicit Team(int size) : size_(size) {}
  int size() const { return size_; }

  /// Calls body(i) for i in [0, count), distributed dynamically over the threads. Returns when all are done.
  template <class Body>
  void share(int count, const Body& body) {
    const unsigned loop = done_.now();
    for (int i = next_++; i < count; i = next_++) body(i);
    if (++arrived_ < size_) return done_.await(loop);
    next_ = arrived_ = 0;
    done_.advance();
  }

 private:
  std::atomic<int> next_ = 0, arrived_ = 0;
  Epoch done_;
  int size_;
};

/// Runs program(team, thread) on num_threads() threads including the calling one, or only on the calling one
/// if `work` (floating-point operations) is too small for more, or if it belongs to a team already. If the
/// system cannot start that many threads, it uses those that could be started. The program must not throw.
template <class Program>
void run_team(double work, const Program& program) {
  constexpr double kMinWork = 3e5;  // chosen: takes a tenth of a millisecond
  const bool alone = work < kMinWork || inside_team || num_threads() == 1;
  Workers& workers = Workers::of_program();
  const int others = alone ? 0 : workers.take(num_threads() - 1);
  Team team(1 + others);
  const std::function<void(int)> run = [&](int thread) { program(team, thread); };
  if (others > 0) workers.start(run);
  const bool nested = std::exchange(inside_team, inside_team || others > 0);
  run(0);
  inside_team = nested;
  if (others > 0) workers.finish();
}

/// Returns freed memory to the system, if it is more than a little and no other solves use the heap, which
/// all threads share.
void release_freed_memory();

/// Calls body(i) for i in [0, count) on a team (see run_team). If bodies throw, the exception of the smallest
/// i is rethrown when all are done.
template <class Body>
void share_loop(double work, int count, const Body& body) {
  std::vector<std::exception_ptr> thrown(static_cast<std::size_t>(count));
  run_team(work, [&](Team& team, int) {
    team.share(count, [&](int i) {
      try {
        body(i);
      } catch (...) {
        thrown[i] = std::current_exception();
      }
    });
  });
  for (const std::exception_ptr& error : thrown)
    if (error) std::rethrow_exception(error);
}

/// Calls body(first, last) for pieces of [0, count) on a team.
template <class Body>
void share_range(double work, int count, const Body& body) {
  constexpr int kPieces = 64;
  const int pieces = std::min(count, kPieces);
  const auto bound = [&](int k) { return static_cast<int>(std::int64_t{count} * k / pieces); };
  share_loop(work, pieces, [&](int k) { body(bound(k), bound(k + 1)); });
}

/// Calls body(first, last) on every thread of a team, for the range of [0, count) that it owns. A body that
/// visits the terms of sums in order, and adds to the sums of its range only, gives the same bits for any
/// number of threads. It must not throw.
template <class Body>
void share_sums(double work, int count, const Body& body) {
  run_team(work, [&](Team& team, int thread) {
    const auto bound = [&](int k) { return static_cast<int>(std::int64_t{count} * k / team.size()); };
    body(bound(thread), bound(thread + 1));
  });
}

}  // namespace cupola

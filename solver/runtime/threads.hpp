#pragma once

#include <atomic>
#include <barrier>
#include <exception>
#include <latch>
#include <optional>
#include <thread>
#include <vector>

namespace cupola {

/// Threads that the loops of contact detection and of the contact solvers may use, >= 1; 1 until set. Results
/// do not depend on it.
int num_threads();
void set_num_threads(int count);  ///< SystemError where there is no address space for so many

/// A few threads that go through the same program together, loop after loop.
class Team {
 public:
  explicit Team(int size) : barrier_(size, Reset{this}), size_(size) {}
  int size() const { return size_; }

  /// body(i) for i in [0, count), each by whichever thread is free; all wait for the last.
  template <class Body>
  void share(int count, const Body& body) {
    for (int i = next_++; i < count; i = next_++) body(i);
    barrier_.arrive_and_wait();
  }

 private:
  struct Reset {
    Team* team;
    void operator()() const noexcept { team->next_ = 0; }
  };
  std::atomic<int> next_ = 0;
  std::barrier<Reset> barrier_;
  int size_;
};

/// Runs program(team, thread) on num_threads() threads, this one among them, or on this one alone where the
/// work (operations) is not worth a second one; on as many as the system gives where limits of memory and
/// processes stop it on the way. The program must not throw.
template <class Program>
void run_team(double work, const Program& program) {
  constexpr double kWorthATeam = 1e8;  // some hundredths of a second
  const int size = work < kWorthATeam ? 1 : num_threads();
  std::optional<Team> team;
  std::latch complete(1);
  std::vector<std::jthread> others;  // joined before the team goes
  others.reserve(static_cast<std::size_t>(size));
  try {
    for (int thread = 1; thread < size; ++thread)
      others.emplace_back([&program, &team, &complete, thread] {
        complete.wait();
        program(*team, thread);
      });
  } catch (const std::exception&) {  // no thread or no memory for one: those that came do the work
  }
  team.emplace(1 + static_cast<int>(others.size()));
  complete.count_down();
  program(*team, 0);
}

/// Gives back to the system what threads that are gone have freed: each took its memory from a heap of its
/// own.
void release_freed_memory();

/// body(i) for i in [0, count), on as many threads as the work (operations) is worth. Of what the bodies
/// throw the first, by i, is thrown again when all are done.
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

}  // namespace cupola

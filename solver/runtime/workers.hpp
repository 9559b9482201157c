#pragma once

#include <atomic>
#include <functional>
#include <mutex>
#include <thread>
#include <vector>

#include "solver/runtime/epoch.hpp"

namespace cupola {

/// True on the threads of a team (threads.hpp), whose own teams have one thread.
inline thread_local bool inside_team = false;

/// Threads that wait for the work of teams. They start when they are first needed and stay until the program
/// ends, because to start one takes longer than most loops.
class Workers {
 public:
  static Workers& of_program();
  Workers(const Workers&) = delete;
  Workers& operator=(const Workers&) = delete;
  ~Workers();

  /// Takes up to `count` of them: fewer if the system starts no more, none while another thread has taken
  /// them.
  int take(int count);
  /// Calls body(k) for k from 1 to the number taken, each on a worker. The body must not throw.
  void start(const std::function<void(int)>& body);
  /// Returns when these calls have ended, and gives the workers back.
  void finish();

 private:
  Workers() = default;
  void work(int index, unsigned last);

  std::mutex taken_;
  std::vector<std::jthread> threads_;
  // Of the present call; all workers hear of it, those that were not taken do nothing in it.
  Epoch begun_, ended_;
  std::atomic<int> running_ = 0;
  int num_taken_ = 0;
  const std::function<void(int)>* body_ = nullptr;  // none: the program ends
};

}  // namespace cupola

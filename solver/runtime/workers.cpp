#include "solver/runtime/workers.hpp"

#include <algorithm>
#include <exception>

namespace cupola {

Workers& Workers::of_program() {
  static Workers workers;
  return workers;
}

Workers::~Workers() {
  body_ = nullptr;
  begun_.advance();
  threads_.clear();  // waits for their ends
}

int Workers::take(int count) {
  if (!taken_.try_lock()) return 0;
  try {
    while (static_cast<int>(threads_.size()) < count)
      threads_.emplace_back(&Workers::work, this, static_cast<int>(threads_.size()), begun_.now());
  } catch (const std::exception&) {  // no memory or process limit: those started so far do the work
  }
  num_taken_ = std::min(count, static_cast<int>(threads_.size()));
  if (num_taken_ == 0) taken_.unlock();
  return num_taken_;
}

void Workers::start(const std::function<void(int)>& body) {
  body_ = &body;
  running_ = static_cast<int>(threads_.size());
  begun_.advance();
}

void Workers::finish() {
  ended_.await(begun_.now() - 1);
  taken_.unlock();
}

/// `last`: the last call before the worker existed.
void Workers::work(int index, unsigned last) {
  inside_team = true;
  while (true) {
    begun_.await(last++);
    if (body_ == nullptr) return;
    if (index < num_taken_) (*body_)(index + 1);
    if (--running_ == 0) ended_.advance();
  }
}

}  // namespace cupola

#include "solver/contact/threads.hpp"

#include "assembly/error.hpp"

namespace cupola {

namespace {

int count_of_threads = 1;

}  // namespace

int num_threads() {
  return count_of_threads;
}

void set_num_threads(int count) {
  CUPOLA_ASSERT(count >= 1);
  count_of_threads = count;
}

}  // namespace cupola

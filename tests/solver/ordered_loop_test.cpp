#include "solver/runtime/ordered_loop.hpp"

#include <algorithm>
#include <atomic>
#include <chrono>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

namespace cupola::ordered_loop_test {
namespace {

constexpr double kWork = 1e12;  // enough for all threads

/// While it exists there are so many threads.
struct Threads {
  explicit Threads(int count) { set_num_threads(count); }
  ~Threads() { set_num_threads(1); }
  Threads(const Threads&) = delete;
  Threads& operator=(const Threads&) = delete;
};

/// Takes longer for every third i, so that the order of ends differs from that of starts.
void take_a_while(int i) {
  std::this_thread::sleep_for(std::chrono::microseconds(i % 3 == 0 ? 500 : 50));
}

TEST(ShareInOrder, UsesEachInOrderOneAtATime) {
  for (const int count : {1, 3}) {
    const Threads threads(count);
    std::vector<int> used;
    std::atomic<int> using_it = 0, made = 0, most_waiting = 0;
    const bool complete = share_in_order(
        kWork, 100,
        [&](int i) {
          take_a_while(i);
          ++made;
        },
        [&](int i) {
          EXPECT_EQ(++using_it, 1);
          most_waiting = std::max<int>(most_waiting, made - static_cast<int>(used.size()));
          used.push_back(i);
          take_a_while(i);
          --using_it;
          return true;
        });
    EXPECT_TRUE(complete);
    ASSERT_EQ(used.size(), 100U);
    EXPECT_TRUE(std::is_sorted(used.begin(), used.end()));
    EXPECT_LE(most_waiting, 4 * count) << "so many are made before they are used";
  }
}

TEST(ShareInOrder, EndsWhenUseSaysSo) {
  for (const int count : {1, 3}) {
    const Threads threads(count);
    int used = 0;
    std::atomic<int> made = 0;
    EXPECT_FALSE(share_in_order(
        kWork, 1000, [&](int) { ++made; }, [&](int) { return ++used < 5; }));
    EXPECT_EQ(used, 5);
    EXPECT_LE(made, 5 + 4 * count);
  }
}

TEST(ShareInOrder, EndsWithTheFirstExceptionOfMakeOrUse) {
  for (const int count : {1, 3}) {
    const Threads threads(count);
    int used = 0;
    const auto use = [&](int) {
      ++used;
      return true;
    };
    const auto fail_at_seven = [](int i) {
      if (i == 7) throw std::runtime_error("seven");
    };
    EXPECT_THROW(share_in_order(kWork, 1000, fail_at_seven, use), std::runtime_error);
    EXPECT_LE(used, 7);
    std::atomic<int> made = 0;
    EXPECT_THROW(share_in_order(
                     kWork, 1000, [&](int) { ++made; },
                     [&](int i) {
                       fail_at_seven(i);
                       return true;
                     }),
                 std::runtime_error);
    EXPECT_LE(made, 8 + 4 * count);
  }
}

}  // namespace
}  // namespace cupola::ordered_loop_test

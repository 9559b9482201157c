#include "solver/runtime/threads.hpp"

#include <atomic>
#include <chrono>
#include <cmath>
#include <stdexcept>
#include <thread>
#include <vector>

#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "solver/runtime/ordered_sum.hpp"

namespace cupola::threads_test {
namespace {

constexpr double kWork = 1e12;  // enough for all threads

class Teams : public ::testing::Test {
 protected:
  ~Teams() override { set_num_threads(1); }
};

// The workers stay from team to team, through numbers of threads that rise and fall, asleep or awake.
TEST_F(Teams, HaveEachThreadOnce) {
  for (const int size : {1, 3, 2, 8, 2}) {
    set_num_threads(size);
    for (int call = 0; call < 200; ++call) {
      if (call % 50 == 0) std::this_thread::sleep_for(std::chrono::milliseconds(2));  // the workers sleep
      std::vector<std::atomic<int>> calls(size);
      run_team(kWork, [&](Team& team, int thread) {
        if (team.size() == size) ++calls[thread];
      });
      for (const std::atomic<int>& n : calls) EXPECT_EQ(n, 1) << size << " threads";
    }
  }
}

TEST_F(Teams, ShareOneLoopAfterAnother) {
  constexpr int kLoops = 50, kCount = 30;
  set_num_threads(3);
  std::vector<std::atomic<int>> calls(kCount);
  run_team(kWork, [&](Team& team, int) {
    for (int loop = 0; loop < kLoops; ++loop) team.share(kCount, [&](int i) { ++calls[i]; });
  });
  for (const std::atomic<int>& n : calls) EXPECT_EQ(n, kLoops);
}

TEST_F(Teams, AreOfOneThreadInsideAnotherAndForLittleWork) {
  set_num_threads(3);
  std::atomic<int> inside = 0;
  run_team(kWork, [&](Team&, int) { run_team(kWork, [&](Team& team, int) { inside += team.size(); }); });
  EXPECT_EQ(inside, 3) << "one thread for each of three";
  run_team(1.0, [&](Team& team, int) { EXPECT_EQ(team.size(), 1); });
  run_team(kWork, [&](Team& team, int) { EXPECT_EQ(team.size(), 3); });
}

TEST_F(Teams, OfTwoThreadsAtOnceEndBoth) {
  set_num_threads(4);
  std::atomic<int> sum = 0;
  const auto add = [&] {
    for (int call = 0; call < 100; ++call) share_loop(kWork, 100, [&](int i) { sum += i; });
  };
  { const std::jthread first(add), second(add); }
  EXPECT_EQ(sum, 2 * 100 * 4950);
}

TEST_F(Teams, SumInOrder) {
  constexpr int kTerms = 10007;
  const auto term = [](int i) { return std::sin(1.0 + i) * std::pow(10.0, i % 17); };
  double expected = 0.1;
  for (int i = 0; i < kTerms; ++i) expected += term(i);
  for (const int threads : {1, 2, 3, 8}) {
    set_num_threads(threads);
    EXPECT_EQ(sum_in_order(kWork, kTerms, 0.1, term), expected) << threads << " threads: not the same bits";
  }
}

TEST_F(Teams, WorkAgainAfterAnException) {
  set_num_threads(3);
  for (int call = 0; call < 20; ++call) {
    EXPECT_THROW(share_loop(kWork, 10, [](int i) { i == 7 ? throw std::runtime_error("7") : void(); }),
                 std::runtime_error);
    std::atomic<int> count = 0;
    share_range(kWork, 1000, [&](int first, int last) { count += last - first; });
    EXPECT_EQ(count, 1000);
  }
}

TEST(ShareLoop, RethrowsTheExceptionOfTheSmallestIndex) {
  set_num_threads(3);
  try {
    share_loop(1e12, 100, [](int i) {
      if (i % 10 == 7) throw InputError(std::to_string(i));
    });
    ADD_FAILURE() << "nothing was thrown";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find('7'), std::string::npos);
    EXPECT_EQ(std::string(error.what()).find("17"), std::string::npos);
  }
  set_num_threads(1);
}

}  // namespace
}  // namespace cupola::threads_test

#include "solver/runtime/run_control.hpp"

#include <cmath>
#include <cstdio>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/base/process.hpp"

namespace cupola {

void ProgressBar::show(double share, const std::string& state) {
  CUPOLA_ASSERT(share >= 0.0 && share <= 1.0);
  constexpr int kWidth = 20;
  constexpr double kInterval = 0.2;  // s
  const double now = wall_seconds();
  if (first_share_ < 0.0) {
    first_share_ = share;
    first_time_ = now;
  }
  if (share < 1.0 && now - last_time_ < kInterval) return;
  last_time_ = now;
  const int filled = static_cast<int>(std::floor(share * kWidth));
  const double done = share - first_share_;
  const std::string left =
      done > 0.0 ? format_duration((now - first_time_) * (1.0 - share) / done) + " left" : "";
  constexpr const char* kClearToEnd = "\033[K";
  fmt::print("\r[{:<{}}] {:3.0f} %  {}  {}{}", std::string(static_cast<std::size_t>(filled), '#'), kWidth,
             100.0 * share, state, left, kClearToEnd);
  std::fflush(stdout);
  shown_ = true;
}

void ProgressBar::show(const std::string& state) {
  constexpr double kInterval = 0.2;  // s
  constexpr size_t kWidth = 110;     // characters, which fit one line of most terminals
  const double now = wall_seconds();
  if (now - last_time_ < kInterval) return;
  last_time_ = now;
  fmt::print("\r{}\033[K", state.substr(0, kWidth));
  std::fflush(stdout);
  shown_ = true;
}

void ProgressBar::finish() {
  if (shown_) fmt::print("\n");
  shown_ = false;
}

std::string format_duration(double seconds) {
  const auto total = static_cast<long long>(std::llround(seconds));
  const long long hours = total / 3600, minutes = total / 60 % 60;
  return hours > 0 ? fmt::format("{}:{:02}:{:02}", hours, minutes, total % 60)
                   : fmt::format("{}:{:02}", minutes, total % 60);
}

}  // namespace cupola

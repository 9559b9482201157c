#pragma once

#include <cmath>
#include <cstdint>
#include <random>

namespace cupola {

/// Random numbers that do not depend on the standard library's distributions.
class Dice {
 public:
  explicit Dice(std::uint64_t seed) : engine_(seed) {}
  double uniform(double low, double high) {
    return low + (high - low) * 0x1p-64 * static_cast<double>(engine_());
  }
  double log_uniform(double low, double high) { return std::exp(uniform(std::log(low), std::log(high))); }
  int integer(int low, int high) { return low + static_cast<int>(uniform(0.0, high - low + 1.0 - 1e-9)); }
  bool chance(double p) { return uniform(0.0, 1.0) < p; }

 private:
  std::mt19937_64 engine_;
};

}  // namespace cupola

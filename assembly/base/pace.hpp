#pragma once

#include "assembly/base/process.hpp"

namespace cupola {

/// Paces work that is repeated during a run, such as saving its state: it is due again after a hundred times
/// as long as it took, so that it takes at most a hundredth of the run.
class Pace {
 public:
  bool is_due() const { return wall_seconds() >= next_; }
  template <class Work>
  void run(const Work& work) {
    constexpr double kRest = 100.0;
    const double started = wall_seconds();
    work();
    const double ended = wall_seconds();
    next_ = ended + kRest * (ended - started);
  }

 private:
  double next_ = 0.0;  // s
};

}  // namespace cupola

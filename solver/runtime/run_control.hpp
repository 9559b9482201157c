#pragma once

#include <string>

namespace cupola {

/// A progress bar with the remaining time on one terminal line, updated at most five times per second.
class ProgressBar {
 public:
  /// `share`: completed fraction in [0, 1]. The remaining time is extrapolated from the progress since the
  /// first call. `state`: where the run is, in words.
  void show(double share, const std::string& state);
  /// A line in place of the last one, for a run that does not know how much is left.
  void show(const std::string& state);
  /// Ends the line.
  void finish();

 private:
  double first_share_ = -1.0;
  double first_time_ = 0.0;
  double last_time_ = 0.0;
  bool shown_ = false;
};

/// "1:02:03" or "2:03".
std::string format_duration(double seconds);

}  // namespace cupola

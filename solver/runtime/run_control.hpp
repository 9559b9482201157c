#pragma once

#include <string>

namespace cupola {

/// While it lives, Ctrl-C and SIGTERM ask the run to stop instead of killing it; a second one kills.
class StopRequest {
 public:
  StopRequest();
  ~StopRequest();
  StopRequest(const StopRequest&) = delete;
  StopRequest& operator=(const StopRequest&) = delete;

  bool made() const;
};

/// A bar on one terminal line with the time left, rewritten at most five times a second.
class ProgressBar {
 public:
  /// `share`: done in [0, 1]. The time left follows from the share done since the first call.
  void show(double share);
  /// Ends the line.
  void finish();

 private:
  double first_share_ = -1.0;
  double first_time_ = 0.0;
  double last_time_ = 0.0;
  bool shown_ = false;
};

/// Whether a person watches stdout.
bool stdout_is_terminal();

/// "1:02:03" or "2:03".
std::string format_duration(double seconds);

}  // namespace cupola

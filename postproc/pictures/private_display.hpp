#pragma once

#include <string>

#include <sys/types.h>

namespace cupola {

/// An X server without a screen (Xvfb) for this process alone. Debian's VTK draws into X windows only.
class PrivateDisplay {
 public:
  /// Starts the server and waits until it is ready.
  PrivateDisplay();
  ~PrivateDisplay();  ///< ends the server
  PrivateDisplay(const PrivateDisplay&) = delete;
  PrivateDisplay& operator=(const PrivateDisplay&) = delete;

  const std::string& name() const { return name_; }        ///< for DISPLAY: ":17"; "" without a server
  const std::string& problem() const { return problem_; }  ///< why there is no server

 private:
  pid_t server_ = 0;
  std::string name_, problem_;
};

}  // namespace cupola

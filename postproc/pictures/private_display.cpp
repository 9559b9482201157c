#include "postproc/pictures/private_display.hpp"

#include <array>
#include <cerrno>
#include <csignal>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <poll.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

namespace cupola {
namespace {

/// The line that the server writes when it is ready; "" if it ends, or is not ready in time.
std::string first_line_of(int file) {
  constexpr int kMostMilliseconds = 20'000;
  std::string line;
  pollfd waiting{file, POLLIN, 0};
  while (line.find('\n') == std::string::npos && ::poll(&waiting, 1, kMostMilliseconds) > 0) {
    std::array<char, 32> bytes{};
    const ssize_t count = ::read(file, bytes.data(), bytes.size());
    if (count <= 0) return "";
    line.append(bytes.data(), static_cast<size_t>(count));
  }
  return line.substr(0, line.find('\n'));
}

}  // namespace

PrivateDisplay::PrivateDisplay() {
  constexpr int kNumberFile = 3;  // in the server
  std::array<int, 2> ends{};
  if (::pipe2(ends.data(), O_CLOEXEC) != 0) {
    problem_ = fmt::format("no pipe to Xvfb: {}", std::strerror(errno));
    return;
  }
  std::array words{std::string("Xvfb"),      std::string("-displayfd"), std::string("3"),
                   std::string("-screen"),   std::string("0"),          std::string("1280x1024x24"),
                   std::string("-nolisten"), std::string("tcp"),        std::string("-noreset")};
  std::array<char*, words.size() + 1> arguments{};
  for (size_t i = 0; i < words.size(); ++i) arguments[i] = words[i].data();
  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_adddup2(&actions, ends[1], kNumberFile);
  for (const int output : {1, 2})
    posix_spawn_file_actions_addopen(&actions, output, "/dev/null", O_WRONLY, 0);
  const int error = posix_spawnp(&server_, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  ::close(ends[1]);
  if (error != 0) {
    server_ = 0;
    problem_ = error == ENOENT ? "Xvfb is not installed (Debian: apt install xvfb libgl1-mesa-dri)"
                               : fmt::format("Xvfb cannot be started: {}", std::strerror(error));
  } else if (const std::string number = first_line_of(ends[0]); !number.empty()) {
    name_ = ":" + number;
  } else {
    problem_ = "Xvfb did not start";
  }
  ::close(ends[0]);
}

PrivateDisplay::~PrivateDisplay() {
  if (server_ == 0) return;
  ::kill(server_, SIGTERM);
  ::waitpid(server_, nullptr, 0);
}

}  // namespace cupola

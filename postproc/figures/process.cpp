#include "postproc/figures/process.hpp"

#include <cerrno>
#include <cstring>

#include <fcntl.h>
#include <fmt/format.h>
#include <spawn.h>
#include <sys/wait.h>
#include <unistd.h>

#include "assembly/base/error.hpp"
#include "assembly/files/atomic_file.hpp"

namespace cupola {

std::string last_line(const std::string& text) {
  const size_t end = text.find_last_not_of(" \t\n");
  if (end == std::string::npos) return "";
  const size_t before = text.rfind('\n', end), start = before == std::string::npos ? 0 : before + 1;
  return text.substr(start, end + 1 - start);
}

int run_process(const std::vector<std::string>& words, const std::string& log) {
  std::vector<std::string> copies = words;
  std::vector<char*> arguments;
  for (std::string& word : copies) arguments.push_back(word.data());
  arguments.push_back(nullptr);

  posix_spawn_file_actions_t actions;
  posix_spawn_file_actions_init(&actions);
  posix_spawn_file_actions_addopen(&actions, 1, log.c_str(), O_WRONLY | O_CREAT | O_TRUNC, 0644);
  posix_spawn_file_actions_adddup2(&actions, 1, 2);
  pid_t child = 0;
  const int error = posix_spawnp(&child, arguments[0], &actions, nullptr, arguments.data(), environ);
  posix_spawn_file_actions_destroy(&actions);
  if (error == ENOENT) return kNotFound;
  if (error != 0) throw SystemError(fmt::format("{}: cannot be started: {}", words[0], std::strerror(error)));
  int status = 0;
  if (waitpid(child, &status, 0) != child)
    throw SystemError(fmt::format("{}: waiting for it failed: {}", words[0], std::strerror(errno)));
  if (WIFSIGNALED(status))
    throw SystemError(
        fmt::format("{}: ended by signal {}, as happens when memory runs out", words[0], WTERMSIG(status)));
  constexpr int kNotLoaded = 127;  // exit code of the loader if memory or a library is missing
  if (WEXITSTATUS(status) == kNotLoaded)
    throw SystemError(fmt::format("{}: cannot be loaded, memory or a library is missing: {}", words[0],
                                  last_line(read_text(log))));
  return WEXITSTATUS(status);
}

}  // namespace cupola

#include "assembly/program/batch.hpp"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <filesystem>
#include <sstream>
#include <string>
#include <vector>

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include "assembly/base/error.hpp"
#include "assembly/files/atomic_file.hpp"

namespace cupola {
namespace {

/// One line of the list.
struct BatchRun {
  std::string stamp, needed;
  std::vector<std::string> arguments;
};

std::vector<BatchRun> read_batch(const std::string& path) {
  std::vector<BatchRun> runs;
  std::istringstream lines(read_text(path));
  std::string line;
  for (int number = 1; std::getline(lines, line); ++number) {
    BatchRun run;
    std::istringstream words(line);
    words >> run.stamp >> run.needed;
    for (std::string word; words >> word;) run.arguments.push_back(word);
    if (run.arguments.empty())
      throw InputError({path, number, 1}, "expected STAMP NEEDED ARGUMENTS..., separated by blanks");
    runs.push_back(std::move(run));
  }
  return runs;
}

volatile std::sig_atomic_t stopped_by = 0;
volatile pid_t running = 0;

/// Passes the signal to the run, which ends as if it were alone.
void pass_on(int signal) {
  stopped_by = signal;
  if (running > 0) kill(running, signal);
}

/// The part of the run in the child process. Does not return.
[[noreturn]] void run_child(std::string_view name, const std::string& errors, const PreparedRun& run,
                            const std::exception_ptr& error) {
  std::signal(SIGINT, SIG_DFL);
  std::signal(SIGTERM, SIG_DFL);
  prctl(PR_SET_PDEATHSIG, SIGTERM);  // a list that is killed ends its run, too
  const int file = open(errors.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
  if (file >= 0) dup2(file, STDERR_FILENO);
  const int code = run_program(name, [&] {
    if (error) std::rethrow_exception(error);
    return run();
  });
  std::fflush(stdout);
  std::_Exit(code);
}

/// Exit code of the run, which is reported.
int run_in_child(std::string_view name, const BatchRun& batch, const Prepare& prepare) {
  std::vector<std::string> words = {std::string(name)};
  words.insert(words.end(), batch.arguments.begin(), batch.arguments.end());
  std::vector<char*> argv;
  for (std::string& word : words) argv.push_back(word.data());
  argv.push_back(nullptr);
  PreparedRun run;
  std::exception_ptr error;
  try {
    run = prepare(static_cast<int>(words.size()), argv.data());
  } catch (...) {
    error = std::current_exception();
  }
  const std::string errors = (std::filesystem::path(batch.stamp).parent_path() / "errors.txt").string();
  std::fflush(stdout);
  std::fflush(stderr);
  const pid_t child = fork();
  if (child < 0) throw SystemError(fmt::format("cannot start a process: {}", std::strerror(errno)));
  if (child == 0) run_child(name, errors, run, error);
  running = child;
  if (stopped_by != 0) kill(child, stopped_by);
  int status = 0;
  while (waitpid(child, &status, 0) < 0 && errno == EINTR) {
  }
  running = 0;
  const int code = WIFEXITED(status) ? WEXITSTATUS(status) : static_cast<int>(ExitCode::failed);
  std::string text = read_text(errors);
  if (WIFSIGNALED(status) && stopped_by == 0) {
    text += fmt::format("{}: error: ended by signal {}\n", name, WTERMSIG(status));
    write_text_atomically(errors, text);
  }
  std::fputs(text.c_str(), stderr);
  return code;
}

}  // namespace

int run_program(std::string_view name, int argc, char** argv, const Prepare& prepare) {
  if (argc != 3 || std::strcmp(argv[1], "--batch") != 0)
    return run_program(name, [&] { return prepare(argc, argv)(); });
  return run_program(name, [&] {
    const std::vector<BatchRun> runs = read_batch(argv[2]);
    std::signal(SIGINT, pass_on);
    std::signal(SIGTERM, pass_on);
    int first_failure = 0;
    for (const BatchRun& batch : runs) {
      if (batch.needed != "-" && !std::filesystem::exists(batch.needed)) continue;
      fmt::print("{} {}\n", name, fmt::join(batch.arguments, " "));
      const int code = run_in_child(name, batch, prepare);
      if (code == 0 || code == static_cast<int>(ExitCode::accuracy_not_reached))
        write_text_atomically(batch.stamp, fmt::format("{}\n", code));
      else if (first_failure == 0)
        first_failure = code;
      if (stopped_by != 0) return ExitCode::interrupted;
    }
    return static_cast<ExitCode>(first_failure);
  });
}

}  // namespace cupola

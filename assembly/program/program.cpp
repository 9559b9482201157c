#include "assembly/program/program.hpp"

#include <cerrno>
#include <csignal>
#include <cstdio>
#include <cstring>
#include <exception>
#include <new>
#include <string>

#include <fmt/format.h>
#include <malloc.h>

#include "assembly/base/error.hpp"
#include "assembly/program/terminal.hpp"

namespace cupola {

void keep_freed_memory() {
#ifdef __GLIBC__
  mallopt(M_TRIM_THRESHOLD, 256 << 20);
  mallopt(M_TOP_PAD, 4 << 20);
  mallopt(M_MMAP_THRESHOLD, 64 << 20);
#endif
}

int run_program(std::string_view name, const std::function<ExitCode()>& body) {
  const auto report = [&name](std::string message) {
    std::fflush(stdout);
    const std::string word = "error:";
    if (const size_t at = message.find(word); at != std::string::npos)
      message.replace(at, word.size(), in_colour(word, Colour::red, stderr));
    std::fprintf(stderr, "%.*s: %s\n", static_cast<int>(name.size()), name.data(), message.c_str());
  };
  keep_freed_memory();
  // A file above `ulimit -f` then fails to be written, like one on a full disk.
  std::signal(SIGXFSZ, SIG_IGN);
  try {
    const ExitCode code = body();
    if (std::fflush(stdout) != 0 || std::ferror(stdout) != 0)
      throw SystemError(fmt::format("standard output: cannot be written: {}", std::strerror(errno)));
    return static_cast<int>(code);
  } catch (const InputError& error) {
    report(error.what());
    return static_cast<int>(ExitCode::bad_input);
  } catch (const std::bad_alloc&) {
    report("error: out of memory");
  } catch (const std::exception& error) {
    report(std::string("error: ") + error.what());
  }
  return static_cast<int>(ExitCode::failed);
}

}  // namespace cupola

#include "assembly/program/program.hpp"

#include <cerrno>
#include <csignal>
#include <cstdint>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <limits>
#include <new>
#include <string>

#include <fmt/format.h>
#include <malloc.h>
#include <sys/mman.h>
#include <sys/resource.h>
#include <unistd.h>

#include "assembly/base/error.hpp"
#include "assembly/program/terminal.hpp"

namespace cupola {
namespace {

// Sanitizers have an allocator of their own.
#if defined(__GLIBC__) && !defined(CUPOLA_SANITIZED)
constexpr int kReserve = 256 << 20;  // bytes of address space
constexpr int kKept = 768 << 20;     // bytes of freed memory

bool is_unlimited(decltype(RLIMIT_AS) resource) {
  rlimit limit{};
  return getrlimit(resource, &limit) == 0 && limit.rlim_cur == RLIM_INFINITY;
}

/// Grows the heap by address space that nothing uses yet and advises the kernel to fill it with pages of 2 MB,
/// which many systems do on request only. Where the heap grows later, the kernel gets no advice.
void reserve_large_pages() {
  void* const chunk = std::malloc(kReserve);
  if (chunk == nullptr) return;
  const auto page = static_cast<std::uintptr_t>(sysconf(_SC_PAGESIZE));
  const auto begin = (reinterpret_cast<std::uintptr_t>(chunk) + page - 1) / page * page;
  madvise(reinterpret_cast<void*>(begin), kReserve - page, MADV_HUGEPAGE);
  std::free(chunk);
}
#endif

}  // namespace

void keep_freed_memory() {
#if defined(__GLIBC__) && !defined(CUPOLA_SANITIZED)
  constexpr int kMost = std::numeric_limits<int>::max();
  const bool reserve = is_unlimited(RLIMIT_AS) && is_unlimited(RLIMIT_DATA);
  mallopt(M_TRIM_THRESHOLD, kMost);
  mallopt(M_MMAP_THRESHOLD, kMost);
  if (reserve) reserve_large_pages();
  mallopt(M_TRIM_THRESHOLD, (reserve ? kReserve : 0) + kKept);
  mallopt(M_TOP_PAD, 4 << 20);
  mallopt(M_MMAP_THRESHOLD, 1 << 30);  // beyond it a vector gets fresh pages each time
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

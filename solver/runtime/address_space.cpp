// Checks, before OpenBLAS is initialised, that the address space is large enough for it.
//
// OpenBLAS maps a buffer for every thread that it may start, before main. If the mapping fails because the
// address space is limited (`ulimit -v`, batch systems), OpenBLAS 0.3.21 retries forever. This check exits
// with an error instead.
//
// Only functions in .preinit_array run before the constructors of the libraries, and only executables have
// that section. This file therefore belongs to the program, not to the library. The C library is not
// initialised yet: no allocation, no getenv.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>

#include <sched.h>
#include <sys/mman.h>
#include <unistd.h>

namespace {

constexpr std::size_t kBuffer = 128U << 20U;   // bytes per thread, measured by strace (Debian 12, x86-64)
constexpr std::size_t kOverhead = 16U << 20U;  // bytes, stack and alignment of a thread
constexpr int kMaxThreads = 128;               // compile-time limit of Debian's OpenBLAS

/// Value of the environment variable `name_equals` ("NAME="); 0 if it is unset or not a positive number.
int positive_variable(char** environment, const char* name_equals) {
  const std::size_t length = std::strlen(name_equals);
  for (char** entry = environment; *entry != nullptr; ++entry)
    if (std::strncmp(*entry, name_equals, length) == 0) return std::max(0, std::atoi(*entry + length));
  return 0;
}

/// The number of threads that OpenBLAS prepares for: one per processor, or fewer if a variable sets that.
int num_blas_threads(char** environment) {
  cpu_set_t processors;
  CPU_ZERO(&processors);
  const int num_processors =
      sched_getaffinity(0, sizeof processors, &processors) == 0 ? CPU_COUNT(&processors) : 1;
  const int threads = std::min(num_processors, kMaxThreads);
  for (const char* name : {"OPENBLAS_NUM_THREADS=", "GOTO_NUM_THREADS=", "OMP_NUM_THREADS="})
    if (const int limit = positive_variable(environment, name); limit > 0) return std::min(threads, limit);
  return threads;
}

void refuse_too_little_address_space(int /*argc*/, char** /*argv*/, char** environment) {
  std::array<void*, kMaxThreads> probes{};
  const int threads = num_blas_threads(environment);
  int got = 0;
  while (got < threads) {
    void* probe =
        mmap(nullptr, kBuffer + kOverhead, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (probe == MAP_FAILED) break;
    probes[got++] = probe;
  }
  for (int i = 0; i < got; ++i) munmap(probes[i], kBuffer + kOverhead);
  if (got == threads) return;
  constexpr char kText[] =
      "cupola-solve: error: out of memory: OpenBLAS requires 144 MB of address space per thread; "
      "raise the limit (ulimit -v) or set OPENBLAS_NUM_THREADS=1\n";
  if (write(STDERR_FILENO, kText, sizeof kText - 1) < 0) _exit(1);
  _exit(1);
}

using Initialiser = void (*)(int, char**, char**);
[[gnu::section(".preinit_array"), gnu::used]] const Initialiser kBeforeLibraries =
    refuse_too_little_address_space;

}  // namespace

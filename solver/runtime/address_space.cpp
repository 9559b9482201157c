// Asks for the memory that OpenBLAS takes as the program is loaded, before OpenBLAS does.
//
// OpenBLAS maps a buffer for every thread that it may start, before main. Where the address space is limited
// (`ulimit -v`, batch systems) and the mapping fails, OpenBLAS 0.3.21 tries again for ever. So the program
// refuses here. Only what runs from .preinit_array comes before the constructors of the libraries, and only
// an executable has one: this file belongs to the program, not to the library. The C library is not set up
// yet: no allocation, no getenv.
#include <algorithm>
#include <array>
#include <cstdlib>
#include <cstring>

#include <sched.h>
#include <sys/mman.h>
#include <unistd.h>

namespace {

// Measured by strace (Debian 12, x86-64), and what the stack and the alignment of a thread take beside it.
constexpr std::size_t kBuffer = 128U << 20U;
constexpr std::size_t kBeside = 16U << 20U;
constexpr int kMostThreads = 128;  // that Debian's OpenBLAS is built for

/// Value of a variable NAME=, 0 when it is absent or no positive number.
int positive_variable(char** environment, const char* name_equals) {
  const std::size_t length = std::strlen(name_equals);
  for (char** entry = environment; *entry != nullptr; ++entry)
    if (std::strncmp(*entry, name_equals, length) == 0) return std::max(0, std::atoi(*entry + length));
  return 0;
}

/// As OpenBLAS counts them: one per processor, unless a variable says fewer.
int num_blas_threads(char** environment) {
  cpu_set_t processors;
  CPU_ZERO(&processors);
  const int all = sched_getaffinity(0, sizeof processors, &processors) == 0 ? CPU_COUNT(&processors) : 1;
  int threads = std::min(all, kMostThreads);
  for (const char* name : {"OPENBLAS_NUM_THREADS=", "GOTO_NUM_THREADS=", "OMP_NUM_THREADS="})
    if (const int asked = positive_variable(environment, name); asked > 0) return std::min(threads, asked);
  return threads;
}

void refuse_too_little_address_space(int /*argc*/, char** /*argv*/, char** environment) {
  std::array<void*, kMostThreads> probes{};
  const int threads = num_blas_threads(environment);
  int got = 0;
  while (got < threads) {
    void* probe =
        mmap(nullptr, kBuffer + kBeside, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (probe == MAP_FAILED) break;
    probes[got++] = probe;
  }
  for (int i = 0; i < got; ++i) munmap(probes[i], kBuffer + kBeside);
  if (got == threads) return;
  constexpr char kText[] =
      "cupola-solve: error: out of memory: OpenBLAS needs 144 MB of address space for each of its threads; "
      "raise "
      "the limit (ulimit -v) or set OPENBLAS_NUM_THREADS=1\n";
  if (write(STDERR_FILENO, kText, sizeof kText - 1) < 0) _exit(1);
  _exit(1);
}

using Initialiser = void (*)(int, char**, char**);
[[gnu::section(".preinit_array"), gnu::used]] const Initialiser kBeforeLibraries =
    refuse_too_little_address_space;

}  // namespace

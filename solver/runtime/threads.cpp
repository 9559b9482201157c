#include "solver/runtime/threads.hpp"

#include <vector>

#include <fmt/format.h>
#include <malloc.h>
#include <sys/mman.h>

#include "assembly/base/counted.hpp"
#include "assembly/base/error.hpp"

extern "C" void dpotrf_(const char* uplo, const int* n, double* a, const int* lda, int* info);

namespace cupola {

namespace {

int count_of_threads = 1;

/// OpenBLAS maps a buffer for every thread that calls it, and retries forever if the mapping fails.
bool has_room_for_blas(int threads) {
  constexpr std::size_t kEach = 144U << 20U;  // bytes: 128 MB buffer, stack and alignment of a thread
  std::vector<void*> probes;
  while (static_cast<int>(probes.size()) < threads) {
    void* probe = mmap(nullptr, kEach, PROT_READ | PROT_WRITE, MAP_PRIVATE | MAP_ANONYMOUS, -1, 0);
    if (probe == MAP_FAILED) break;
    probes.push_back(probe);
  }
  for (void* probe : probes) munmap(probe, kEach);
  return static_cast<int>(probes.size()) == threads;
}

/// Makes OpenBLAS map the buffer of this thread while there is room: a call that needs one and costs nothing.
void claim_blas_buffer() {
  const int one = 1;
  double a = 1.0;
  int info = 0;
  dpotrf_("L", &one, &a, &one, &info);
}

}  // namespace

int num_threads() {
  return count_of_threads;
}

void release_freed_memory() {
#ifdef __GLIBC__
  if (inside_team) return;  // others use it
  // Little memory is not worth the page faults of its next use. The top of the main heap is reused by all.
  constexpr std::size_t kLittle = 64U << 20U, kTop = 64U << 20U;  // bytes
  const struct mallinfo2 heap = mallinfo2();
  if (heap.fordblks - heap.keepcost > kLittle) malloc_trim(kTop);
#endif
}

void set_num_threads(int count) {
  CUPOLA_ASSERT(count >= 1);
  if (!has_room_for_blas(count))
    throw SystemError(
        fmt::format("out of memory: {} MB of address space required for {}; raise the limit (ulimit -v){}",
                    144 * count, counted(count, "thread"), count > 1 ? " or use fewer threads" : ""));
  claim_blas_buffer();
#ifdef __GLIBC__
  // One heap for all threads: that of the program, whose freed memory is kept, on large pages. The heaps that
  // threads get otherwise return theirs to the system again and again: staged runs took a third more time.
  if (count > 1) mallopt(M_ARENA_MAX, 1);
#endif
  count_of_threads = count;
}

}  // namespace cupola

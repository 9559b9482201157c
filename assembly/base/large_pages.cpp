// Puts large arrays on pages of 2 MB wherever they lie. keep_freed_memory() does so for the first
// 256 MB of the heap only. Sanitizers have an operator new of their own.
#if defined(__linux__) && !defined(CUPOLA_SANITIZED)

#include <cerrno>
#include <cstdint>
#include <cstdlib>
#include <new>

#include <sys/mman.h>

namespace {

constexpr std::size_t kLargeArray = 4U << 20U;    // bytes
constexpr std::uintptr_t kLargePage = 2U << 20U;  // bytes

/// A kernel without such pages refuses, which changes nothing.
void ask_for_large_pages(const void* array, std::size_t size) {
  const auto start = reinterpret_cast<std::uintptr_t>(array);
  const std::uintptr_t first = (start + kLargePage - 1) / kLargePage * kLargePage;
  const std::uintptr_t end = (start + size) / kLargePage * kLargePage;
  const int before = errno;
  if (first < end) madvise(reinterpret_cast<void*>(first), end - first, MADV_HUGEPAGE);
  errno = before;
}

}  // namespace

void* operator new(std::size_t size) {
  void* array = std::malloc(size > 0 ? size : 1);
  while (array == nullptr) {
    const std::new_handler handler = std::get_new_handler();
    if (handler == nullptr) throw std::bad_alloc();
    handler();
    array = std::malloc(size > 0 ? size : 1);
  }
  if (size >= kLargeArray) ask_for_large_pages(array, size);
  return array;
}

void operator delete(void* array) noexcept {
  std::free(array);
}

void operator delete(void* array, std::size_t) noexcept {
  std::free(array);
}

#endif

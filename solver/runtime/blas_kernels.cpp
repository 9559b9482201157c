#include "solver/runtime/blas_kernels.hpp"

#include <cstdlib>
#include <string_view>

#include <unistd.h>

extern "C" char* openblas_get_corename();

namespace cupola {

void use_kernels_of_processor(char** argv) {
#ifdef __x86_64__
  // OpenBLAS chooses when it is loaded, from a list of processors that is older than many a processor.
  constexpr const char* kChoice = "OPENBLAS_CORETYPE";
  constexpr std::string_view kOfAnyProcessor = "Prescott";
  if (std::getenv(kChoice) || openblas_get_corename() != kOfAnyProcessor) return;
  if (!__builtin_cpu_supports("avx2") || !__builtin_cpu_supports("fma")) return;
  setenv(kChoice, "Haswell", 1);
  execv("/proc/self/exe", argv);  // returns only if it fails: slower, but right
#else
  static_cast<void>(argv);
#endif
}

}  // namespace cupola

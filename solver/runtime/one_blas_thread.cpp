// Keeps OpenBLAS from starting threads when the program is loaded.
//
// OpenBLAS starts a thread for every processor but one, before main. The solver calls it with one thread per
// call only, and the idle threads spin: they took a quarter of the processor time of a run of 1,300 blocks.
// No function of OpenBLAS comes early enough to prevent that. OpenBLAS counts the processors that the process
// may use: while the libraries are initialised, that is one, and then those that it was given again.
//
// Only functions in .preinit_array run before the constructors of the libraries, and only executables have
// that section. This file therefore belongs to the program, not to the library. The C library is not
// initialised yet: no allocation, no getenv.
#include <sched.h>

namespace {

cpu_set_t given_processors;
bool restricted = false;  // false too if the system refuses: OpenBLAS then starts its threads

void use_one_processor() {
  const int current = sched_getcpu();
  if (current < 0 || sched_getaffinity(0, sizeof given_processors, &given_processors) != 0) return;
  cpu_set_t one;
  CPU_ZERO(&one);
  CPU_SET(current, &one);
  restricted = sched_setaffinity(0, sizeof one, &one) == 0;
}

/// Runs after the constructors of all libraries.
[[gnu::constructor]] void use_given_processors() {
  if (restricted) sched_setaffinity(0, sizeof given_processors, &given_processors);
}

using Initialiser = void (*)();
[[gnu::section(".preinit_array"), gnu::used]] const Initialiser kBeforeLibraries = use_one_processor;

}  // namespace

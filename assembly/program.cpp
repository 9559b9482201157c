#include "assembly/program.hpp"

#include <chrono>
#include <cstdio>
#include <exception>
#include <new>

#include <sys/resource.h>

#include "assembly/error.hpp"

#ifndef CUPOLA_VERSION
#error "CUPOLA_VERSION and CUPOLA_REVISION come from CMake"
#endif

namespace cupola {

std::string program_version() {
  return CUPOLA_VERSION " (" CUPOLA_REVISION ")";
}

int run_program(std::string_view name, const std::function<ExitCode()>& body) {
  const auto report = [&name](const char* message) {
    std::fflush(stdout);
    std::fprintf(stderr, "%.*s: %s\n", static_cast<int>(name.size()), name.data(), message);
  };
  try {
    return static_cast<int>(body());
  } catch (const InputError& error) {
    report(error.what());
    return static_cast<int>(ExitCode::bad_input);
  } catch (const std::bad_alloc&) {
    report("error: out of memory");
  } catch (const std::exception& error) {
    report((std::string("error: ") + error.what()).c_str());
  }
  return static_cast<int>(ExitCode::failed);
}

long long peak_memory_bytes() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  return 1024LL * usage.ru_maxrss;
}

double wall_seconds() {
  using namespace std::chrono;
  return duration<double>(steady_clock::now().time_since_epoch()).count();
}

double cpu_seconds() {
  rusage usage{};
  getrusage(RUSAGE_SELF, &usage);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

}  // namespace cupola

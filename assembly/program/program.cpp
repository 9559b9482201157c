#include "assembly/program/program.hpp"

#include <cstdio>
#include <exception>
#include <new>

#include "assembly/base/error.hpp"

namespace cupola {

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

}  // namespace cupola

#include "assembly/program/program.hpp"

#include <cstdio>
#include <exception>
#include <new>
#include <string>

#include "assembly/base/error.hpp"
#include "assembly/program/terminal.hpp"

namespace cupola {

int run_program(std::string_view name, const std::function<ExitCode()>& body) {
  const auto report = [&name](std::string message) {
    std::fflush(stdout);
    const std::string word = "error:";
    if (const size_t at = message.find(word); at != std::string::npos)
      message.replace(at, word.size(), in_colour(word, Colour::red, stderr));
    std::fprintf(stderr, "%.*s: %s\n", static_cast<int>(name.size()), name.data(), message.c_str());
  };
  try {
    return static_cast<int>(body());
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

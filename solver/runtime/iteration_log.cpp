#include "solver/runtime/iteration_log.hpp"

#include <utility>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/base/process.hpp"
#include "solver/runtime/threads.hpp"

namespace cupola {
namespace {

struct Printer {
  std::function<void(const std::string&)> print;
  double interval = 0.0;   // s
  double last_time = 0.0;  // s, of the last line
};
Printer printer;

}  // namespace

IterationLog::IterationLog(std::function<void(const std::string&)> print, double interval) {
  CUPOLA_ASSERT(!printer.print);
  printer = {std::move(print), interval, wall_seconds()};
}

IterationLog::~IterationLog() {
  printer = {};
}

void report_iteration(const char* method, int iteration, double accuracy, double tolerance) {
  if (!printer.print || inside_team) return;  // lines of several threads would mix
  const double now = wall_seconds();
  if (now - printer.last_time < printer.interval) return;
  printer.last_time = now;
  printer.print(fmt::format("{:<7} iteration {:7d}  accuracy {:.2e}, tolerance {:.0e}", method, iteration,
                            accuracy, tolerance));
}

}  // namespace cupola

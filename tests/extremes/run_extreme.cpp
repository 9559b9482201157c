#include <algorithm>
#include <cmath>
#include <csignal>

#include <fmt/format.h>
#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include "assembly/base/error.hpp"
#include "assembly/base/process.hpp"
#include "solver/analysis/analysis.hpp"
#include "solver/collision/geometry_warnings.hpp"
#include "solver/dynamics/scene_options.hpp"
#include "tests/extremes/extreme_scene.hpp"

namespace cupola {
namespace {

Ending ending_of(Status status) {
  switch (status) {
    case Status::stable:
    case Status::stable_unproven:
      return Ending::stable;
    case Status::moving:
    case Status::moving_unproven:
      return Ending::moving;
    case Status::collapsed:
      return Ending::collapsed;
    case Status::bracketed:
    case Status::unconverged:
      break;
  }
  return Ending::unconverged;
}

bool finite(const std::vector<Vec3>& vectors) {
  return std::all_of(vectors.begin(), vectors.end(), [](const Vec3& x) { return x.allFinite(); });
}

bool finite(const Frame& frame) {
  return finite(frame.contacts.point) && finite(frame.contacts.normal) && finite(frame.contacts.force) &&
         finite(frame.blocks.position) && finite(frame.blocks.velocity) && finite(frame.blocks.displacement);
}

/// Why a result that the run presents as an answer is wrong; "" if it is right.
std::string fault_of(const ExtremeScene& scene, const Summary& summary, const Frame& frame,
                     const ExtremeResult& result) {
  // A run that ends `stable` with exit code 0 is read as: its forces may be used.
  constexpr double kUsable = 1e-2;
  constexpr double kRounding = 1e-14;  // of the sums by which the true error is computed
  if (std::find(scene.correct.begin(), scene.correct.end(), result.ending) == scene.correct.end())
    return fmt::format("presented as {}", to_string(result.ending));
  if (!finite(frame)) return "a number is not finite";
  // The account of energy of a motion closes. Below this speed (m/s) its energies are rounding of the
  // positions.
  constexpr double kAtRest = 1e-6, kBalance = 1e-6;
  if (summary.energy_error.value_or(0.0) > kBalance && summary.max_speed_m_per_s.value_or(0.0) > kAtRest)
    return fmt::format("the account of energy errs by {:.1e}", *summary.energy_error);
  const TrueError& error = result.error;
  if (!error.refuted.empty()) return error.refuted;
  const std::optional<double> bound = summary.certified_force_error.value;
  if (bound && error.wrench > *bound + kRounding)
    return fmt::format("force error {:.1e} above the certified {:.1e}", error.wrench, *bound);
  if (error.largest > kUsable)
    return fmt::format("stable, but a force is wrong by {:.0f} %", 100 * error.largest);
  return scene.check ? scene.check(summary, frame) : "";
}

/// What the summary states about its accuracy.
std::string statement(const Summary& summary) {
  if (summary.certified_force_error.value) return fmt::format("{:.0e}", *summary.certified_force_error.value);
  return fmt::format("residual {:.0e}", summary.accuracy.reached);
}

/// Ends this process after so many more seconds of processor time; 0: never.
void limit_time(double seconds) {
  rlimit limit{};
  getrlimit(RLIMIT_CPU, &limit);
  limit.rlim_cur = seconds > 0.0 ? static_cast<rlim_t>(std::ceil(cpu_seconds() + seconds)) : limit.rlim_max;
  setrlimit(RLIMIT_CPU, &limit);
}

ExtremeResult analyse(const ExtremeScene& extreme) {
  ExtremeResult result;
  try {
    const Scene scene = extreme.make();
    geometry_warnings(scene.assembly, detection_options(scene.input));  // refuses overlaps
    Frame last;
    AnalysisSinks sinks;
    sinks.frame = [&last](const Frame& frame) { last = frame; };
    limit_time(kTimeLimit);
    const double started = cpu_seconds();
    const Summary summary = run_analysis(scene.input, scene.assembly, sinks).value();
    result.seconds = cpu_seconds() - started;
    limit_time(0.0);
    result.ending = ending_of(summary.status);
    result.message = summary.message;
    result.stated = statement(summary);
    result.asked = summary.accuracy.asked;
    result.iterations = summary.iterations;
    if (extreme.truth && result.ending != Ending::unconverged)
      result.error = extreme.truth(scene, summary, last);
    const bool answered = result.ending != Ending::unconverged;
    result.reason = answered ? fault_of(extreme, summary, last, result) : summary.message;
    result.verdict = !answered ? Verdict::not_met : result.reason.empty() ? Verdict::right : Verdict::wrong;
  } catch (const InputError& error) {
    const bool right =
        std::find(extreme.correct.begin(), extreme.correct.end(), Ending::refused) != extreme.correct.end();
    result.ending = Ending::refused;
    result.message = result.reason = error.what();
    result.verdict = right ? Verdict::right : Verdict::wrong;
  } catch (const std::exception& error) {
    result.message = result.reason = error.what();
  }
  return result;
}

constexpr char kSeparator = '\x1f';

std::string to_text(const ExtremeResult& r) {
  const char s = kSeparator;
  return fmt::format("{}{}{}{}{}{}{}{}{}{}{}{}{}{}{}{}{}{}{}{}{}{}{}", static_cast<int>(r.ending), s,
                     static_cast<int>(r.verdict), s, r.reason, s, r.message, s, r.stated, s, r.error.largest,
                     s, r.error.wrench, s, r.error.refuted, s, r.asked, s, r.iterations, s, r.seconds, s,
                     static_cast<int>(r.error.has_reference));
}

ExtremeResult from_text(const std::string& text) {
  std::vector<std::string> fields(1);
  for (const char c : text) {
    if (c == kSeparator)
      fields.emplace_back();
    else
      fields.back() += c;
  }
  CUPOLA_ASSERT(fields.size() == 12);
  ExtremeResult r;
  r.ending = static_cast<Ending>(std::stoi(fields[0]));
  r.verdict = static_cast<Verdict>(std::stoi(fields[1]));
  r.reason = fields[2];
  r.message = fields[3];
  r.stated = fields[4];
  r.error = {std::stod(fields[5]), std::stod(fields[6]), fields[7], fields[11] == "1"};
  r.asked = std::stod(fields[8]);
  r.iterations = std::stoi(fields[9]);
  r.seconds = std::stod(fields[10]);
  return r;
}

std::string read_all(int file) {
  std::string text;
  std::array<char, 4096> buffer{};
  for (ssize_t n = 0; (n = read(file, buffer.data(), buffer.size())) > 0;)
    text.append(buffer.data(), static_cast<size_t>(n));
  return text;
}

[[noreturn]] void report_and_exit(const ExtremeScene& scene, int file) {
  const std::string text = to_text(analyse(scene));
  const bool written = write(file, text.data(), text.size()) == static_cast<ssize_t>(text.size());
  _exit(written ? 0 : 1);
}

}  // namespace

ExtremeResult run_extreme(const ExtremeScene& scene) {
  std::array<int, 2> ends{};
  if (pipe(ends.data()) != 0) throw SystemError("cannot make a pipe");
  const pid_t child = fork();
  if (child < 0) throw SystemError("cannot start a process");
  if (child == 0) {
    close(ends[0]);
    report_and_exit(scene, ends[1]);
  }
  close(ends[1]);
  const std::string text = read_all(ends[0]);
  close(ends[0]);
  int status = 0;
  waitpid(child, &status, 0);
  if (!text.empty()) return from_text(text);
  ExtremeResult result;
  const bool late = WIFSIGNALED(status) && WTERMSIG(status) == SIGXCPU;
  result.ending = late ? Ending::timeout : Ending::failed;
  result.verdict = late ? Verdict::not_met : Verdict::wrong;
  result.seconds = late ? kTimeLimit : 0.0;
  result.message = late                  ? fmt::format("not met within {:g} s", kTimeLimit)
                   : WIFSIGNALED(status) ? fmt::format("killed by signal {}", WTERMSIG(status))
                                         : "the process ended without a result";
  result.reason = result.message;
  return result;
}

}  // namespace cupola

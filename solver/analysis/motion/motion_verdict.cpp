#include "solver/analysis/motion/motion_verdict.hpp"

#include <string>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"

namespace cupola {
namespace {

/// Why the run is unconverged: the measure that was missed, and where the contact law is violated most.
std::string missed_text(const Analysis& analysis, const RunProgress& progress, const SolveSummary& last) {
  if (!last.usable()) return fmt::format("step {} failed: {}", progress.steps, last.message);
  std::string text = fmt::format("{} of {} missed the tolerance {:.1e} of the {}; the worst reached {:.2e}",
                                 progress.missed_steps, counted(progress.steps, "step"), analysis.tolerance,
                                 to_string(progress.measure), progress.worst_error);
  if (const auto& violation = progress.worst.violation; violation && violation->value > analysis.tolerance)
    text += fmt::format(
        "; at {:.4g} s a force between blocks {} and {} violates the contact law by {:.2g} times the force "
        "of its joint (or 1 % of the mean joint force, if larger)",
        violation->time, violation->block_a, violation->block_b, violation->value);
  text += ". Try a shorter `analysis.time_step` or a larger `analysis.tolerance`";
  return analysis.max_iterations > 0 ? text + ", or raise `analysis.max_iterations`" : text;
}

/// Why the motion is not as exact as asked although the contact problems were solved.
std::string coarse_text(const Analysis& analysis, const RunProgress& progress) {
  return fmt::format(
      "{} of {} missed `analysis.time_error`, {:.1e} m, although no longer than "
      "`analysis.adaptive.smallest`, {:.1e} s; "
      "the worst had {:.2e} m. Try a smaller `analysis.adaptive.smallest` or a larger `analysis.time_error`",
      progress.coarse_steps, counted(progress.steps, "step"), analysis.adaptive->displacement_error,
      analysis.adaptive->smallest, progress.worst_time_error);
}

/// A warning if impacts were elastic.
std::string elastic_text(const Analysis& analysis, const RunProgress& progress) {
  return fmt::format(
      "blocks met and bounced in {}, overlapping by up to {:.2g} m: their joints, elastic {}, take {:.1e} s "
      "to stop them, longer than the step. They hardly bounce with `analysis.damping: {:.1e}`, not at all "
      "with "
      "rigid joints (compliance 0){}",
      counted(progress.elastic_steps, "step"), progress.deepest,
      analysis.damping > 0.0 ? fmt::format("with a damping of {:g} s", analysis.damping) : "without damping",
      progress.elastic_impact, 2.0 * progress.elastic_impact,
      analysis.adaptive ? "" : " or a much longer `analysis.time_step`");
}

/// A warning if blocks may have passed others undetected.
std::string fast_text(const Analysis& analysis, const RunProgress& progress) {
  constexpr double kShare = 0.9;  // of the longest step, since other steps end elsewhere
  const FastPair& fast = progress.fast;
  return fmt::format(
      "block {} may have passed through block {}: in the step up to {:.4g} s it moves by {:.3g} m, farther "
      "than contacts are sought; so in {} of {}. Try `{}: {:.1e}`",
      fast.block, fast.other, progress.fast_time, fast.way, progress.fast_steps,
      counted(progress.steps, "step"),
      analysis.adaptive ? "analysis.adaptive.smallest" : "analysis.time_step", kShare * fast.longest);
}

/// Why a motion is not at rest at its end; "" if it is. `speed`: m/s, largest at the end.
std::string unrest_text(const Analysis::Thresholds& thresholds, const RestWindow& rest, double speed) {
  if (speed > thresholds.speed)
    return fmt::format("largest speed {:.3g} m/s > threshold {:.3g} m/s at the end", speed, thresholds.speed);
  if (!rest.is_covered(thresholds))
    return fmt::format(
        "the motion is shorter than `analysis.thresholds.window`, {:.3g} s, over which rest is judged; speed "
        "{:.3g} m/s at the end",
        thresholds.window, speed);
  if (!rest.is_slow(thresholds))
    return fmt::format(
        "largest speed {:.3g} m/s > threshold {:.3g} m/s at {:.4g} s, within the last {:.3g} s",
        rest.last_fast_speed(), thresholds.speed, rest.last_fast_time(), thresholds.window);
  if (rest.drift() > RestWindow::largest_drift(thresholds))
    return fmt::format(
        "a block has moved by {:.3g} m/s on average over the last {:.3g} s, more than a tenth of the "
        "threshold {:.3g} m/s",
        rest.drift(), thresholds.window, thresholds.speed);
  return "";
}

/// The largest displacement against its threshold, and that at the end.
std::string displacement_text(const Summary& summary, double threshold, bool rests) {
  const double largest = *summary.max_displacement_m, at_end = *summary.final_displacement_m;
  std::string text =
      fmt::format("largest displacement {:.3g} m (at {:.4g} s) {} threshold {:.3g} m", largest,
                  *summary.max_displacement_time_s, largest > threshold ? ">" : "<=", threshold);
  if (at_end < largest) text += fmt::format("; {:.3g} m at the end", at_end);
  if (largest > threshold && rests) {
    text += at_end < largest ? ", at rest" : "; at rest at the end";
    if (at_end <= threshold)
      text += fmt::format(": a threshold above {:.3g} m would call it stable", largest);
  }
  return text;
}

}  // namespace

std::vector<std::string> motion_warnings(const Analysis& analysis, const RunProgress& progress) {
  std::vector<std::string> warnings;
  if (progress.starts_unstable)
    warnings.emplace_back(
        "unstable balance at the start, as on an edge: a small disturbance would end it, so that rest "
        "without one is no evidence that the structure stands");
  if (progress.fast_steps > 0) warnings.push_back(fast_text(analysis, progress));
  if (progress.elastic_steps > 0) warnings.push_back(elastic_text(analysis, progress));
  return warnings;
}

void judge_motion(const Analysis& analysis, const RunProgress& progress, const SolveSummary& last,
                  Summary* summary) {
  summary->accuracy = accuracy_in(progress.measure);
  summary->accuracy.asked = analysis.tolerance;
  summary->accuracy.reached = last.reached;
  summary->accuracy.worst_over_run = progress.worst_error;
  const Analysis::Thresholds& thresholds = analysis.thresholds;
  const double speed = *summary->max_speed_m_per_s;
  const std::string unrest = unrest_text(thresholds, progress.rest, speed);
  summary->max_displacement_m = progress.farthest;
  summary->max_displacement_time_s = progress.farthest_time;
  const std::string displacement = displacement_text(*summary, thresholds.collapse(), unrest.empty());
  if (progress.missed_steps > 0) {
    summary->status = Status::unconverged;
    summary->message = missed_text(analysis, progress, last);
  } else if (progress.coarse_steps > 0) {
    summary->status = Status::unconverged;
    summary->message = coarse_text(analysis, progress);
  } else if (progress.farthest > thresholds.collapse()) {
    summary->status = Status::collapsed;
    summary->message = displacement;
  } else {
    summary->status = unrest.empty() ? Status::stable : Status::moving;
    summary->message = !unrest.empty() ? unrest
                                       : fmt::format("largest speed {:.3g} m/s <= threshold {:.3g} m/s, {}",
                                                     speed, thresholds.speed, displacement);
  }
  if (summary->status != Status::unconverged) summary->rest_at_end = unrest.empty();
  if (progress.rounded_steps > 0)
    summary->message += fmt::format(
        "; in {} rounding of the velocities kept the contact-law residual above the tolerance {:.1e}",
        counted(progress.rounded_steps, "step"), analysis.tolerance);
}

}  // namespace cupola

#include "postproc/studies/tradeoff_text.hpp"

#include <algorithm>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "assembly/base/counted.hpp"

namespace cupola {
namespace {

/// "NAME (2 s, 1.0e-03)": name, time and error.
std::string with_cost(const TradeoffRow& row) {
  return fmt::format("{} ({:.2g} s{}, {:.1e})", row.point.name, row.seconds(),
                     row.uses_wall_time() ? " wall time" : "", row.error());
}

/// The fastest run within each of a few round errors; runs that are fastest within several errors come once.
std::string fastest_runs(const std::vector<TradeoffRow>& front) {
  std::vector<std::string> errors, parts;
  for (const double error : {1e-1, 1e-2, 1e-3, 1e-6}) {
    const auto within = [error](const TradeoffRow& row) { return row.error() <= error; };
    const auto at = std::find_if(front.begin(), front.end(), within);
    if (at == front.end()) break;
    const std::string run = with_cost(*at);
    if (!parts.empty() && parts.back() == run) {
      errors.back() += fmt::format(" and {:g}", error);
    } else {
      errors.push_back(fmt::format("{:g}", error));
      parts.push_back(run);
    }
  }
  if (parts.empty()) return "No run reaches an error of 0.1 or less. ";
  std::string text;
  for (size_t i = 0; i < parts.size(); ++i)
    text += fmt::format("{}within {}: {}", i == 0 ? "Fastest run " : "; ", errors[i], parts[i]);
  return text + ". ";
}

/// Time and error from the fastest to the most accurate run of the front.
std::string exchange(const std::vector<TradeoffRow>& front) {
  if (front.size() < 2) return "";
  const TradeoffRow &fast = front.front(), &fine = front.back();
  const std::string gain =
      fine.error() > 0.0 ? fmt::format("the error falls by a factor of {:.2g}", fast.error() / fine.error())
                         : std::string("the error falls to zero");
  return fmt::format("From {} to {} the time grows by a factor of {:.2g} and {}. ", fast.point.name,
                     fine.point.name, fine.seconds() / fast.seconds(), gain);
}

std::string knob_text(const std::vector<TradeoffRow>& all, const std::string& knob) {
  const std::vector<TradeoffRow> rows = rows_of(all, knob);
  if (rows.empty()) return "";
  const TradeoffRow& worst =
      *std::max_element(rows.begin(), rows.end(), [](const TradeoffRow& a, const TradeoffRow& b) {
        return a.errors.wrench_worst < b.errors.wrench_worst;
      });
  std::vector<std::string> unreached;
  for (const TradeoffRow& row : rows)
    if (!row.reached()) unreached.push_back(with_cost(row));
  const std::vector<TradeoffRow> front = pareto_front(rows);
  std::string text = fmt::format("{}: ", knob);
  if (!rows.front().point.coarse.empty())
    text += fmt::format("Reference {}, extrapolated to a time step of zero for a method of first order. ",
                        rows.front().point.reference_text());
  text += fastest_runs(front) + exchange(front);
  if (!worst.critical_error)
    text += fmt::format(
        "The largest error of a single joint is {:.1e}, in {}; the thrust lines of this run shift by up to "
        "{:.1e} of the thickness.",
        worst.errors.wrench_worst, worst.point.name, worst.errors.thrust_line);
  if (!unreached.empty())
    text += fmt::format(" Requested accuracy not reached: {}.", fmt::join(unreached, ", "));
  return text;
}

}  // namespace

std::vector<std::string> tradeoff_text(const std::vector<TradeoffRow>& rows) {
  std::vector<std::string> paragraphs, missing;
  for (const TradeoffRow& row : rows)
    if (!row.finished()) missing.push_back(row.point.name);
  if (!missing.empty()) paragraphs.push_back(fmt::format("Not run: {}.", fmt::join(missing, ", ")));
  for (const TradeoffRow& row : rows)
    if (row.point.is_reference() && row.finished())
      paragraphs.push_back(
          fmt::format("Reference {}: {:.2g} s{}, {:.0f} MB, {}, status {}, certified force error {}.",
                      row.point.name, row.seconds(), row.uses_wall_time() ? " wall time" : "",
                      static_cast<double>(row.summary->peak_memory_bytes) / 1e6,
                      counted(row.summary->contacts, "contact"), to_string(row.summary->status),
                      row.summary->certified_force_error.value
                          ? fmt::format("{:.1e}", *row.summary->certified_force_error.value)
                          : std::string("none")));
  for (const std::string& knob : knobs_of(rows))
    if (std::string text = knob_text(rows, knob); !text.empty()) paragraphs.push_back(std::move(text));
  return paragraphs;
}

}  // namespace cupola

#include "postproc/studies/study_text.hpp"

#include <algorithm>

#include <fmt/format.h>

namespace cupola {
namespace {

std::string joined(const std::vector<std::string>& names) {
  std::string out;
  for (const std::string& name : names) out += (out.empty() ? "" : ", ") + name;
  return out;
}

std::string with_cost(const StudyRow& row) {
  return fmt::format("{} ({:.2g} s{}, {:.1e})", row.point.name, row.seconds(),
                     row.by_the_clock() ? " by the clock" : "", row.error());
}

/// The fastest run for each of a few errors that users ask for.
std::string cheapest(const std::vector<StudyRow>& front) {
  std::vector<std::string> parts;
  std::string last;
  for (const double error : {1e-1, 1e-2, 1e-3, 1e-6}) {
    const auto at =
        std::find_if(front.begin(), front.end(), [&](const StudyRow& row) { return row.error() <= error; });
    if (at == front.end()) break;
    if (at->point.name == last)
      parts.back() += fmt::format(" and {:g}", error);
    else
      parts.push_back(fmt::format("{} within {:g}", with_cost(*at), error));
    last = at->point.name;
  }
  if (parts.empty()) return "No run comes within 0.1 of the reference's wrenches. ";
  return "Cheapest: " + joined(parts) + ". ";
}

/// What the whole front costs and buys.
std::string exchange(const std::vector<StudyRow>& front) {
  if (front.size() < 2) return "";
  const StudyRow &fast = front.front(), &fine = front.back();
  const std::string gain = fine.error() > 0.0
                               ? fmt::format("1/{:.2g} of the error", fast.error() / fine.error())
                               : std::string("the reference's answer");
  return fmt::format("From {} to {}: {:.2g} times the time buys {}. ", fast.point.name, fine.point.name,
                     fine.seconds() / fast.seconds(), gain);
}

std::string knob_text(const std::vector<StudyRow>& all, const std::string& knob) {
  const std::vector<StudyRow> rows = rows_of(all, knob);
  if (rows.empty()) return "";
  const StudyRow& worst = *std::max_element(
      rows.begin(), rows.end(),
      [](const StudyRow& a, const StudyRow& b) { return a.errors.wrench_worst < b.errors.wrench_worst; });
  std::vector<std::string> unreached;
  for (const StudyRow& row : rows)
    if (!row.reached()) unreached.push_back(with_cost(row));
  const std::vector<StudyRow> front = pareto_front(rows);
  std::string text = fmt::format("{}: ", knob) + cheapest(front) + exchange(front);
  if (!worst.critical_error)
    text += fmt::format(
        "Worst joint of all runs: {:.1e} in {}, whose thrust line shifts by {:.1e} of the thickness and "
        "whose "
        "base thrust by {:.1e}.",
        worst.errors.wrench_worst, worst.point.name, worst.errors.thrust_line, worst.errors.base_thrust);
  if (!unreached.empty()) text += " Did not reach what they asked for: " + joined(unreached) + ".";
  return text;
}

}  // namespace

std::vector<std::string> study_text(const std::vector<StudyRow>& rows) {
  std::vector<std::string> paragraphs, missing;
  for (const StudyRow& row : rows)
    if (!row.finished()) missing.push_back(row.point.name);
  if (!missing.empty()) paragraphs.push_back("Not run: " + joined(missing) + ".");
  for (const StudyRow& row : rows)
    if (row.point.is_reference() && row.finished())
      paragraphs.push_back(fmt::format(
          "Reference {}: {:.2g} s{}, {:.0f} MB, {} contacts, status {}, certified force error {}.",
          row.point.name, row.seconds(), row.by_the_clock() ? " by the clock" : "",
          static_cast<double>(row.summary->peak_memory_bytes) / 1e6, row.summary->contacts,
          to_string(row.summary->status),
          row.summary->certified_force_error ? fmt::format("{:.1e}", *row.summary->certified_force_error)
                                             : std::string("none")));
  for (const std::string& knob : knobs_of(rows))
    if (std::string text = knob_text(rows, knob); !text.empty()) paragraphs.push_back(std::move(text));
  return paragraphs;
}

}  // namespace cupola

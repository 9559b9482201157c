#include "postproc/studies/sweep.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/files/number_text.hpp"
#include "assembly/model/ending.hpp"
#include "postproc/report/first_screen.hpp"
#include "postproc/report/html.hpp"
#include "postproc/studies/sweep_figure.hpp"
#include "postproc/tables/run_files.hpp"

namespace cupola {
namespace {

/// The texts of a column, from the top; empty ones where it has no value.
std::vector<std::string> texts_of(const Table& table, const std::string& key) {
  std::vector<std::string> texts;
  for (const auto& row : table.rows)
    for (size_t k = 0; k < row.size(); ++k)
      if (table.columns[k].key == key) texts.push_back(to_display(row[k]));
  return texts;
}

}  // namespace

std::string endings(const Table& table) {
  std::map<std::string, int> count;
  for (std::string& verdict : texts_of(table, "verdict")) {
    verdict.front() = static_cast<char>(std::tolower(static_cast<unsigned char>(verdict.front())));
    ++count[verdict];
  }
  std::string text;
  for (const auto& [verdict, members] : count)
    text += fmt::format("{}{} in {}", text.empty() ? "" : ", ", verdict, members);
  return text;
}

std::vector<int> falls_of(const Table& table) {
  std::vector<int> out;
  for (const std::string& verdict : texts_of(table, "verdict")) {
    const bool falls = verdict.starts_with("It falls") || verdict.ends_with("what falls");
    const bool stands = verdict.starts_with("It stands") && !verdict.ends_with("undecided");
    out.push_back(falls ? 1 : stands ? 0 : -1);
  }
  return out;
}

std::vector<std::optional<bool>> stands_throughout(const Table& table) {
  const auto column = std::ranges::find(table.columns, kStandsAtBothEnds, &Table::Column::key);
  std::vector<std::optional<bool>> out(table.rows.size());
  if (column == table.columns.end()) return out;
  for (size_t r = 0; r < out.size(); ++r)
    if (const double* value = std::get_if<double>(&table.rows[r][column - table.columns.begin()]))
      out[r] = *value == 1.0;
  return out;
}

std::string failures(const Table& table, const std::string& noun) {
  const std::vector<std::string> statuses = texts_of(table, "status");
  const std::vector<std::optional<bool>> throughout = stands_throughout(table);
  int failed = 0;
  for (size_t r = 0; r < statuses.size(); ++r)
    failed += !throughout[r] && (statuses[r] == "missing" || statuses[r] == "unconverged");
  return failed == 0 ? "" : fmt::format("{} of {}", failed, counted(table.rows.size(), noun));
}

namespace {

/// Rows whose structure stands, or falls, whatever the value sought: throughout a bracket, or by the status
/// of a construction, which may have a least mortar if it falls with the mortar of its case.
std::vector<size_t> rows_throughout(const Table& table, bool stand) {
  const std::vector<std::string> statuses = texts_of(table, "status");
  const std::vector<std::optional<bool>> throughout = stands_throughout(table);
  const size_t critical = table.column_named("critical_value");
  std::vector<size_t> rows;
  for (size_t r = 0; r < statuses.size(); ++r) {
    if (std::holds_alternative<double>(table.rows[r][critical])) continue;
    const bool does = stand ? stands(statuses[r]) : falls(statuses[r]);
    if (throughout[r] ? *throughout[r] == stand : does) rows.push_back(r);
  }
  return rows;
}

/// The number of the row with the least value in a column, or the greatest; none without numbers.
std::optional<size_t> row_at_the_end(const Table& table, size_t column, bool least) {
  std::optional<size_t> found;
  for (size_t r = 0; r < table.rows.size(); ++r) {
    const double* value = std::get_if<double>(&table.rows[r][column]);
    if (!value || !std::isfinite(*value)) continue;
    const double* best = found ? std::get_if<double>(&table.rows[*found][column]) : nullptr;
    if (!best || (least ? *value < *best : *value > *best)) found = r;
  }
  return found;
}

/// "loads.forces[0].point[0] = -1.8 (bridge_run/0005)".
std::string settings_of(const std::vector<std::string>& keys, const Table& table, size_t row) {
  std::vector<std::string> settings;
  for (const std::string& key : keys)
    settings.push_back(fmt::format("{} = {}", key, to_display(table.rows[row][table.column_named(key)])));
  return fmt::format("{} ({})", fmt::join(settings, ", "), to_display(table.rows[row][0]));
}

/// "7.716 at loads.forces[0].point[0] = -1.8 (bridge_run/0005)".
std::string critical_at(const std::vector<std::string>& keys, const Table& table, size_t row,
                        size_t critical) {
  const std::string& unit = table.columns[critical].unit;
  return fmt::format("{:.4g}{} at {}", std::get<double>(table.rows[row][critical]),
                     unit.empty() || unit == "factor" ? "" : " " + unit, settings_of(keys, table, row));
}

/// "2 of 4 runs fall throughout the bracket, first at ...".
std::string throughout(const char* verb, const std::vector<size_t>& rows,
                       const std::vector<std::string>& keys, const Table& table) {
  return fmt::format("{} of {} {} throughout the bracket, first at {}", rows.size(),
                     counted(table.rows.size(), "run"), verb, settings_of(keys, table, rows.front()));
}

}  // namespace

std::string governing_member(const std::vector<std::string>& keys, const Table& table, bool more_is_safer) {
  if (std::ranges::count(table.columns, "critical_parameter", &Table::Column::key) > 0) return "";
  const size_t critical = table.column_named("critical_value"), margin = table.column_named("margin_factor");
  const size_t by = row_at_the_end(table, margin, true) ? margin : critical;
  const bool least_governs = by == margin || more_is_safer;
  const auto worst = row_at_the_end(table, by, least_governs),
             best = row_at_the_end(table, by, !least_governs);
  if (!worst || !std::holds_alternative<double>(table.rows[*worst][critical])) return "";
  const std::vector<size_t> fallen = rows_throughout(table, false), standing = rows_throughout(table, true);
  std::string text = "What governs: ";
  if (!fallen.empty()) text += throughout("fall", fallen, keys, table) + ". Of the others: ";
  text += fmt::format("critical value {}.", critical_at(keys, table, *worst, critical));
  if (!standing.empty())
    text += fmt::format(" At the other end: {}.", throughout("stand", standing, keys, table));
  else if (*best != *worst && std::holds_alternative<double>(table.rows[*best][critical]))
    text += fmt::format(" At the other end: {}.", critical_at(keys, table, *best, critical));
  return text;
}

namespace {

/// Where one swept number changes the verdict: "It falls at joints.friction 0.06 to 0.08, it stands at 0.09
/// to 0.4."; "" for several keys, for texts, for limits, whose members have no verdict of their own, and
/// where the verdict changes often.
std::string where_it_stands(const std::vector<SweptKey>& sweep, const Table& table) {
  constexpr size_t kMostChanges = 4;
  if (sweep.size() != 1) return "";
  for (const std::string& critical : texts_of(table, "critical_value"))
    if (!critical.empty()) return "";
  const std::vector<std::string> values = texts_of(table, sweep.front().key);
  const std::vector<std::string> statuses = texts_of(table, "status");
  const std::vector<int> falls = falls_of(table);
  std::vector<std::pair<double, size_t>> order;
  for (size_t i = 0; i < values.size(); ++i) {
    if (!read_number(values[i], &order.emplace_back(0.0, i).first).empty()) return "";
  }
  std::ranges::sort(order);
  struct Stretch {
    std::string verdict, first, last;
  };
  std::vector<Stretch> stretches;
  for (const auto& [number, i] : order) {
    const std::string verdict = falls[i] == 0              ? "stands"
                                : falls[i] == 1            ? "falls"
                                : statuses[i] == "missing" ? "was not run"
                                                           : "is undecided";
    if (stretches.empty() || stretches.back().verdict != verdict)
      stretches.push_back({verdict, values[i], values[i]});
    stretches.back().last = values[i];
  }
  if (stretches.size() > kMostChanges) return "";
  std::string text;
  for (const Stretch& s : stretches)
    text += fmt::format("{} {} at {}{}{}", text.empty() ? "It" : ", it", s.verdict,
                        text.empty() ? sweep.front().key + " " : "", s.first,
                        s.first == s.last ? "" : " to " + s.last);
  text += ".";
  const auto decided = [](const Stretch& s) { return s.verdict == "stands" || s.verdict == "falls"; };
  if (stretches.size() == 2 && std::ranges::all_of(stretches, decided))
    text += fmt::format(" The limit lies between {} and {}.", stretches[0].last, stretches[1].first);
  return text;
}

/// The banner: in how many members it stands, and at which values.
std::string banner(const std::vector<SweptKey>& sweep, const Table& table, const std::string& governs) {
  const std::string runs = counted(table.rows.size(), "run"), failed = failures(table);
  const std::string ended = fmt::format("Of {}: {}.", runs, endings(table)),
                    where = where_it_stands(sweep, table);
  const std::vector<int> falls = falls_of(table);
  const auto standing = std::ranges::count(falls, 0);
  if (!failed.empty())
    return verdict_html(failed + " failed", where.empty() ? ended : ended + " " + where, false);
  if (!governs.empty()) {
    const size_t stop = governs.find(". ");
    return verdict_html(governs.substr(0, stop == std::string::npos ? stop : stop + 1),
                        (stop == std::string::npos ? "" : governs.substr(stop + 2) + " ") + ended,
                        std::ranges::count(falls, 1) == 0);
  }
  const bool all = standing == static_cast<std::ptrdiff_t>(table.rows.size());
  if (where.empty()) return verdict_html(ended, "", all);
  return verdict_html(fmt::format("It stands in {} of {}", standing, runs), where, all);
}

/// How many verdicts are proven. That of a motion holds of the history that was followed.
int proven_verdicts(const Table& table, const std::vector<StudyRun>& members,
                    const std::string& runs_folder) {
  const std::vector<std::string> statuses = texts_of(table, "status");
  int count = 0;
  for (size_t i = 0; i < statuses.size(); ++i)
    if (statuses[i] == to_string(Status::stable) || statuses[i] == to_string(Status::moving))
      count += !RunFiles(runs_folder + "/" + members[i].name).number_if_any("results.max_speed_m_per_s");
  return count;
}

/// What is certain of the verdicts, and what all runs assume; "" for limits, each of which has a bracket of
/// its own. `proven`: number of verdicts.
std::string certain_of_sweep(const std::vector<SweptKey>& sweep, const Table& table, int proven) {
  for (const std::string& critical : texts_of(table, "critical_value"))
    if (!critical.empty()) return "";
  const std::string of = proven == 0 ? "no verdict"
                                     : fmt::format("the verdict of {} of {}, which is proven", proven,
                                                   counted(table.rows.size(), "run"));
  return fmt::format(
      "Certain: {}. Not known: where between two values of {} the verdict changes. "
      "Assumed: what the runs share, and the stiffness of the joints, on which thrust and cracks depend.",
      of, sweep.front().key);
}

}  // namespace

std::string add_sweep(const std::vector<SweptKey>& sweep, const std::vector<StudyRun>& members,
                      const std::string& runs_folder, StudyPage* page) {
  std::vector<std::string> keys;
  for (const SweptKey& swept : sweep) keys.push_back(swept.key);
  const Table table = sweep_table(keys, members, runs_folder);
  const std::string governs = governing_member(keys, table, more_is_safer(members, runs_folder));
  page->add("<div class=\"first\">\n" + banner(sweep, table, governs));
  const int proven = proven_verdicts(table, members, runs_folder);
  if (const std::string certain = certain_of_sweep(sweep, table, proven); !certain.empty())
    page->add("<p class=\"certain\">" + html_text(certain) + "</p>\n");
  page->add("</div>\n");
  if (const Figure figure = sweep_figure(sweep, table); !figure.commands.empty()) page->add_figures({figure});
  page->add_table(table, in_readable_units(table));
  page->add_report_links(members, runs_folder);
  return fmt::format("{}\n{}: {}\n{}{}", aligned_text(table), counted(members.size(), "run"), endings(table),
                     governs, governs.empty() ? "" : "\n");
}

}  // namespace cupola

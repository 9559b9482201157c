#include "postproc/studies/sweep.hpp"

#include <map>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "postproc/report/first_screen.hpp"
#include "postproc/studies/sweep_figure.hpp"

namespace cupola {
std::string endings(const Table& table) {
  std::map<std::string, int> count;
  for (const auto& row : table.rows)
    for (size_t k = 0; k < row.size(); ++k)
      if (table.columns[k].key == "status") ++count[to_display(row[k])];
  std::string text;
  for (const auto& [status, members] : count)
    text = fmt::format("{} {}{}{}", members, status, text.empty() ? "" : ", ", text);  // stable before moving
  return text;
}

std::string failures(const Table& table) {
  size_t failed = 0;
  for (const auto& row : table.rows)
    for (size_t k = 0; k < row.size(); ++k)
      if (table.columns[k].key == "status")
        failed += to_display(row[k]) == "missing" || to_display(row[k]) == "unconverged";
  return failed == 0 ? "" : fmt::format("{} of {}", failed, counted(table.rows.size(), "member"));
}

std::string add_sweep(const std::vector<SweptKey>& sweep, const std::vector<StudyRun>& members,
                      const std::string& runs_folder, StudyPage* page) {
  std::vector<std::string> keys;
  for (const SweptKey& swept : sweep) keys.push_back(swept.key);
  const Table table = sweep_table(keys, members, runs_folder);
  const std::string ended = endings(table);
  const std::string failed = failures(table);
  page->add(verdict_html(failed.empty() ? ended + "." : failed + " failed",
                         failed.empty() ? counted(members.size(), "member") + "." : ended + ".",
                         failed.empty()));
  if (const Figure figure = sweep_figure(sweep, table); !figure.commands.empty()) page->add_figures({figure});
  page->add_table(table);
  page->add_report_links(members, runs_folder);
  return fmt::format("{}\n{}: {}\n", aligned_text(table), counted(members.size(), "member"), ended);
}

}  // namespace cupola

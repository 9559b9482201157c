// Computes the rows of the verification manual and writes it.
//
//   verification_table FOLDER [PAGE.md]     all rows: FOLDER/verification.html, and the same text as PAGE.md
//   verification_table --quick FOLDER       without the slow rows
//
// Exit code 1 if a row fails.

#include <algorithm>
#include <cstdio>
#include <optional>
#include <set>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/base/process.hpp"
#include "assembly/files/atomic_file.hpp"
#include "assembly/program/program.hpp"
#include "tests/arguments.hpp"
#include "tests/verification/document.hpp"
#include "tests/verification/row_processes.hpp"
#include "tests/verification/verification_row.hpp"

namespace cupola::verification {
namespace {

/// A row with its result; none for a slow row that was left out.
struct ManualRow {
  const Reference* problem;
  const ReferenceRow* row;
  std::optional<RowResult> result;
  bool failed() const { return result && !result->passed; }
};

/// Enough digits to see the last one of the reference.
std::string shown_number(const ManualRow& r) {
  if (!r.result) return "-";
  if (!r.result->failure.empty()) return "none";
  int digits = 0;
  const std::string& text = r.row->expected_text;
  for (const char c : text.substr(0, text.find_first_of("e "))) digits += c >= '0' && c <= '9';
  return r.row->expected_text == "0" ? fmt::format("{:.2e}", r.result->computed)
                                     : fmt::format("{:.{}g}", r.result->computed, std::clamp(digits, 5, 12));
}

std::string verdict(const ManualRow& r) {
  return !r.result ? "not run" : r.result->passed ? "passed" : "FAILS";
}

void print_row(const ManualRow& r) {
  fmt::print("{:<8} {:7.1f} s  {} ({}): {}, expected {}{}\n", verdict(r),
             r.result ? r.result->cpu_seconds : 0.0, r.problem->id, r.row->name(), shown_number(r),
             r.row->expected_text, r.result ? ". " + r.result->failure : "");
  std::fflush(stdout);
}

/// Computes the rows, as many at a time as there are processors. A row that crashes its process fails.
std::vector<ManualRow> compute_rows(bool quick) {
  std::vector<ManualRow> rows;
  for (const Reference& problem : references())
    for (const ReferenceRow& row : problem.rows) rows.push_back({&problem, &row, {}});
  std::vector<int> chosen;
  for (int i = 0; i < static_cast<int>(rows.size()); ++i)
    if (!quick || !rows[i].row->slow) chosen.push_back(i);
  const auto compute = [&](int task) {
    ManualRow row = rows[chosen[task]];
    row.result = run_row(*row.problem, *row.row);
    print_row(row);
    return *row.result;
  };
  const std::vector<RowResult> results = run_in_processes(static_cast<int>(chosen.size()), compute);
  for (size_t task = 0; task < chosen.size(); ++task) rows[chosen[task]].result = results[task];
  return rows;
}

const std::vector<std::pair<std::string, std::string>>& chapters() {
  static const std::vector<std::pair<std::string, std::string>> all{
      {"code", "Code verification: are the equations solved?"},
      {"solution", "Solution verification: how large are discretisation and solver errors?"},
      {"validation", "Validation: do the equations describe what others published?"}};
  return all;
}

Table counts(const std::vector<ManualRow>& rows) {
  Table t{"counts",
          "",
          {{"part", "", "part"},
           {"problems", "", "problems"},
           {"rows", "", "rows"},
           {"passed", "", "passed"},
           {"failed", "", "failed"},
           {"not_run", "", "not run"}},
          {}};
  for (const auto& [chapter, title] : chapters()) {
    std::set<std::string> problems;
    int all = 0, passed = 0, failed = 0;
    for (const ManualRow& r : rows) {
      if (r.problem->chapter != chapter) continue;
      problems.insert(r.problem->id);
      ++all;
      passed += r.result && r.result->passed;
      failed += r.failed();
    }
    t.rows.push_back({title.substr(0, title.find(':')), static_cast<int>(problems.size()), all, passed,
                      failed, all - passed - failed});
  }
  return t;
}

void write_problem(const Reference& problem, const std::vector<ManualRow>& rows, Document* out) {
  out->heading(4, problem.title);
  out->paragraph(problem.statement);
  Table about{"about", "", {{"about", "", ""}, {"text", "", ""}}, {}};
  about.rows = {{std::string("quantity"), problem.quantity},
                {std::string("reference"), problem.source},
                {std::string("tolerance"),
                 fmt::format("{:g} ({}): {}", problem.tolerance, problem.error, problem.reason)}};
  out->table(about);
  Table t{"rows",
          "",
          {{"row", "", "row"},
           {"expected", "", "expected"},
           {"computed", "", "computed"},
           {"error", "", "error"},
           {"tolerance", "", "tolerance"},
           {"verdict", "", "verdict"}},
          {}};
  for (const ManualRow& r : rows) {
    if (r.problem != &problem) continue;
    const bool number = r.result && r.result->failure.empty();
    t.rows.push_back({r.row->name().empty() ? std::string("-") : r.row->name(), r.row->expected_text,
                      shown_number(r), number ? fmt::format("{:.1e}", r.result->error) : std::string("-"),
                      fmt::format("{:.1e}", problem.tolerance), verdict(r)});
  }
  out->table(t);
}

/// Rows that fail, with the explanation of references.yaml if they have one.
void write_failures(const std::vector<ManualRow>& rows, Document* out) {
  out->heading(2, "Rows that fail");
  Table t{"failures",
          "",
          {{"row", "", "problem and row"},
           {"computed", "", "computed"},
           {"expected", "", "expected"},
           {"why", "", "reason"}},
          {}};
  for (const ManualRow& r : rows)
    if (r.failed())
      t.rows.push_back({r.problem->title + (r.row->name().empty() ? "" : ", " + r.row->name()),
                        r.result->failure.empty() ? shown_number(r) : r.result->failure, r.row->expected_text,
                        r.row->why.empty() ? std::string("not explained yet") : r.row->why});
  t.rows.empty() ? out->paragraph("None.") : out->table(t);
}

Document write_manual(const std::vector<ManualRow>& rows) {
  Document out;
  out.heading(1, "Verification manual");
  out.paragraph(
      "Each row compares a result with a value that this program did not produce, and is a test (`ctest -R "
      "verification/`). `make -f Makefile.cases verification` writes this page from "
      "`tests/verification/references.yaml`. \"The same\" refers to the problem before.");
  out.table(counts(rows));
  write_failures(rows, &out);
  for (const auto& [chapter, title] : chapters()) {
    out.heading(2, title);
    std::string group;
    for (const Reference& problem : references()) {
      if (problem.chapter != chapter) continue;
      if (problem.group != group) out.heading(3, problem.group);
      group = problem.group;
      write_problem(problem, rows, &out);
    }
  }
  for (const auto& [list, title] :
       {std::pair("other_tests", "Other tests"), std::pair("not_verified", "What is not verified")}) {
    out.heading(2, title);
    for (const auto& [topic, text] : manual_text(list)) out.paragraph(topic + ". " + text);
  }
  return out;
}

ExitCode make_manual(bool quick, const std::string& folder, const std::string& page) {
  const double start = wall_seconds();
  const std::vector<ManualRow> rows = compute_rows(quick);
  Document manual = write_manual(rows);
  manual.paragraph(
      fmt::format("Written by {}{}.", program_version(), quick ? ", without the slow rows" : ""));
  if (!page.empty()) {
    // A page says which sources its numbers come from, so they must be sources that somebody else can get.
    if (program_version().ends_with("-dirty)"))
      throw InputError(FileLocation{page}, "not written: the sources are changed; commit them first");
    write_text_atomically(page, manual.markdown());
  }
  make_folder(folder);
  write_text_atomically(folder + "/verification.html", manual.html("Verification manual of Cupola"));
  const auto failed = std::ranges::count_if(rows, &ManualRow::failed);
  const auto run = std::ranges::count_if(rows, [](const ManualRow& r) { return r.result.has_value(); });
  fmt::print("{} of {} rows failed, {} were not run; {:.0f} s; the manual is {}/verification.html\n", failed,
             run, std::ssize(rows) - run, wall_seconds() - start, folder);
  return failed == 0 ? ExitCode::done : ExitCode::failed;
}

}  // namespace
}  // namespace cupola::verification

int main(int argc, char** argv) {
  return cupola::run_program("verification_table", [&] {
    const bool quick = argc > 1 && std::string(argv[1]) == "--quick";
    const auto arguments = cupola::read_arguments(argc - quick, argv + quick, 1, quick ? 1 : 2,
                                                  "verification_table [--quick] FOLDER [PAGE.md]");
    return cupola::verification::make_manual(quick, arguments[0], arguments.size() > 1 ? arguments[1] : "");
  });
}

#include "postproc/studies/study_table.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/files/number_text.hpp"
#include "assembly/model/status.hpp"
#include "postproc/studies/study_run.hpp"

namespace cupola {
namespace {

void declare_column(Section& s, StudyColumn& column) {
  s.text("heading", column.heading, "of the column, with its unit");
  s.rule(!column.heading.empty(), "heading", "must be given");
  if (s.gives("texts")) return s.texts("texts", column.texts, "the cells, one per row");
  if (s.gives("text")) {
    RunText text = RunText::run;
    s.choice("text", text, "what is shown of the run");
    column.text = text;
    return;
  }
  if (s.gives("cell")) {
    s.text("cell", column.cell, "column of the table that gives the rows");
  } else {
    declare_row_quantity(s, column.value);
    s.optional_section("over", column.over, "divisor of the value", declare_row_quantity);
    s.optional_section("minus", column.minus, "subtracted after the division", declare_row_quantity);
    std::string absent;
    s.text("absent", absent, "cell of a run that lacks the number");
    if (s.gives("absent")) column.absent = absent;
  }
  s.number("scale", column.scale, {}, "factor from the SI value to the unit of the heading");
  s.integer("digits", column.digits, {.min = 0, .max = 17}, "significant digits on the page");
}

Quantity of_row(Quantity quantity, const std::string& run) {
  for (std::string& name : quantity.runs) name = filled(name, "{run}", run);
  quantity.reference = filled(quantity.reference, "{run}", run);
  return quantity;
}

std::vector<Quantity> quantities_of(const StudyColumn& column, const std::string& run) {
  std::vector<Quantity> out;
  if (!column.texts.empty() || column.text || !column.cell.empty()) return out;
  out.push_back(of_row(column.value, run));
  if (column.over) out.push_back(of_row(*column.over, run));
  if (column.minus) out.push_back(of_row(*column.minus, run));
  return out;
}

double number_of(const StudyColumn& column, const std::string& run, RunCache& cache) {
  double number = evaluate(of_row(column.value, run), cache);
  if (column.over) number /= evaluate(of_row(*column.over, run), cache);
  if (column.minus) number -= evaluate(of_row(*column.minus, run), cache);
  return column.scale * number + 0.0;  // no negative zero
}

/// Why the numbers of a column are not to be used; empty: they are.
std::string flaw_of(const StudyColumn& column, const std::string& run, RunCache& cache) {
  std::string flaw;
  for (const Quantity& quantity : quantities_of(column, run))
    for (const std::string& name : runs_of(quantity)) {
      if (!cache.finished(name)) return "not run";
      if (missed(cache.run(name).status())) flaw = cache.run(name).status();
    }
  return flaw;
}

/// How the numbers of a column were found: tables of some analyses have columns that others lack, but a name
/// that none has is misspelt.
struct Lookups {
  int found = 0;
  std::optional<UnknownColumn> unknown;
};

Table::Cell cell_of(const StudyColumn& column, const std::string& run, RunCache& cache, Lookups* lookups) {
  if (column.text) {
    if (*column.text == RunText::run) return run.substr(run.rfind('/') + 1);
    if (!cache.finished(run)) return std::string("not run");
    if (*column.text == RunText::verdict) return cache.run(run).answer("verdict.words");
    return *column.text == RunText::status ? cache.run(run).status() : cache.run(run).message();
  }
  if (const std::string flaw = flaw_of(column, run, cache); !flaw.empty()) return flaw;
  if (!column.absent) return number_of(column, run, cache);
  try {
    const double number = number_of(column, run, cache);
    ++lookups->found;
    return number;
  } catch (const UnknownColumn& error) {
    lookups->unknown = error;
  } catch (const InputError&) {  // the run has no such number
  }
  const std::string name = of_row(column.value, run).runs.front();
  return filled(*column.absent, "{reason}", cache.run(name).found_instead());
}

/// A cell of a CSV file: a number if it is one.
Table::Cell cell_of_text(const std::string& text, double scale = 1.0) {
  double value = 0.0;
  if (!read_number(text, &value).empty()) return text;
  return scale * value;
}

std::string page_text(const Table::Cell& cell, int digits) {
  if (const auto* text = std::get_if<std::string>(&cell)) return filled(*text, "|", "/");
  const double value = std::get<double>(cell);
  if (std::isnan(value)) return "";
  if (value == std::round(value) && std::abs(value) < 1e15) return fmt::format("{:.0f}", value + 0.0);
  return fmt::format("{:.{}g}", value, digits);
}

}  // namespace

void declare_study_table(Section& s, StudyTable& table) {
  s.text("name", table.name, "of its CSV file, and of its place on the page");
  s.text("page", table.page, "page of the documentation that shows the table");
  s.integer("digits", table.digits, {.min = 1, .max = 17}, "significant digits on the page");
  declare_names(s, "runs", table.runs, "one row each; without it all runs of the study");
  s.text("rows", table.rows, "CSV file of post/ that gives the rows, without extension");
  s.flag("transposed", table.transposed, "columns become rows of the page; the first one is the header");
  s.list("columns", table.columns, "one entry per column; without them the study's script prints the table",
         declare_column);
  s.rule(is_plain_name(table.name), "name", "must be given, of letters, digits and . _ + -");
  const bool fits = std::ranges::all_of(table.columns, [&](const StudyColumn& column) {
    return column.texts.empty() || column.texts.size() == table.runs.size();
  });
  s.rule(fits, "columns", "`texts` must have one text for each of `runs`");
  s.rule(table.rows.empty() == std::ranges::all_of(table.columns, &std::string::empty, &StudyColumn::cell),
         "rows", "must be given with columns that have `cell`, and only then");
  s.rule(table.rows.empty() || table.runs.size() == 1, "runs", "must be one run if `rows` is given");
}

std::vector<std::string> runs_of(const StudyTable& table) {
  std::vector<std::string> runs;
  // A row may be named by what the names of its runs share: dome of dome_thrust and dome_friction.
  const bool reads_row = !table.rows.empty() || table.columns.empty() ||
                         std::ranges::any_of(table.columns, [](const StudyColumn& column) {
                           return column.text && *column.text != RunText::run;
                         });
  for (const std::string& run : table.runs) {
    if (reads_row) runs.push_back(run);
    for (const StudyColumn& column : table.columns)
      for (const Quantity& quantity : quantities_of(column, run))
        for (const std::string& name : runs_of(quantity)) runs.push_back(name);
  }
  return runs;
}

Table measured_table(const StudyTable& table, RunCache& cache) {
  Table out{table.name, "", {}, {}};
  for (const StudyColumn& column : table.columns) out.columns.push_back({column.heading, "", column.heading});
  if (!table.rows.empty()) {
    if (!cache.finished(table.runs.front())) return out;
    const CsvFile& csv = cache.run(table.runs.front()).table(table.rows);
    for (const auto& row : csv.rows) {
      std::vector<Table::Cell>& cells = out.rows.emplace_back();
      for (const StudyColumn& column : table.columns)
        cells.push_back(cell_of_text(row[csv.column(column.cell)], column.scale));
    }
    return out;
  }
  out.rows.resize(table.runs.size());
  for (const StudyColumn& column : table.columns) {
    Lookups lookups;
    for (size_t i = 0; i < table.runs.size(); ++i)
      out.rows[i].push_back(column.texts.empty() ? cell_of(column, table.runs[i], cache, &lookups)
                                                 : column.texts[i]);
    if (lookups.unknown && lookups.found == 0) throw UnknownColumn(*lookups.unknown);
  }
  return out;
}

Table printed_table(const StudyTable& table, const std::string& csv_path) {
  const CsvFile csv = read_csv(csv_path);
  Table out{table.name, "", {}, {}};
  for (const std::string& column : csv.columns) out.columns.push_back({column, "", column});
  for (const auto& row : csv.rows) {
    std::vector<Table::Cell>& cells = out.rows.emplace_back();
    for (const std::string& text : row) cells.push_back(cell_of_text(text));
  }
  return out;
}

std::string to_markdown(const StudyTable& table, const Table& measured) {
  std::vector<std::vector<std::string>> lines(1);
  for (const Table::Column& column : measured.columns) lines[0].push_back(filled(column.key, "|", "/"));
  for (const auto& row : measured.rows) {
    std::vector<std::string>& line = lines.emplace_back();
    for (size_t k = 0; k < row.size(); ++k) {
      const int own = k < table.columns.size() ? table.columns[k].digits : 0;
      line.push_back(page_text(row[k], own > 0 ? own : table.digits));
    }
  }
  if (table.transposed) {
    std::vector<std::vector<std::string>> turned(lines[0].size());
    for (const auto& line : lines)
      for (size_t k = 0; k < line.size(); ++k) turned[k].push_back(line[k]);
    lines = std::move(turned);
  }
  std::string out;
  for (size_t i = 0; i < lines.size(); ++i) {
    out += fmt::format("| {} |\n", fmt::join(lines[i], " | "));
    if (i == 0) out += fmt::format("|{}\n", filled(std::string(lines[0].size(), 'x'), "x", "---|"));
  }
  return out;
}

}  // namespace cupola

#include "postproc/claims/quantity.hpp"

#include <algorithm>
#include <cmath>
#include <sstream>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/base/error.hpp"

namespace cupola {
namespace {

void declare_filter(Section& s, RowFilter& filter) {
  s.text("column", filter.column, "column of the table");
  s.text("is", filter.is, "text that the column must equal");
  s.optional_number("from", filter.from, {}, "no lower limit", "smallest number selected");
  s.optional_number("to", filter.to, {}, "no upper limit", "largest number selected");
  s.rule(!filter.column.empty(), "column", "must be given");
  s.rule(filter.is.empty() || (!filter.from && !filter.to), "is", "cannot be combined with `from` or `to`");
}

void declare_source(Section& s, Quantity& quantity, std::string runs) {
  s.text("runs", runs, "cases or variants, separated by spaces");
  quantity.runs = words(runs);
  s.text("key", quantity.key, "entry of results/summary.json or post/summary.json, or a key of the case");
  s.text("status", quantity.status, "share of the runs that ended with this status");
  s.text("table", quantity.table, "CSV file of post/, or results/NAME, without extension");
  s.text("column", quantity.column, "column of the table");
  s.text("against", quantity.against, "other column, for `take: linearity`");
  s.text("reference", quantity.reference, "run whose column is subtracted first, row by row");
  s.list("where", quantity.where, "filters that select rows of the table", declare_filter);
  s.choice("take", quantity.take, "how several values are reduced to one");
  const int sources = !quantity.key.empty() + !quantity.status.empty() + !quantity.table.empty();
  s.rule(!quantity.runs.empty(), "runs", "must name at least one case");
  s.rule(sources == 1, "key", "give exactly one of `key`, `status` and `table`");
  s.rule(quantity.table.empty() == quantity.column.empty(), "column",
         "`table` and `column` must be given together");
  s.rule(!quantity.table.empty() || quantity.where.empty(), "where", "requires `table`");
  s.rule(!quantity.table.empty() || quantity.reference.empty(), "reference", "requires `table`");
  s.rule((quantity.take == Take::linearity) == !quantity.against.empty(), "against",
         "must be given with `take: linearity`, and only then");
}

bool passes(const CsvFile& table, size_t row, const std::vector<RowFilter>& filters) {
  for (const RowFilter& filter : filters) {
    const size_t column = table.column(filter.column);
    if (!filter.is.empty()) {
      if (table.rows[row][column] != filter.is) return false;
      continue;
    }
    const double value = table.number(row, column);
    if (filter.from && !(value >= *filter.from)) return false;  // an empty cell is in no range
    if (filter.to && !(value <= *filter.to)) return false;
  }
  return true;
}

struct Values {
  std::vector<double> values, against;
};

void append_rows(const Quantity& quantity, const std::string& name, RunCache& cache, Values* out) {
  const CsvFile& table = cache.run(name).table(quantity.table);
  const CsvFile* reference =
      quantity.reference.empty() ? nullptr : &cache.run(quantity.reference).table(quantity.table);
  if (reference && reference->rows.size() != table.rows.size())
    throw InputError(fmt::format("table {} has {} in {} but {} in its reference {}", quantity.table,
                                 counted(table.rows.size(), "row"), name, reference->rows.size(),
                                 quantity.reference));
  const size_t column = table.column(quantity.column);
  for (const RowFilter& filter : quantity.where) table.column(filter.column);  // even if no row is read
  for (size_t row = 0; row < table.rows.size(); ++row) {
    if (!passes(table, row, quantity.where)) continue;
    double value = table.number(row, column);
    if (reference) value -= reference->number(row, reference->column(quantity.column));
    if (std::isnan(value)) continue;  // an empty cell: the row lacks the quantity
    out->values.push_back(value);
    if (!quantity.against.empty()) out->against.push_back(table.number(row, table.column(quantity.against)));
  }
}

}  // namespace

std::vector<std::string> words(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> out;
  for (std::string word; stream >> word;) out.push_back(word);
  return out;
}

void declare_quantity(Section& s, Quantity& quantity) {
  declare_source(s, quantity, "");
}

void declare_row_quantity(Section& s, Quantity& quantity) {
  declare_source(s, quantity, "{run}");
}

double evaluate(const Quantity& quantity, RunCache& cache) {
  Values v;
  for (const std::string& name : quantity.runs) {
    if (!quantity.status.empty())
      v.values.push_back(cache.run(name).status() == quantity.status ? 1.0 : 0.0);
    else if (!quantity.key.empty())
      v.values.push_back(cache.run(name).number(quantity.key));
    else
      append_rows(quantity, name, cache, &v);
  }
  const std::string source = quantity.key + quantity.table + " of " + quantity.runs.front();
  const bool may_be_empty = quantity.take == Take::sum || quantity.take == Take::count;
  if (v.values.empty() && !may_be_empty)
    throw InputError(fmt::format("`where` selects no row of {}", source));
  const Take take = quantity.status.empty() ? quantity.take : Take::mean;
  if (take == Take::only && v.values.size() != 1)
    throw InputError(fmt::format("{} in {}; choose how to reduce them with `take`",
                                 counted(v.values.size(), "value"), source));
  return reduce(take, v.values, v.against);
}

std::vector<std::string> runs_of(const Quantity& quantity) {
  std::vector<std::string> runs = quantity.runs;
  if (!quantity.reference.empty()) runs.push_back(quantity.reference);
  return runs;
}

}  // namespace cupola

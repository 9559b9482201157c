#include "postproc/claims/verdict.hpp"

#include <algorithm>
#include <set>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "postproc/tables/run_files.hpp"

namespace cupola {
namespace {

bool passes(const CsvFile& table, size_t row, const std::vector<RowFilter>& filters) {
  for (const RowFilter& filter : filters) {
    const size_t column = table.column(filter.column);
    if (!filter.is.empty()) {
      if (table.rows[row][column] != filter.is) return false;
      continue;
    }
    const double value = table.number(row, column);
    if (filter.from && value < *filter.from) return false;
    if (filter.to && value > *filter.to) return false;
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
    throw InputError(fmt::format("claims: table {} has {} rows in {} but {} in its reference {}",
                                 quantity.table, table.rows.size(), name, reference->rows.size(),
                                 quantity.reference));
  const size_t column = table.column(quantity.column);
  for (size_t row = 0; row < table.rows.size(); ++row) {
    if (!passes(table, row, quantity.where)) continue;
    out->values.push_back(table.number(row, column));
    if (reference) out->values.back() -= reference->number(row, reference->column(quantity.column));
    if (!quantity.against.empty()) out->against.push_back(table.number(row, table.column(quantity.against)));
  }
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
  if (v.values.empty()) throw InputError(fmt::format("claims: `where` selects no row of {}", source));
  const Take take = quantity.status.empty() ? quantity.take : Take::mean;
  if (take == Take::only && v.values.size() != 1)
    throw InputError(fmt::format("claims: {} values in {}; choose how to reduce them with `take`",
                                 v.values.size(), source));
  return reduce(take, v.values, v.against);
}

/// The runs that a quantity reads, including its reference.
std::vector<std::string> runs_of(const Quantity& quantity) {
  std::vector<std::string> runs = quantity.runs;
  if (!quantity.reference.empty()) runs.push_back(quantity.reference);
  return runs;
}

std::vector<const Quantity*> quantities(const Claim& claim) {
  std::vector<const Quantity*> out{&claim.value};
  if (claim.over) out.push_back(&*claim.over);
  if (claim.minus) out.push_back(&*claim.minus);
  return out;
}

std::string listed(const std::set<std::string>& names) {
  return fmt::format("{}", fmt::join(names, " "));
}

ClaimResult evaluate(const Claim& claim, RunCache& cache) {
  std::set<std::string> missing, unsolved;
  for (const Quantity* quantity : quantities(claim))
    for (const std::string& name : runs_of(*quantity)) {
      if (!cache.finished(name))
        missing.insert(name);
      else if (quantity->status != "unconverged" && cache.run(name).status() == "unconverged")
        unsolved.insert(name);
    }
  if (!missing.empty()) return {Verdict::not_run, std::nullopt, "not run: " + listed(missing)};
  if (!unsolved.empty()) return {Verdict::not_solved, std::nullopt, "not solved: " + listed(unsolved)};

  double number = evaluate(claim.value, cache);
  if (claim.over) number /= evaluate(*claim.over, cache);
  if (claim.minus) number -= evaluate(*claim.minus, cache);
  if (!claim.open.empty()) return {Verdict::open, number, claim.open};
  const bool holds = (!claim.at_least || number >= *claim.at_least) &&
                     (!claim.at_most || number <= *claim.at_most);  // false for NaN
  return {holds ? Verdict::reproduced : Verdict::not_reproduced, number, ""};
}

}  // namespace

std::vector<std::string> needed_runs(const ClaimsFile& file) {
  std::vector<std::string> runs;
  const auto add = [&runs](const std::string& name) {
    if (std::find(runs.begin(), runs.end(), name) == runs.end()) runs.push_back(name);
  };
  for (const Claim& claim : file.claims)
    for (const Quantity* quantity : quantities(claim))
      for (const std::string& name : runs_of(*quantity)) add(name);
  for (const ClaimFigure& figure : file.figures) add(figure.run);
  return runs;
}

std::vector<ClaimResult> evaluate_claims(const std::vector<Claim>& claims, const std::string& out) {
  RunCache cache(out);
  std::vector<ClaimResult> results;
  for (const Claim& claim : claims) results.push_back(evaluate(claim, cache));
  return results;
}

}  // namespace cupola

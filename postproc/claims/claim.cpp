#include "postproc/claims/claim.hpp"

#include <sstream>

#include "assembly/base/error.hpp"
#include "assembly/case/case_tree.hpp"
#include "assembly/case/section.hpp"

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

std::vector<std::string> words(const std::string& text) {
  std::istringstream stream(text);
  std::vector<std::string> out;
  for (std::string word; stream >> word;) out.push_back(word);
  return out;
}

void declare_quantity(Section& s, Quantity& quantity) {
  std::string runs;
  s.text("runs", runs, "cases or variants, separated by spaces");
  quantity.runs = words(runs);
  s.text("key", quantity.key, "entry of results/summary.json or post/summary.json");
  s.text("status", quantity.status, "share of the runs that ended with this status");
  s.text("table", quantity.table, "CSV file of post/, without extension");
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

void declare_claim(Section& s, Claim& claim) {
  s.text("source", claim.source, "section and figure of the publication");
  s.text("says", claim.says, "the claim in words");
  s.text("number", claim.number, "the number in words");
  s.text("unit", claim.unit, "of the number");
  s.text("open", claim.open, "replaces the verdict: why there are no limits, or what the number means");
  s.text("note", claim.note, "remark for the reader");
  s.section("value", claim.value, "the number that tests the claim", declare_quantity);
  s.optional_section("over", claim.over, "divisor of the value", declare_quantity);
  s.optional_section("minus", claim.minus, "subtracted after the division", declare_quantity);
  s.optional_number("at_least", claim.at_least, {}, "no lower limit", "lower limit of the claim");
  s.optional_number("at_most", claim.at_most, {}, "no upper limit", "upper limit of the claim");
  s.rule(!claim.says.empty(), "says", "must be given");
  s.rule(!claim.open.empty() || claim.at_least || claim.at_most, "at_least",
         "give at least one of `at_least`, `at_most` and `open`");
}

void declare_figure(Section& s, ClaimFigure& figure) {
  s.text("source", figure.source, "figure of the publication");
  s.text("shows", figure.shows, "caption: what to look at");
  s.text("run", figure.run, "case or variant that the picture shows");
  s.text("picture", figure.picture, "file below the folder post/ of the run");
  s.rule(!figure.source.empty(), "source", "must be given");
  s.rule(!figure.run.empty(), "run", "must name a case");
  s.rule(!figure.picture.empty(), "picture", "must name a file");
}

}  // namespace

ClaimsFile read_claims(const std::string& path) {
  const CaseNode tree = load_case_tree(path, {});
  ClaimsFile file;
  Section root(&tree, "", tree.where, path);
  root.text("title", file.title, "of the publication");
  root.list("claims", file.claims, "one entry per claim", declare_claim);
  root.list("figures", file.figures, "one entry per figure", declare_figure);
  root.finish();
  if (file.claims.empty())
    throw InputError(FileLocation{path}, "contains no claims; list at least one under `claims`");
  return file;
}

}  // namespace cupola

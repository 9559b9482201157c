#include "postproc/claims/claim.hpp"

#include <sstream>

#include "assembly/base/error.hpp"
#include "assembly/case/case_tree.hpp"
#include "assembly/case/section.hpp"

namespace cupola {
namespace {

void declare_filter(Section& s, RowFilter& filter) {
  s.text("column", filter.column, "column of the table");
  s.text("is", filter.is, "its text");
  s.optional_number("from", filter.from, {}, "no lower limit", "smallest number that counts");
  s.optional_number("to", filter.to, {}, "no upper limit", "largest number that counts");
  s.rule(!filter.column.empty(), "column", "must be given");
  s.rule(filter.is.empty() || (!filter.from && !filter.to), "is", "goes without `from` and `to`");
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
  s.text("key", quantity.key, "of results/summary.json or post/summary.json");
  s.text("status", quantity.status, "share of the runs that ended so");
  s.text("table", quantity.table, "CSV of post/, without ending");
  s.text("column", quantity.column, "of the table");
  s.text("against", quantity.against, "linearity: the other column");
  s.text("reference", quantity.reference, "run whose column is subtracted first, row by row");
  s.list("where", quantity.where, "rows of the table that count", declare_filter);
  s.choice("take", quantity.take, "how several values become one");
  const int sources = !quantity.key.empty() + !quantity.status.empty() + !quantity.table.empty();
  s.rule(!quantity.runs.empty(), "runs", "must name at least one case");
  s.rule(sources == 1, "key", "give one of `key`, `status`, `table`");
  s.rule(quantity.table.empty() == quantity.column.empty(), "column", "goes with `table`");
  s.rule(!quantity.table.empty() || quantity.where.empty(), "where", "goes with `table`");
  s.rule(!quantity.table.empty() || quantity.reference.empty(), "reference", "goes with `table`");
  s.rule((quantity.take == Take::linearity) == !quantity.against.empty(), "against",
         "goes with `take: linearity`");
}

void declare_claim(Section& s, Claim& claim) {
  s.text("source", claim.source, "section and figure of the publication");
  s.text("says", claim.says, "the claim, in words");
  s.text("number", claim.number, "what the number is, in words");
  s.text("unit", claim.unit, "of the number");
  s.text("open", claim.open, "why the text leaves it open; no verdict then");
  s.text("note", claim.note, "what else a reader should know");
  s.section("value", claim.value, "the number", declare_quantity);
  s.optional_section("over", claim.over, "divides it", declare_quantity);
  s.optional_section("minus", claim.minus, "is subtracted after that", declare_quantity);
  s.optional_number("at_least", claim.at_least, {}, "no lower limit", "the claim holds from here");
  s.optional_number("at_most", claim.at_most, {}, "no upper limit", "the claim holds to here");
  s.rule(!claim.says.empty(), "says", "must be given");
  s.rule(!claim.open.empty() || claim.at_least || claim.at_most, "at_least",
         "give `at_least`, `at_most` or `open`");
}

void declare_figure(Section& s, ClaimFigure& figure) {
  s.text("source", figure.source, "figure of the publication");
  s.text("shows", figure.shows, "what to look at, in words");
  s.text("run", figure.run, "case or variant that it is a picture of");
  s.text("picture", figure.picture, "file below the run's folder post/");
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
  root.list("claims", file.claims, "one entry per sentence", declare_claim);
  root.list("figures", file.figures, "one entry per picture", declare_figure);
  root.finish();
  if (file.claims.empty()) throw InputError(FileLocation{path}, "holds no claims");
  return file;
}

}  // namespace cupola

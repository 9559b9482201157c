#include "postproc/claims/claim.hpp"

#include <algorithm>
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

void declare_paper_limits(Section& s, ClaimLimits& limits) {
  s.optional_number("at_least", limits.at_least, {}, "no lower limit", "lower limit of the claim");
  s.optional_number("at_most", limits.at_most, {}, "no upper limit", "upper limit of the claim");
}

void declare_our_limits(Section& s, ClaimLimits& limits) {
  declare_paper_limits(s, limits);
  s.text("reason", limits.reason, "why these numbers");
  s.rule(limits.reason.empty() != (limits.at_least || limits.at_most), "reason",
         "a limit chosen here must state its reason");
}

void declare_also(Section& s, NamedQuantity& also) {
  s.text("name", also.name, "placeholder in the note");
  s.section("value", also.value, "number that the note shows", declare_quantity);
  s.optional_section("over", also.over, "divisor of the value", declare_quantity);
  s.rule(!also.name.empty(), "name", "must be given");
}

/// True if the note takes every number from the runs: no digits, and only placeholders that have a value.
bool is_filled_by_runs(const Claim& claim) {
  if (claim.note.find_first_of("0123456789") != std::string::npos) return false;
  for (const std::string& name : placeholders(claim.note)) {
    const bool named = std::any_of(claim.also.begin(), claim.also.end(),
                                   [&name](const NamedQuantity& a) { return a.name == name; });
    if (!named && name != "value" && name != "message" && !(name == "over" && claim.over) &&
        !(name == "minus" && claim.minus))
      return false;
  }
  return true;
}

void declare_claim(Section& s, Claim& claim) {
  s.text("source", claim.source, "section and figure of the publication");
  s.text("quote", claim.quote, "sentence of the publication, word for word");
  s.text("says", claim.says, "the claim in words");
  s.text("number", claim.number, "the number in words");
  s.text("unit", claim.unit, "of the number");
  s.text("note", claim.note, "remark for the reader; placeholders such as {value} stand for numbers");
  s.flag("open", claim.open, "show the number without a verdict");
  s.flag("each_run", claim.each_run,
         "evaluate every run of `value` by itself; all must lie within the limits");
  s.section("value", claim.value, "the number that tests the claim", declare_quantity);
  s.optional_section("over", claim.over, "divisor of the value", declare_quantity);
  s.optional_section("minus", claim.minus, "subtracted after the division", declare_quantity);
  s.list("also", claim.also, "further numbers that the note shows", declare_also);
  s.section("paper", claim.paper, "limits that the publication states", declare_paper_limits);
  s.section("ours", claim.ours, "limits chosen here", declare_our_limits);
  s.rule(!claim.says.empty(), "says", "must be given");
  const bool from_paper = claim.paper.at_least || claim.paper.at_most;
  const bool has_limits = from_paper || claim.ours.at_least || claim.ours.at_most;
  s.rule(has_limits != claim.open, "open", "give limits in `paper` or `ours`, or `open: true`, but not both");
  s.rule(!from_paper || !claim.quote.empty(), "quote", "must be given for limits of the publication");
  s.rule(!claim.over || !claim.each_run || claim.over->runs.size() == 1 ||
             claim.over->runs.size() == claim.value.runs.size(),
         "over", "must name one run, or as many as `value`, if `each_run` is set");
  s.rule(is_filled_by_runs(claim), "note",
         "must not contain digits; numbers come from {value}, {over}, {minus}, {message} and the names in "
         "`also`");
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

std::vector<std::string> placeholders(const std::string& text) {
  std::vector<std::string> names;
  for (size_t open = text.find('{'); open != std::string::npos; open = text.find('{', open + 1)) {
    const size_t close = text.find('}', open);
    // A brace that is not closed is no placeholder: the rest of the text is then a name that nothing has.
    names.push_back(close == std::string::npos ? text.substr(open) : text.substr(open + 1, close - open - 1));
  }
  return names;
}

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

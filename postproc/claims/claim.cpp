#include "postproc/claims/claim.hpp"

#include <algorithm>

namespace cupola {
namespace {

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
  s.text("copy", figure.copy, "file of the documentation that the picture replaces");
  s.rule(!figure.run.empty(), "run", "must name a case");
  s.rule(!figure.picture.empty(), "picture", "must name a file");
}

std::vector<const Quantity*> quantities(const Claim& claim) {
  std::vector<const Quantity*> out{&claim.value};
  if (claim.over) out.push_back(&*claim.over);
  if (claim.minus) out.push_back(&*claim.minus);
  for (const NamedQuantity& also : claim.also) {
    out.push_back(&also.value);
    if (also.over) out.push_back(&*also.over);
  }
  return out;
}

std::vector<std::string> needed_runs(const std::vector<Claim>& claims,
                                     const std::vector<ClaimFigure>& figures) {
  std::vector<std::string> runs;
  const auto add = [&runs](const std::string& name) {
    if (std::find(runs.begin(), runs.end(), name) == runs.end()) runs.push_back(name);
  };
  for (const Claim& claim : claims)
    for (const Quantity* quantity : quantities(claim))
      for (const std::string& name : runs_of(*quantity)) add(name);
  for (const ClaimFigure& figure : figures) add(figure.run);
  return runs;
}

}  // namespace cupola

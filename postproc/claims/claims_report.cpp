#include "postproc/claims/claims_report.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/base/error.hpp"
#include "postproc/report/html.hpp"

namespace cupola {
namespace {

/// "at least 1 and at most 2 (paper)"; "" without limits.
std::string limits_text(const ClaimLimits& limits, const std::string& origin) {
  std::string out;
  if (limits.at_least) out += "at least " + to_display(*limits.at_least);
  if (limits.at_most) out += (out.empty() ? "at most " : " and at most ") + to_display(*limits.at_most);
  return out.empty() ? out : fmt::format("{} ({})", out, origin);
}

/// The limits with their origin; "" for an open question.
std::string range(const Claim& claim) {
  const std::string paper = limits_text(claim.paper, "paper"), ours = limits_text(claim.ours, "ours");
  return paper.empty() || ours.empty() ? paper + ours : paper + ", " + ours;
}

/// The value with unit; over several runs the mean, smallest and largest.
std::string shown_number(const Claim& claim, const ClaimResult& result) {
  if (!result.number) return "-";
  std::string text = to_display(*result.number) + (claim.unit.empty() ? "" : " " + claim.unit);
  if (result.numbers.size() < 2) return text;
  const auto [smallest, largest] = std::minmax_element(result.numbers.begin(), result.numbers.end());
  return fmt::format("{} ({} to {} in {})", text, to_display(*smallest), to_display(*largest),
                     counted(result.numbers.size(), "run"));
}

std::string remark(const ClaimResult& result) {
  return result.reason.empty() || result.note.empty() ? result.reason + result.note
                                                      : result.reason + " " + result.note;
}

std::string counts(const std::vector<ClaimResult>& results) {
  std::string out = counted(results.size(), "claim");
  const char* separator = ": ";
  for (const std::string& verdict : names_of<Verdict>()) {
    int count = 0;
    for (const ClaimResult& result : results) count += to_string(result.verdict) == verdict;
    if (count == 0) continue;
    out += fmt::format("{}{} {}", separator, count, verdict);
    separator = ", ";
  }
  return out;
}

/// Text broken into lines of at most `width` characters, each preceded by `indent`.
std::string wrapped_text(const std::string& text, size_t width, const std::string& indent) {
  std::string out, line;
  for (size_t start = 0; start < text.size();) {
    const size_t end = std::min(text.find(' ', start), text.size());
    const std::string word = text.substr(start, end - start);
    if (!line.empty() && line.size() + 1 + word.size() > width) {
      out += indent + line + "\n";
      line.clear();
    }
    if (!word.empty()) line += (line.empty() ? "" : " ") + word;
    start = end + 1;
  }
  return line.empty() ? out : out + indent + line + "\n";
}

constexpr const char* kClaimsStyle = R"(<style>
table.claims { width: 100%; table-layout: fixed }
.claims th, .claims td { text-align: left; padding: .45rem .6rem }
.claims col:nth-child(1) { width: 9.5rem } .claims col:nth-child(2) { width: 6.5rem }
.claims col:nth-child(4) { width: 38% }
.claims p { margin: 0 0 .25rem } .claims blockquote { margin: 0 0 .25rem; color: var(--soft); font-style: italic }
.claims .value { font-weight: 600 } .claims .small { color: var(--soft); font-size: .8rem }
.claims td.good { color: var(--good); font-weight: 600 } .claims td.bad { color: var(--bad); font-weight: 600 }
@media (max-width: 800px) {
  .claims, .claims tbody, .claims tr, .claims td { display: block } .claims tr:first-child { display: none }
  .claims td { border: 0; padding: .1rem 0 } .claims tr { border-bottom: 1px solid var(--line); padding: .6rem 0 }
}
</style>
)";

std::string paragraph(const char* css, const std::string& text) {
  return text.empty() ? text : fmt::format("<p class=\"{}\">{}</p>", css, html_text(text));
}

std::string claim_row(const Claim& claim, const ClaimResult& result) {
  const bool good = result.verdict == Verdict::reproduced || result.verdict == Verdict::holds;
  const bool undecided = result.verdict == Verdict::open || result.verdict == Verdict::not_run;
  std::string statement = paragraph("", claim.says);
  if (!claim.quote.empty()) statement += fmt::format("<blockquote>“{}”</blockquote>", html_text(claim.quote));
  statement += paragraph("small", remark(result));
  std::string number = paragraph("value", shown_number(claim, result)) + paragraph("", claim.number);
  number += paragraph("small", limits_text(claim.paper, "paper"));
  number += paragraph("small", limits_text(claim.ours, "ours: " + claim.ours.reason));
  return fmt::format("<tr><td class=\"{}\">{}</td><td>{}</td><td>{}</td><td>{}</td></tr>\n",
                     good        ? "good"
                     : undecided ? "open"
                                 : "bad",
                     to_string(result.verdict), html_text(claim.source), statement, number);
}

}  // namespace

Table claims_table(const std::vector<Claim>& claims, const std::vector<ClaimResult>& results) {
  CUPOLA_ASSERT(results.size() == claims.size());
  Table t{"claims", "Claims and results", {}, {}};
  t.columns = {{"source", "", "section and figure of the publication"},
               {"claim", "", "the statement"},
               {"quote", "", "sentence of the publication; empty for a statement of our own"},
               {"number", "", "the number that tests it"},
               {"value", "", "mean if there are several runs; empty if a run is missing or not solved"},
               {"smallest", "", "of the runs"},
               {"largest", "", "of the runs"},
               {"unit", "", "of the value"},
               {"limits", "", "limits within which the claim holds, and their origin"},
               {"reason", "", "why limits chosen here have these values"},
               {"verdict", "", "outcome"},
               {"remark", "", "runs that are missing, not solved or outside the limits; note"}};
  for (size_t i = 0; i < claims.size(); ++i) {
    const Claim& claim = claims[i];
    const std::vector<double>& numbers = results[i].numbers;
    Table::Cell value = std::string(), smallest = std::string(), largest = std::string();
    if (results[i].number) {
      value = *results[i].number;
      smallest = *std::min_element(numbers.begin(), numbers.end());
      largest = *std::max_element(numbers.begin(), numbers.end());
    }
    t.rows.push_back({claim.source, claim.says, claim.quote, claim.number, value, smallest, largest,
                      claim.unit, range(claim), claim.ours.reason, to_string(results[i].verdict),
                      remark(results[i])});
  }
  return t;
}

std::string claims_text(const std::vector<Claim>& claims, const std::vector<ClaimResult>& results) {
  CUPOLA_ASSERT(results.size() == claims.size());
  constexpr size_t kWidth = 116;
  std::string out;
  for (size_t i = 0; i < claims.size(); ++i) {
    out += fmt::format("{:<26} {}\n", to_string(results[i].verdict), claims[i].source);
    out += wrapped_text(claims[i].says, kWidth, "    ");
    const std::string limits = range(claims[i]);
    out += wrapped_text(fmt::format("{}: {}{}", claims[i].number, shown_number(claims[i], results[i]),
                                    limits.empty() ? limits : ", required " + limits),
                        kWidth, "      ");
    out += wrapped_text(remark(results[i]), kWidth, "      ");
  }
  return out + "\n" + counts(results) + "\n";
}

std::string claims_html(const std::vector<Claim>& claims, const std::vector<ClaimResult>& results) {
  CUPOLA_ASSERT(results.size() == claims.size());
  std::string body = kClaimsStyle + fmt::format("<p>{}.</p>\n", counts(results)) +
                     "<p>Limits marked <em>paper</em> follow from the sentence quoted; limits marked "
                     "<em>ours</em> were chosen here, for the reason given. A run that did not reach its "
                     "requested accuracy reproduces nothing.</p>\n"
                     "<table class=\"claims\"><colgroup><col><col><col><col></colgroup>\n"
                     "<tr><th>Verdict</th><th>Source</th><th>Statement</th><th>Number</th></tr>\n";
  for (size_t i = 0; i < claims.size(); ++i) body += claim_row(claims[i], results[i]);
  return body + "</table>\n";
}

std::string figures_html(const std::vector<ClaimFigure>& figures, const std::string& runs) {
  std::string out;
  for (const ClaimFigure& figure : figures) {
    const std::string path = fmt::format("{}/{}/post/{}", runs, figure.run, figure.picture);
    std::string picture = html_picture(path, figure.shows);
    if (picture.empty())
      picture = html_text(fmt::format("Not drawn yet: {} of the run {}.", figure.picture, figure.run));
    out += fmt::format(
        "<figure>\n{}\n<figcaption><strong>{}</strong> {} <small>{}</small></figcaption>\n</figure>\n",
        picture, html_text(figure.source), html_text(figure.shows), html_text(figure.run));
  }
  return out.empty() ? out : "<h2>Pictures of the runs</h2>\n" + out;
}

}  // namespace cupola

#include "postproc/claims/claims_report.hpp"

#include <fmt/format.h>

#include "postproc/report/html.hpp"

namespace cupola {
namespace {

/// Limits of the claim, e.g. ">= 1 and <= 2"; "-" for an open question.
std::string range(const Claim& claim) {
  if (!claim.open.empty()) return "-";
  std::string out;
  if (claim.at_least) out += ">= " + to_display(*claim.at_least);
  if (claim.at_most) out += (out.empty() ? "<= " : " and <= ") + to_display(*claim.at_most);
  return out;
}

std::string shown_number(const Claim& claim, const ClaimResult& result) {
  if (!result.number) return "-";
  return to_display(*result.number) + (claim.unit.empty() ? "" : " " + claim.unit);
}

std::string remark(const Claim& claim, const ClaimResult& result) {
  if (result.reason.empty() || claim.note.empty()) return result.reason + claim.note;
  return result.reason + ". " + claim.note;
}

std::string counts(const std::vector<ClaimResult>& results) {
  std::string out = fmt::format("{} claims", results.size());
  for (const std::string& verdict : names_of<Verdict>()) {
    int count = 0;
    for (const ClaimResult& result : results) count += to_string(result.verdict) == verdict;
    if (count > 0) out += fmt::format(", {} {}", count, verdict);
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

constexpr const char* kPage = R"(<!DOCTYPE html>
<html lang="en"><head><meta charset="utf-8"><title>Claims</title><style>
body {{ font: 15px/1.45 sans-serif; max-width: 75em; margin: 2em auto; color: #222 }}
table {{ border-collapse: collapse }} td, th {{ padding: .35em .7em; border-bottom: 1px solid #ddd;
text-align: left; vertical-align: top }} small {{ color: #666 }}
.reproduced {{ color: #007a5a }} .not_reproduced {{ color: #b84300 }} .open {{ color: #555 }}
.not_solved, .not_run {{ color: #999 }} td.verdict {{ white-space: nowrap; font-weight: bold }}
figure {{ margin: 2em 0 }} figure img {{ max-width: 100% }} figcaption {{ color: #444 }}
</style></head><body><h1>Claims and results</h1><p>{}.</p>
<table><tr><th>Source</th><th>Claim</th><th>Number</th><th>Value</th><th>Limits</th><th>Verdict</th></tr>
{}</table>
{}</body></html>
)";

/// The figures in order, below a heading; "" if there are none.
std::string figures_html(const std::vector<ClaimFigure>& figures, const std::string& runs) {
  std::string out;
  for (const ClaimFigure& figure : figures) {
    const std::string path = fmt::format("{}/{}/post/{}", runs, figure.run, figure.picture);
    std::string picture = html_picture(path, figure.shows);
    if (picture.empty())
      picture = markup_text(fmt::format("Not drawn yet: {} of the run {}.", figure.picture, figure.run));
    out += fmt::format(
        "<figure>\n{}\n<figcaption><strong>{}</strong> {} <small>{}</small></figcaption>\n</figure>\n",
        picture, markup_text(figure.source), markup_text(figure.shows), markup_text(figure.run));
  }
  return out.empty() ? out : "<h1>Figures of the publication, drawn from our runs</h1>\n" + out;
}

}  // namespace

Table claims_table(const std::vector<Claim>& claims, const std::vector<ClaimResult>& results) {
  CUPOLA_ASSERT(results.size() == claims.size());
  Table t{"claims", "Claims and results", {}, {}};
  t.columns = {{"source", "", "section and figure of the publication"},
               {"claim", "", "the statement"},
               {"number", "", "the number that tests it"},
               {"value", "", "empty if a run is missing or not solved"},
               {"unit", "", "of the value"},
               {"claimed", "", "limits within which the claim holds"},
               {"verdict", "", "outcome"},
               {"remark", "", "reason or note"}};
  for (size_t i = 0; i < claims.size(); ++i) {
    const Claim& claim = claims[i];
    const Table::Cell value =
        results[i].number ? Table::Cell(*results[i].number) : Table::Cell(std::string());
    t.rows.push_back({claim.source, claim.says, claim.number, value, claim.unit, range(claim),
                      to_string(results[i].verdict), remark(claim, results[i])});
  }
  return t;
}

std::string claims_text(const std::vector<Claim>& claims, const std::vector<ClaimResult>& results) {
  CUPOLA_ASSERT(results.size() == claims.size());
  std::string out;
  for (size_t i = 0; i < claims.size(); ++i) {
    const Claim& claim = claims[i];
    out += fmt::format("{:<15} {}\n", to_string(results[i].verdict) + ":", claim.source);
    out += wrapped_text(claim.says, 96, "    ");
    out += wrapped_text(fmt::format("{}: {}{}", claim.number, shown_number(claim, results[i]),
                                    claim.open.empty() ? fmt::format("  (limits: {})", range(claim)) : ""),
                        96, "      ");
    out += wrapped_text(remark(claim, results[i]), 96, "      ");
  }
  return out + "\n" + counts(results) + "\n";
}

std::string claims_html(const ClaimsFile& file, const std::vector<ClaimResult>& results,
                        const std::string& runs) {
  const std::vector<Claim>& claims = file.claims;
  CUPOLA_ASSERT(results.size() == claims.size());
  std::string rows;
  for (size_t i = 0; i < claims.size(); ++i) {
    const Claim& claim = claims[i];
    const std::string verdict = to_string(results[i].verdict);
    std::string css = verdict;
    for (char& c : css)
      if (c == ' ') c = '_';
    rows += fmt::format(
        "<tr><td>{}</td><td>{}<br><small>{}</small></td><td>{}</td><td>{}</td><td>{}</td><td class=\"verdict "
        "{}\">{}</td></tr>\n",
        markup_text(claim.source), markup_text(claim.says), markup_text(remark(claim, results[i])),
        markup_text(claim.number), markup_text(shown_number(claim, results[i])), markup_text(range(claim)),
        css, verdict);
  }
  return fmt::format(kPage, counts(results), rows, figures_html(file.figures, runs));
}

}  // namespace cupola

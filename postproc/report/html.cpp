#include "postproc/report/html.hpp"

#include <filesystem>

#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "assembly/files/atomic_file.hpp"
#include "assembly/files/base64.hpp"
#include "assembly/files/number_text.hpp"

namespace cupola {
namespace {

// Dark text on white, or the reverse where the reader prefers it; every colour pair has a contrast of at
// least 4.5. No external files.
constexpr const char* kStyle = R"css(
:root { color-scheme: light dark; --paper: #fff; --text: #1a1a1a; --soft: #444; --link: #00507d; --line: #ddd;
  --good: #005f45; --good-back: #f0f7f4; --bad: #a34700; --bad-back: #fdf3ec; --code: #f5f5f5; }
@media (prefers-color-scheme: dark) { :root { --paper: #15181b; --text: #e8e8e8; --soft: #b4b4b4; --link: #8ec9f0; --line: #3a3f44;
  --good: #4fc3a1; --good-back: #17302a; --bad: #f0a060; --bad-back: #35261a; --code: #22272b; } }
* { box-sizing: border-box; }
body { margin: 0 auto; padding: 1rem 1.25rem 3rem; max-width: 78rem; color: var(--text); background: var(--paper);
  font: 1rem/1.5 system-ui, "DejaVu Sans", sans-serif; overflow-wrap: break-word; }
h1 { font-size: 1.6rem; line-height: 1.25; margin: .5rem 0; }
.settings { margin: 0 0 .5rem; max-width: none; color: var(--soft); font-size: .9rem; }
h2 { font-size: 1.25rem; margin: 2rem 0 .5rem; border-bottom: 1px solid #999; }
h3 { font-size: 1.05rem; margin: 1.5rem 0 .25rem; }
a { color: var(--link); } p, li, figcaption { max-width: 55rem; }
.verdict { border-left: .4rem solid var(--good); background: var(--good-back); padding: .6rem 1rem; max-width: none; }
.verdict strong { display: block; font-size: 1.15rem; } .verdict small { font-size: .85rem; color: var(--soft); }
.verdict.bad { border-color: var(--bad); background: var(--bad-back); }
.warning { border-left: .4rem solid var(--bad); background: var(--bad-back); padding: .4rem 1rem; margin: .5rem 0;
  max-width: none; }
.key-numbers { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 15rem), 1fr)); gap: .75rem; margin: 1rem 0; }
.key-numbers div { border: 1px solid var(--line); border-radius: .3rem; padding: .5rem .8rem; }
.key-numbers span, .key-numbers small { display: block; color: var(--soft); } .key-numbers strong { font-size: 1.5rem; }
.key-numbers small { padding-left: .8rem; text-indent: -.8rem; margin-top: .1rem; }
.first { display: flex; flex-direction: column; } .first > .certain { max-width: none; margin: .25rem 0 .5rem; font-size: .9rem; color: var(--soft); }
.scroll { overflow-x: auto; max-width: 100%; }
table { border-collapse: collapse; font-size: .875rem; margin: .5rem 0; font-variant-numeric: tabular-nums; }
th, td { padding: .15rem .6rem; border-bottom: 1px solid var(--line); text-align: right; vertical-align: top; }
th { border-bottom: 2px solid #777; font-weight: 600; }
th small { display: block; font-weight: 400; color: var(--soft); }
td.text, th.text { text-align: left; }
figure { margin: 1rem 0; }
figure img { display: block; max-width: 100%; height: auto; background: #fff; }
figcaption { font-size: .9rem; color: var(--soft); }
pre { overflow-x: auto; background: var(--code); padding: .75rem; font-size: .8rem; line-height: 1.35; }
summary { cursor: pointer; }
dl { display: grid; grid-template-columns: minmax(9rem, max-content) minmax(0, 1fr); gap: .1rem 1rem; margin: .5rem 0; }
dt { color: var(--soft); } dd { margin: 0; }
@media (min-width: 800px) { .figures { display: grid; grid-template-columns: 1fr 1fr; gap: 0 1rem; align-items: start; }
  .figures > :not(.half) { grid-column: 1 / -1; } }
.side { display: grid; grid-template-columns: repeat(auto-fit, minmax(min(100%, 24rem), 1fr)); gap: 0 1rem; }
.side .wide { grid-column: 1 / -1; }
@media (max-width: 600px) {
  body { padding: .5rem .75rem 2rem; } h1 { font-size: 1.3rem; }
  figure { overflow-x: auto; } figure img { max-width: none; width: 58rem; } figure.half img { width: 40rem; }
  figcaption { position: sticky; left: 0; }
  .first > .verdict { order: -5; margin: .25rem 0; } .first > .view { display: contents; }
  .first .picture { order: -4; } .first > .warning { order: -3; } .first > .key-numbers { order: -2; } .first > .certain { order: -1; }
  dl { grid-template-columns: minmax(0, 1fr); } dd { margin: 0 0 .4rem; }
}
@media print { :root { --paper: #fff; --text: #1a1a1a; --soft: #444; }
  body { max-width: none; padding: 0; font-size: 10pt; } figure, .verdict, .warning, tr { break-inside: avoid; }
  h2, h3 { break-after: avoid; } .first { display: block; } details > summary { display: none; } .scroll { overflow: visible; }
  a { color: inherit; text-decoration: none; } figure { margin: .4rem 0; }
  figure img { max-height: 9.5cm; width: auto; } .figures { display: grid; grid-template-columns: 1fr 1fr; gap: 0 1rem; align-items: start; }
  .figures > :not(.half) { grid-column: 1 / -1; }
}
)css";

}  // namespace

std::string html_text(const std::string& text) {
  std::string out = markup_text(text);
  for (size_t open = 0; (open = out.find('`', open)) != std::string::npos;) {
    const size_t close = out.find('`', open + 1);
    if (close == std::string::npos) break;
    out.replace(close, 1, "</code>").replace(open, 1, "<code>");
  }
  return out;
}

std::string report_link(const std::string& text, const std::string& post_folder,
                        const std::string& page_folder) {
  const std::filesystem::path report = std::filesystem::absolute(post_folder) / "report.html";
  if (!std::filesystem::exists(report)) return html_text(text);
  const std::string relative =
      report.lexically_normal()
          .lexically_relative(std::filesystem::absolute(page_folder).lexically_normal())
          .string();
  return fmt::format("<a href=\"{}\">{}</a>", markup_text(relative), markup_text(text));
}

std::string html_picture(const std::string& path, const std::string& alternative) {
  if (!std::filesystem::exists(path)) return "";
  const bool svg = std::filesystem::path(path).extension() == ".svg";
  return fmt::format("<img alt=\"{}\" src=\"data:image/{};base64,{}\">", markup_text(alternative),
                     svg ? "svg+xml" : "png", base64(read_text(path)));
}

std::string html_table(const Table& table) {
  // Texts are aligned to the left, numbers to the right, also those that are swept as text.
  const auto is_text = [](const Table::Cell& cell) {
    const std::string* text = std::get_if<std::string>(&cell);
    double number = 0.0;
    return text && !text->empty() && !read_number(*text, &number).empty();
  };
  std::vector<bool> text(table.columns.size());
  for (const auto& row : table.rows)
    for (size_t i = 0; i < row.size(); ++i) text[i] = text[i] || is_text(row[i]);
  std::string out = "<div class=\"scroll\" tabindex=\"0\"><table>\n<thead><tr>";
  for (size_t i = 0; i < table.columns.size(); ++i) {
    const Table::Column& column = table.columns[i];
    out +=
        fmt::format("<th{}>{}<small>{}</small></th>", text[i] ? " class=\"text\"" : "",
                    html_text(column.meaning.empty() ? column.key : column.meaning), html_text(column.unit));
  }
  out += "</tr></thead>\n<tbody>\n";
  for (const auto& row : table.rows) {
    CUPOLA_ASSERT(row.size() == table.columns.size());
    out += "<tr>";
    for (size_t i = 0; i < row.size(); ++i)
      out += fmt::format("<td{}>{}</td>", text[i] ? " class=\"text\"" : "",
                         html_text(to_display(row[i], table.columns[i])));
    out += "</tr>\n";
  }
  return out + "</tbody></table></div>\n";
}

std::string html_page(const std::string& title, const std::string& body) {
  return fmt::format(
      "<!DOCTYPE html>\n<html lang=\"en\">\n<head>\n<meta charset=\"utf-8\">\n"
      "<meta name=\"viewport\" content=\"width=device-width, initial-scale=1\">\n"
      "<link rel=\"icon\" "
      "href=\"data:,\">\n<title>{}</title>\n<style>{}</style>\n</head>\n<body>\n{}</body>\n</html>\n",
      markup_text(title), kStyle, body);
}

}  // namespace cupola

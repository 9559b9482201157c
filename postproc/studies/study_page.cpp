#include "postproc/studies/study_page.hpp"

#include <algorithm>
#include <filesystem>

#include <fmt/format.h>

#include "assembly/files/atomic_file.hpp"
#include "postproc/report/html.hpp"

namespace cupola {
namespace {

Table without_empty_columns(const Table& table) {
  Table out{table.name, table.title, {}, std::vector<std::vector<Table::Cell>>(table.rows.size())};
  for (size_t k = 0; k < table.columns.size(); ++k) {
    if (std::all_of(table.rows.begin(), table.rows.end(),
                    [k](const auto& row) { return to_display(row[k]).empty(); }))
      continue;
    out.columns.push_back(table.columns[k]);
    for (size_t r = 0; r < table.rows.size(); ++r) out.rows[r].push_back(table.rows[r][k]);
  }
  return out;
}

}  // namespace

StudyPage::StudyPage(std::string title, std::string folder)
    : title_(std::move(title)), folder_(std::move(folder)), written_(folder_) {
  make_folder(folder_);
  body_ = "<h1>" + html_text(title_) + "</h1>\n";
}

void StudyPage::add_paragraph(const std::string& text) {
  body_ += "<p>" + html_text(text) + "</p>\n";
}

void StudyPage::add_figures(const std::vector<Figure>& figures) {
  const std::string figure_folder = folder_ + "/figures";
  for (const std::string& problem : draw_figures(figure_folder, figures)) {
    fmt::print(stderr, "cupola-post: warning: {}\n", problem);
    body_ += "<p class=\"warning\">" + html_text(problem) + "</p>\n";
  }
  for (const Figure& figure : figures)
    if (const std::string picture = html_picture(picture_file(figure_folder, figure), figure.title);
        !picture.empty())
      body_ += fmt::format("<figure>\n{}\n<figcaption><strong>{}.</strong> {}</figcaption>\n</figure>\n",
                           picture, html_text(figure.title), html_text(figure.caption));
}

void StudyPage::add_report_links(const std::vector<StudyRun>& runs, const std::string& runs_folder) {
  std::string links;
  for (const StudyRun& run : runs) {
    const std::string post = runs_folder + "/" + run.name + "/post";
    if (std::filesystem::exists(post + "/report.html"))
      links +=
          (links.empty() ? "" : ", ") + report_link(run.name.substr(run.name.rfind('/') + 1), post, folder_);
  }
  if (!links.empty()) body_ += "<p>Reports: " + links + ".</p>\n";
}

void StudyPage::write_csv(const Table& table) const {
  write_text_atomically(fmt::format("{}/{}.csv", folder_, table.name), to_csv(table));
  write_text_atomically(fmt::format("{}/{}.tex", folder_, table.name),
                        to_latex(without_empty_columns(table)));
}

void StudyPage::add_table(const Table& table) {
  add_table(table, table);
}

void StudyPage::add_table(const Table& table, const Table& shown) {
  write_csv(table);
  body_ += html_table(without_empty_columns(shown));
}

void StudyPage::write() const {
  write_text_atomically(folder_ + "/study.html", html_page(title_, body_));
}

std::string aligned_text(const Table& table) {
  std::vector<size_t> width;
  for (const Table::Column& column : table.columns) width.push_back(column.key.size());
  for (const auto& row : table.rows)
    for (size_t k = 0; k < row.size(); ++k) width[k] = std::max(width[k], to_display(row[k]).size());
  std::string out;
  for (size_t k = 0; k < width.size(); ++k) out += fmt::format("{:<{}}  ", table.columns[k].key, width[k]);
  out += "\n";
  for (const auto& row : table.rows) {
    for (size_t k = 0; k < row.size(); ++k) out += fmt::format("{:<{}}  ", to_display(row[k]), width[k]);
    out += "\n";
  }
  return out;
}

}  // namespace cupola

#include "postproc/studies/ensemble.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/files/markup.hpp"
#include "postproc/figures/plot_style.hpp"
#include "postproc/report/first_screen.hpp"
#include "postproc/studies/ensemble_results.hpp"
#include "postproc/studies/sweep.hpp"

namespace cupola {
namespace {

constexpr std::array kEnsembleColours{kBlue, kOrange, kGreen, kPurple, kSky};
constexpr size_t kMostResults = 4;  // panels of the figure

/// The share of members at or below each value of a result: one panel per result, one curve per ensemble.
Figure distribution_figure(const std::vector<EnsembleResults>& ensembles) {
  Figure f;
  f.name = "distributions";
  f.title = "Share of the members up to a value";
  f.caption =
      "Of a critical value, such as the friction at which a vault falls, the curve is the fragility: the "
      "share that falls at that value.";
  std::vector<size_t> columns = ensembles.front().results;
  if (columns.size() > kMostResults) columns.resize(kMostResults);
  if (columns.empty()) return f;
  std::string data;
  std::vector<std::string> plots;
  for (const size_t k : columns) {
    const Table::Column& column = ensembles.front().members.columns[k];
    std::string plot;
    for (size_t e = 0; e < ensembles.size(); ++e) {
      std::vector<double> values = ensembles[e].values(k).values;
      std::erase_if(values, [](double v) { return !std::isfinite(v); });
      if (values.empty()) continue;
      std::ranges::sort(values);
      std::vector<std::vector<double>> rows;
      for (size_t i = 0; i < values.size(); ++i)
        rows.push_back({values[i], static_cast<double>(i + 1) / static_cast<double>(values.size())});
      const std::string block = fmt::format("column{}_{}", k, e);
      data += data_block(block, rows);
      plot +=
          fmt::format("{} ${} using 1:2 w steps lc rgb '{}' lw 1.5 title '{}'", plot.empty() ? "plot" : ",",
                      block, kEnsembleColours[e % kEnsembleColours.size()], gnuplot_text(ensembles[e].name));
    }
    plots.push_back(fmt::format("set xlabel '{}{}'\n", gnuplot_text(column.meaning),
                                column.unit.empty() ? "" : " (" + gnuplot_text(column.unit) + ")") +
                    plot + "\n");
  }
  f.width = 900;
  f.height = 60 + 280 * static_cast<int>(columns.size());
  f.commands = plot_style() + data +
               "set yrange [0:1]\nset ylabel 'share of members'\nset key bottom right\n" +
               panels(panel_grid(columns.size(), 1, {0.09, 0.97, 60.0 / f.height, 1.0 - 15.0 / f.height}, 0.0,
                                 70.0 / f.height),
                      plots);
  return f;
}

/// The runs named in the second column of the table of ends, each once.
std::vector<StudyRun> runs_at_the_ends(const Table& ends, const std::vector<StudyRun>& runs) {
  std::vector<StudyRun> out;
  for (const StudyRun& run : runs)
    if (std::ranges::any_of(ends.rows, [&run](const auto& row) { return to_display(row[2]) == run.name; }))
      out.push_back(run);
  return out;
}

/// Several sentences, the first as the verdict of the page.
void add_headline(const std::vector<std::string>& sentences, bool good, StudyPage* page) {
  const size_t stop = sentences.front().find(". ");
  const bool split = stop != std::string::npos;
  page->add(verdict_html(split ? sentences.front().substr(0, stop + 1) : sentences.front(),
                         split ? sentences.front().substr(stop + 2) : "", good));
  for (size_t i = 1; i < sentences.size(); ++i) page->add_paragraph(sentences[i]);
}

}  // namespace

std::string add_ensembles(const std::vector<SampledRuns>& ensembles, const std::string& runs_folder,
                          StudyPage* page) {
  if (ensembles.empty()) return "";
  std::vector<EnsembleResults> all;
  for (const SampledRuns& ensemble : ensembles) all.push_back(results_of(ensemble, runs_folder));
  // The columns of ranges differ between analyses; ensembles are compared column by column only if all have the same.
  for (EnsembleResults& one : all) one.results = varying_columns({&one.members});
  const bool alike = std::ranges::all_of(all, [&](const EnsembleResults& one) {
    return std::ranges::equal(one.members.columns, all.front().members.columns, {}, &Table::Column::key,
                              &Table::Column::key);
  });
  if (alike) {
    std::vector<const Table*> tables;
    for (const EnsembleResults& one : all) tables.push_back(&one.members);
    for (EnsembleResults& one : all) one.results = varying_columns(tables);
  }
  std::vector<std::string> sentences;
  const Table differences = alike ? differences_table(all, &sentences) : Table{};
  bool good = true;
  for (const EnsembleResults& one : all) {
    const std::string failed = failures(one.members);
    good = good && failed.empty();
    if (!failed.empty())
      sentences.push_back(fmt::format("{}: {} failed: {}.", one.name, failed, endings(one.members)));
    sentences.push_back(result_sentence(one));
  }
  add_headline(sentences, good, page);
  std::string text = fmt::format("{}\n", fmt::join(sentences, "\n"));
  page->add_paragraph("Intervals are those of 95 %.");
  if (alike)
    if (const Figure figure = distribution_figure(all); !figure.commands.empty()) page->add_figures({figure});
  if (!differences.rows.empty()) page->add_table(differences);
  for (const EnsembleResults& one : all) {
    page->write_csv(one.members);
    page->add("<h2>" + markup_text(one.name) + "</h2>\n");
    for (const Table& table : {statistics_table(one), inputs_table(one), ends_table(one)}) {
      if (table.rows.empty()) continue;
      page->add("<h3>" + markup_text(table.title) + "</h3>\n");
      page->add_table(table);
      if (table.name == one.name + "_statistics") text += aligned_text(table);
      if (table.name == one.name + "_ends")
        page->add_report_links(runs_at_the_ends(table, one.runs->runs), runs_folder);
    }
  }
  return text;
}

}  // namespace cupola

#include "postproc/studies/ensemble.hpp"

#include <algorithm>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "postproc/report/first_screen.hpp"
#include "postproc/report/html.hpp"
#include "postproc/studies/ensemble_figures.hpp"
#include "postproc/studies/ensemble_results.hpp"
#include "postproc/studies/sweep.hpp"
#include "postproc/studies/sweep_figure.hpp"

namespace cupola {
namespace {

constexpr size_t kMostShown = 100;  // members from a file, as a table of the page

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
  find_results(&all);
  std::vector<std::string> sentences;
  const Table differences = differences_table(all, &sentences);
  bool good = true;
  for (const EnsembleResults& one : all) {
    const std::string failed = failures(one.members, "member");
    good = good && failed.empty() && !one.some_fall();
    if (!failed.empty())
      sentences.push_back(fmt::format("{}: {} failed; in all {}.", one.name, failed, endings(one.members)));
    if (!one.runs->design)
      if (std::string governs = governing_member(one.runs->samples.keys, one.members, one.more_is_safer);
          !governs.empty())
        sentences.push_back(std::move(governs));
    sentences.push_back(result_sentence(one));
  }
  add_headline(sentences, good, page);
  std::string text = fmt::format("{}\n", fmt::join(sentences, "\n"));
  page->add_paragraph("Intervals are those of 95 %.");
  if (const Figure figure = distribution_figure(all); !figure.commands.empty()) page->add_figures({figure});
  if (!differences.rows.empty()) page->add_table(differences);
  for (const EnsembleResults& one : all) {
    page->add("<h2>" + html_text(one.name) + "</h2>\n");
    if (!one.runs->design && one.members.rows.size() <= kMostShown)
      page->add_table(one.members, in_readable_units(one.members));
    else
      page->write_csv(one.members);
    const std::vector<Bands> bands = bands_of(one, runs_folder);
    for (const Bands& band : bands) page->write_csv(band.table);
    for (const Figure& figure : {convergence_figure(one), bands_figure(bands)})
      if (!figure.commands.empty()) page->add_figures({figure});
    for (const Table& table : {statistics_table(one), inputs_table(one), ends_table(one)}) {
      if (table.rows.empty()) continue;
      page->add("<h3>" + html_text(table.title) + "</h3>\n");
      page->add_table(table);
      if (table.name == one.name + "_statistics") text += aligned_text(table);
      if (table.name == one.name + "_ends")
        page->add_report_links(runs_at_the_ends(table, one.runs->runs), runs_folder);
    }
  }
  return text;
}

}  // namespace cupola

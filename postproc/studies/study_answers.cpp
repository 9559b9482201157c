#include "postproc/studies/study_answers.hpp"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <optional>
#include <sstream>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/files/atomic_file.hpp"
#include "postproc/figures/plot_style.hpp"
#include "postproc/report/first_screen.hpp"
#include "postproc/report/html.hpp"
#include "postproc/report/warnings.hpp"
#include "postproc/studies/study_run.hpp"

namespace cupola {
namespace {

std::string short_name(const std::string& run) {
  return run.substr(run.rfind('/') + 1);
}

KeyNumber answer_of(RunFiles& run, const std::string& key) {
  return {run.answer(key + ".name"), run.answer(key + ".value"), run.answers(key + ".details")};
}

struct Margin {
  std::string run;
  KeyNumber answer;
  std::optional<double> factor;
};

/// The margins with a factor, least first, then the others in their order.
std::vector<Margin> sorted_margins(const std::vector<std::string>& names, RunCache& runs) {
  std::vector<Margin> margins;
  for (const std::string& name : names) {
    if (!runs.finished(name) || runs.run(name).status() == "unconverged") continue;
    RunFiles& run = runs.run(name);
    margins.push_back({name, answer_of(run, "margin"), run.number_if_any("post.margin_factor")});
  }
  std::ranges::stable_sort(margins, {}, [](const Margin& margin) {
    return margin.factor.value_or(std::numeric_limits<double>::infinity());
  });
  return margins;
}

/// "8 of 8 stand; widest crack 3.1 mm (settled_4)"; none without finished runs.
std::optional<KeyNumber> worst_cause(const std::vector<std::string>& names, RunCache& runs) {
  int finished = 0, standing = 0;
  double widest = 0.0;
  std::string worst;
  for (const std::string& name : names) {
    if (!runs.finished(name)) continue;
    ++finished;
    standing += runs.run(name).answer("verdict.stands") == "yes";
    const double crack = runs.run(name).number_if_any("post.widest_crack_m").value_or(0.0);
    if (crack > widest) widest = crack, worst = short_name(name);
  }
  if (finished == 0) return std::nullopt;
  std::vector<std::string> details{"one at a time"};
  if (!worst.empty())
    details.push_back(fmt::format("widest crack {} ({})", length_text(widest), worst));
  else if (standing == finished)
    details.emplace_back("no joint opens");
  return KeyNumber{"It stands after settlement of",
                   fmt::format("{} of {}", standing, counted(finished, "support")), details};
}

/// What was not computed among the runs that the answers name.
std::vector<NotComputed> missing_answers(const StudyAnswers& answers, const std::string& runs_folder,
                                         RunCache& runs) {
  std::vector<std::string> names{answers.verdict};
  if (!answers.thrust.empty()) names.push_back(answers.thrust);
  names.insert(names.end(), answers.margins.begin(), answers.margins.end());
  names.insert(names.end(), answers.causes.begin(), answers.causes.end());
  std::vector<NotComputed> out;
  for (const std::string& name : names) {
    const std::string what = short_name(name);
    if (!runs.finished(name)) {
      const std::string error = error_of_run(runs_folder, name);
      out.push_back({what, error.empty() ? "the run did not end" : error});
    } else if (runs.run(name).status() == "unconverged") {
      out.push_back({what, runs.run(name).message()});
    }
  }
  return out;
}

Table margins_table(const std::vector<Margin>& margins) {
  Table t{"margins",
          "",
          {{"margin", "", "Margin"},
           {"factor", "", "Factor"},
           {"value", "", "Value"},
           {"decided_by", "", "What decides it"}},
          {}};
  for (const Margin& margin : margins)
    t.rows.push_back({margin.answer.name,
                      margin.factor ? Table::Cell(*margin.factor) : Table::Cell(std::string()),
                      margin.answer.value, margin.answer.detail()});
  return t;
}

std::string verdict_text(const StudyAnswers& answers, RunCache& runs, StudyPage* page) {
  std::string words = "Undecided", reason = "The equilibrium was not computed; see below.";
  bool stands = false;
  std::vector<std::string> warnings;
  if (runs.finished(answers.verdict)) {
    RunFiles& run = runs.run(answers.verdict);
    words = run.answer("verdict.words");
    reason = run.answer("verdict.reason");
    stands = run.answer("verdict.stands") == "yes";
    warnings = run.warnings();
  }
  page->add(verdict_html(words, reason, stands) + warnings_html(warnings));
  std::string text = fmt::format("{}: {}\n", words, reason);
  for (const std::string& line : warning_lines(warnings)) text += fmt::format("  warning: {}\n", line);
  return text;
}

}  // namespace

void declare_answers(Section& s, StudyAnswers& answers) {
  std::vector<std::string> verdict, thrust;
  declare_names(s, "verdict", verdict, "run that says whether it stands");
  declare_names(s, "thrust", thrust, "run with the range of the thrust");
  declare_names(s, "margins", answers.margins, "runs whose margins are listed, least first");
  declare_names(s, "causes", answers.causes,
                "runs with settled supports; * at the end stands for all that begin so");
  s.rule(verdict.size() == 1, "verdict", "must name one run");
  s.rule(thrust.size() < 2, "thrust", "must name one run");
  if (!verdict.empty()) answers.verdict = verdict[0];
  if (!thrust.empty()) answers.thrust = thrust[0];
}

std::string error_of_run(const std::string& runs_folder, const std::string& run) {
  const std::string path = fmt::format("{}/{}/errors.txt", runs_folder, run);
  if (!std::filesystem::exists(path)) return "";
  std::istringstream text(read_text(path));
  std::string error;
  const std::string mark = "error: ";
  for (std::string line; std::getline(text, line);)
    if (const size_t at = line.find(mark); error.empty() && at != std::string::npos)
      error = line.substr(at + mark.size());
  return error;
}

std::string add_answers(const StudyAnswers& answers, const std::vector<NotComputed>& not_computed,
                        const std::string& runs_folder, RunCache& runs, StudyPage* page) {
  if (answers.verdict.empty()) return "";
  page->add("<div class=\"first\">\n");
  std::string text = verdict_text(answers, runs, page);
  const std::vector<Margin> margins = sorted_margins(answers.margins, runs);
  std::vector<KeyNumber> numbers;
  if (!margins.empty() && margins[0].factor)
    numbers.push_back({"Least margin: " + margins[0].answer.name,
                       fmt::format("factor {:.3g}", *margins[0].factor), margins[0].answer.details});
  const std::string thrust = runs.finished(answers.thrust) ? answers.thrust : answers.verdict;
  if (runs.finished(thrust))
    if (KeyNumber number = answer_of(runs.run(thrust), "thrust"); !number.name.empty())
      numbers.push_back(number);
  if (runs.finished(answers.verdict))
    if (KeyNumber crack = answer_of(runs.run(answers.verdict), "crack"); !crack.name.empty())
      numbers.push_back(crack);
  if (auto cause = worst_cause(answers.causes, runs)) numbers.push_back(std::move(*cause));
  page->add(numbers_html(numbers));
  for (const KeyNumber& number : numbers)
    text += fmt::format("  {}: {}; {}\n", number.name, number.value, number.detail());
  page->add("</div>\n<h2>Margins, least first</h2>\n");
  const Table table = margins_table(margins);
  page->add_table(table);
  text += aligned_text(table);
  page->add_paragraph(
      "A factor says how far the case is from the limit: 2 if half the friction, half the extent of the "
      "joints or twice the load is "
      "still borne. Margins without a factor follow: the case has no value to compare them with, or the "
      "structure stands, or falls, at every value.");
  std::vector<NotComputed> missing = not_computed;
  for (NotComputed& one : missing_answers(answers, runs_folder, runs)) missing.push_back(std::move(one));
  if (!missing.empty()) page->add("<h2>Not computed</h2>\n<ul>\n");
  for (const NotComputed& one : missing) {
    page->add(fmt::format("<li><strong>{}</strong>: {}</li>\n", html_text(one.what), html_text(one.why)));
    text += fmt::format("not computed: {}: {}\n", one.what, one.why);
  }
  if (!missing.empty()) page->add("</ul>\n");
  return text;
}

}  // namespace cupola

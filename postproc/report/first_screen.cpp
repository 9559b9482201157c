#include "postproc/report/first_screen.hpp"

#include <algorithm>
#include <cmath>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/base/with_capital.hpp"
#include "postproc/evaluation/quantity_text.hpp"
#include "postproc/figures/range_text.hpp"
#include "postproc/report/answers.hpp"
#include "postproc/report/html.hpp"
#include "postproc/report/motion.hpp"
#include "postproc/report/report.hpp"
#include "postproc/report/warnings.hpp"
#include "postproc/report/worst_joints.hpp"
#include "postproc/tables/post_summary.hpp"
#include "postproc/tables/range_values.hpp"

namespace cupola {
namespace {

KeyNumber range_number_of(const ForceRange& range) {
  if (range.min.outcome == RangeOutcome::undefined)
    return {with_capital(range_name(range)), "undefined", {"in every state a ratio to nothing"}};
  std::vector<std::string> details{"certain for every history"};
  if (range.chosen)
    details.push_back(fmt::format("the stiffness of the joints selects {}{}",
                                  range_number(*range.chosen, range), range_unit(range).after_blank()));
  return {with_capital(range_name(range)), range_ends(range), details};
}

void add_numbers_at_rest(const Evaluation& e, std::vector<KeyNumber>* out) {
  for (const ForceRange& range : e.summary.ranges)
    if (out->size() < 2 && !range.quantity.starts_with("thrust")) out->push_back(range_number_of(range));
  if (std::optional<KeyNumber> thrust = thrust_answer(e)) {
    const bool first = !e.summary.ranges.empty() && e.summary.ranges.front().quantity.starts_with("thrust");
    out->insert(first ? out->begin() : out->end(), std::move(*thrust));
  }
  if (const PostSummary s = post_summary(e); s.largest_strength_use) {
    out->push_back(pressure_number(s.largest_pressure_Pa.value_or(0.0), *s.largest_strength_use));
    out->back().details.front().insert(0, after_last_stage(e));
  }
  if (std::optional<KeyNumber> crack = crack_answer(e)) out->push_back(std::move(*crack));
}

}  // namespace

std::string how_sure(const Evaluation& e) {
  const Summary& s = e.summary;
  if (s.critical && !is_stage(e.last.frame.role) && s.critical->parameter != "peak_stress")
    return fmt::format(
        "The structure stands at one end of a bracket of relative width {:.1e} and moves at the other. {}",
        s.accuracy.reached, to_sentence(s.forces_unique));
  const auto ended = [](const ForceRange& r) {
    return r.min.outcome != RangeOutcome::unconverged && r.max.outcome != RangeOutcome::unconverged;
  };
  if (!s.ranges.empty() && std::all_of(s.ranges.begin(), s.ranges.end(), ended))
    return "The ranges hold for every admissible state. The forces shown are those of one of them.";
  if (!s.forces_unique.value) return to_sentence(s.forces_unique);
  const ForceCertificate& certificate = s.certified_force_error;
  if (!certificate.value)
    return fmt::format("No bound of the error of the forces is proven: {}.", certificate.bounds);
  const std::string article = certificate.bounds.starts_with("the ") ? "" : "the ";
  const int digits = static_cast<int>(std::floor(-std::log10(std::max(*certificate.value, 1e-16))));
  // The bound compares with an exact solution, which a stable_unproven run has not proven to exist.
  const std::string forces = s.status == Status::stable_unproven
                                 ? "If exact forces exist, the forces of this model"
                                 : "The forces of this model";
  const std::string lead = digits > 0 ? fmt::format("{} are proven to {}", forces, counted(digits, "digit"))
                                      : forces + " are known only roughly";
  return fmt::format("{}: {}{} is at most {:.1e}.", lead, article, certificate.bounds, *certificate.value);
}

std::string verdict_html(const std::string& words, const std::string& reason, bool good) {
  return fmt::format("<p class=\"verdict{}\"><strong>{}</strong> <small>{}</small></p>\n", good ? "" : " bad",
                     html_text(words), html_text(reason));
}

std::string numbers_html(const std::vector<KeyNumber>& numbers) {
  std::string out = "<div class=\"key-numbers\">\n";
  for (const KeyNumber& n : numbers) {
    out += fmt::format("<div><span>{}</span><strong>{}</strong>", html_text(n.name), html_text(n.value));
    for (const std::string& detail : n.details) out += "<small>" + html_text(detail) + "</small>";
    out += "</div>\n";
  }
  return out + "</div>\n";
}

std::vector<KeyNumber> key_numbers(const Evaluation& e, const std::vector<HistoryRow>& history) {
  constexpr size_t kMost = 4;
  std::vector<KeyNumber> out;
  if (at_rest(e)) {
    add_numbers_at_rest(e, &out);
    out.insert(e.summary.ranges.empty() ? out.begin() : out.end(), margin_answer(e));
  } else {
    out.push_back(margin_answer(e));
    const std::vector<KeyNumber> motion = motion_numbers(e, history);
    out.insert(out.end(), motion.begin(), motion.end());
  }
  if (out.size() > kMost) out.resize(kMost);
  return out;
}

std::string first_screen(const Evaluation& e, const std::vector<HistoryRow>& history,
                         const StageReport* construction, const std::string& viewer) {
  const VerdictWords verdict = verdict_words(e);
  std::string out = verdict_html(verdict.words, reason_for_verdict(e), verdict.good);
  out += warnings_html(notices(e));
  std::vector<KeyNumber> numbers = key_numbers(e, history);
  if (construction)
    for (KeyNumber& number : numbers)
      for (const KeyNumber& largest : construction->largest)
        if (number.name == largest.name) number = largest;
  if (construction)
    numbers.insert(
        numbers.begin(),
        {"Stages that stand",
         fmt::format("{} of {} solved", construction->standing, construction->table.rows.size()),
         construction->worst.empty() ? std::vector<std::string>{} : std::vector{construction->worst}});
  out += numbers_html(numbers);
  if (const std::string certain = certain_sentence(e); !certain.empty())
    out += "<p class=\"certain\">" + html_text(certain) + "</p>\n";
  return "<div class=\"first\">\n" + out + viewer + worst_joints_html(e) + "</div>\n";
}

}  // namespace cupola

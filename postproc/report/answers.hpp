#pragma once

#include <map>
#include <optional>
#include <string>
#include <vector>

#include "postproc/evaluation/evaluation.hpp"
#include "postproc/report/key_number.hpp"

namespace cupola {

/// The verdict in the words of the first screen.
struct VerdictWords {
  std::string words;  ///< "It stands"
  bool good = false;  ///< false: it falls, or nothing is decided
};

/// The words of the status of a run.
VerdictWords words_of_run(const Summary& summary);

/// The words for the structure under the loads of its case. Of a limit analysis: on which side of the limit
/// the case lies.
VerdictWords verdict_words(const Evaluation& evaluation);

/// "support block 0 has moved by 5 mm", "3 supports have moved by up to 5 mm and turned by up to 0.1 degrees";
/// "" within rounding.
std::string moved_text(const Evaluation& evaluation);

/// Why, in one to three sentences: the verdict of the run, moved supports, parts that move.
std::string reason_for_verdict(const Evaluation& evaluation);

/// By how much: the factor that this run computed, with what decides it, or the command that computes some.
KeyNumber margin_answer(const Evaluation& evaluation);

/// ", 4.63 times what it needs" or " and bears 2 times as much". `factor`: of factor_of_safety().
std::string distance_from_limit(double factor, const CriticalValue& critical);

/// The thrust on the supports: in N, per metre and per support, with its range if the run has one. None
/// without an axis.
std::optional<KeyNumber> thrust_answer(const Evaluation& evaluation);

/// "after the last stage: " of a construction, else "".
std::string after_last_stage(const Evaluation& evaluation);

inline constexpr const char* kLargestPressure = "Largest pressure on a joint";
inline constexpr const char* kWidestCrack = "Widest crack";

/// The largest pressure on a joint, Pa, with the largest share of its strength that one uses.
KeyNumber pressure_number(double pressure, double strength_use);

/// The widest crack; none where joints are rigid, or without an equilibrium.
std::optional<KeyNumber> crack_answer(const Evaluation& evaluation);

/// What is certain and what is assumed, in one or two sentences.
std::string certain_sentence(const Evaluation& evaluation);

/// The parts that a static analysis solved one by one, by "It stands", "It falls" and "Undecided", proven or
/// not.
std::map<std::string, std::vector<PartVerdict>> parts_by_verdict(const Summary& summary);

/// Which parts of a structure in several move and which do not; "" for one part, or in an equilibrium.
std::string parts_sentence(const Evaluation& evaluation);

/// The texts of the first screen as JSON, for the pages of studies: answers.json.
std::string answers_json(const Evaluation& evaluation);

/// Six lines for the terminal: verdict, margin, weight, thrust, warnings, report.
std::vector<std::string> terminal_lines(const Evaluation& evaluation, const std::string& report);

}  // namespace cupola

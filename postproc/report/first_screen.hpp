#pragma once

#include <string>
#include <vector>

#include "postproc/evaluation/evaluation.hpp"
#include "postproc/figures/figures.hpp"
#include "postproc/report/key_number.hpp"
#include "postproc/report/stages.hpp"

namespace cupola {

/// From here on a joint is at its friction limit: its friction use prints as 100 %.
inline constexpr double kSlides = 0.999;

/// At most four: by how much it stands, its thrust, pressure and widest crack, of a range analysis the ranges
/// first; of a run that is not at rest what moves, how far and when.
std::vector<KeyNumber> key_numbers(const Evaluation& evaluation, const std::vector<HistoryRow>& history);

/// How exact the forces are, in words: "proven to 9 digits".
std::string how_sure(const Evaluation& evaluation);

std::string verdict_html(const std::string& words, const std::string& reason, bool good);
std::string numbers_html(const std::vector<KeyNumber>& numbers);

/// What answers the first questions, as HTML: warnings, verdict, key numbers, what is certain, 3-D view,
/// worst joints. `construction`: the stages of a staged run, else null.
std::string first_screen(const Evaluation& evaluation, const std::vector<HistoryRow>& history,
                         const StageReport* construction, const std::string& viewer);

}  // namespace cupola

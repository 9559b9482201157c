#pragma once

#include <string>
#include <vector>

#include "postproc/evaluation/evaluation.hpp"
#include "postproc/figures/figures.hpp"
#include "postproc/report/key_number.hpp"

namespace cupola {

/// Of a run that found no equilibrium: at most three numbers of what moves, how far and when.
std::vector<KeyNumber> motion_numbers(const Evaluation& evaluation, const std::vector<HistoryRow>& history);

/// What moves and how, one sentence per item. Of an unconverged run: that nothing is known.
std::vector<std::string> motion_sentences(const Evaluation& evaluation,
                                          const std::vector<HistoryRow>& history);

/// How certain it is that the structure moves; "" if the message of the run says all of it.
std::string how_sure_of_motion(const Evaluation& evaluation);

}  // namespace cupola

#pragma once

#include <optional>
#include <string>
#include <vector>

#include "postproc/evaluation/evaluation.hpp"
#include "postproc/figures/figures.hpp"
#include "postproc/report/key_number.hpp"

namespace cupola {

/// The largest displacement of a block during a motion, and when; of results without it (0.3 and earlier) that
/// at the end.
struct LargestDisplacement {
  double distance = 0.0;         ///< m
  double time = 0.0;             ///< s
  std::optional<double> at_end;  ///< m, if less than that
};
LargestDisplacement largest_displacement(const Evaluation& evaluation);

/// "a block moves by up to 154 mm relative to the ground (at 3.05 s; 50 mm at the end)".
std::string largest_displacement_text(const Evaluation& evaluation);

/// Of a run that found no equilibrium: at most three numbers of what moves, how far and when.
std::vector<KeyNumber> motion_numbers(const Evaluation& evaluation, const std::vector<HistoryRow>& history);

/// What moves and how, one sentence per item. Of an unconverged run: that nothing is known.
std::vector<std::string> motion_sentences(const Evaluation& evaluation,
                                          const std::vector<HistoryRow>& history);

/// How certain it is that the structure moves; "" if the message of the run says all of it.
std::string how_sure_of_motion(const Evaluation& evaluation);

}  // namespace cupola

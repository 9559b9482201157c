#pragma once

#include <vector>

#include "postproc/evaluation/evaluation.hpp"
#include "postproc/figures/gnuplot.hpp"

namespace cupola {

/// One row per frame of what is seen moving.
struct HistoryRow {
  double time = 0.0;              ///< s
  double max_displacement = 0.0;  ///< m
  double max_speed = 0.0;         ///< m/s
  double reaction = 0.0;          ///< N, of the supports on the free blocks, against gravity
};

/// Profile with thrust line, envelope and lines of action; r, v and couple length beside it (paper figures 7,
/// 8, 10, 13).
Figure thrust_figure(const Evaluation& evaluation, const MeridianEvaluation& meridian);

/// Ring sums against the weight above, uniformity and utilisation over the height.
Figure ring_figure(const Evaluation& evaluation);

/// Plan of the blocks cut at a height with the thrust of their resultants, and the resultants around the ring
/// (paper figures 6, 9, 12).
Figure section_figure(const Evaluation& evaluation, const SectionEvaluation& section);

/// The resultants across the beds of all sections, drawn to one scale where they act: vaults from above at a
/// slant, walls in elevation over their blocks (paper figures 6, 9, 11, 12).
Figure levels_figure(const Evaluation& evaluation);

/// The blocks cut by a plane and what the joints across it press or pull.
Figure plane_figure(const Evaluation& evaluation, const PlaneCut& cut);

/// Hoop force across a meridian over the height, through heads and beds.
Figure hoop_figure(const MeridianEvaluation& meridian);

/// The shell unrolled: ring against azimuth (or length), coloured by meridional and hoop force.
Figure force_map(const Evaluation& evaluation);

/// The same, coloured by friction utilisation and by eccentricity over the kern's.
Figure utilisation_map(const Evaluation& evaluation);

/// Displacement and support reaction over time.
Figure history_figure(const Evaluation& evaluation, const std::vector<HistoryRow>& history);

/// All that the evaluation has something to show for.
std::vector<Figure> result_figures(const Evaluation& evaluation, const std::vector<HistoryRow>& history);

}  // namespace cupola

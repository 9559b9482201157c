#pragma once

#include <vector>

#include "postproc/evaluation/evaluation.hpp"
#include "postproc/figures/gnuplot.hpp"
#include "postproc/tables/shell_map.hpp"

namespace cupola {

/// The motion at the end of one step.
struct HistoryRow {
  double time = 0.0;              ///< s
  double max_displacement = 0.0;  ///< m
  double max_speed = 0.0;         ///< m/s
  double reaction = 0.0;          ///< N, upward component of the support forces on the free blocks
};

/// Ranges of a range analysis as bars from minimum to maximum, with a mark at the chosen value. Forces,
/// lengths and ratios have axes of their own, forces one for each of N, kN and MN.
Figure range_figure(const Evaluation& evaluation);

/// The joints of the unrolled shell, coloured by how uncertain their normal force is: the width of its range
/// over its mean, of a range analysis of single joints. In gnuplot's data: $joints has one segment per joint
/// and its value.
Figure certainty_map(const Evaluation& evaluation, const ShellMap& shell);

/// The open joints of the unrolled shell, coloured by their largest gap; without commands if there are none.
Figure crack_map(const Evaluation& evaluation, const ShellMap& shell);

/// Profile with thrust line, envelope and lines of action, and thin lines of least and greatest thrust where
/// the meridian has them; r, v, couple length and distance to the nearer face beside it (paper, figures 7, 8,
/// 10, 13).
Figure thrust_figure(const Evaluation& evaluation, const MeridianEvaluation& meridian);

/// Ring sums against the load above, uniformity and utilisation, over the height.
Figure ring_figure(const Evaluation& evaluation);

/// Plan of the blocks cut at a height with the horizontal parts of their resultants, and the norms of the
/// resultants around the ring (paper, figures 6, 9, 12).
Figure section_figure(const Evaluation& evaluation, const SectionEvaluation& section);

/// Resultants across the beds of all sections, drawn to one scale where they act: a vault seen obliquely from
/// above, a wall in elevation (paper, figures 6, 9, 11, 12).
Figure levels_figure(const Evaluation& evaluation);

/// The blocks cut by a plane, and the normal forces of the joints across it.
Figure plane_figure(const Evaluation& evaluation, const PlaneCut& cut);

/// Hoop force across a meridian over the height, through head and bed joints.
Figure hoop_figure(const MeridianEvaluation& meridian);

/// True if a chain goes round a closed member, unlike tie rods.
bool has_chains_round(const Evaluation& evaluation);

/// Tension of the bars of all such chains over the azimuth.
Figure chain_figure(const Evaluation& evaluation);

/// Displacement, speed and support reaction over time.
Figure history_figure(const Evaluation& evaluation, const std::vector<HistoryRow>& history);

/// All figures for which the evaluation has data.
std::vector<Figure> result_figures(const Evaluation& evaluation, const std::vector<HistoryRow>& history);

}  // namespace cupola

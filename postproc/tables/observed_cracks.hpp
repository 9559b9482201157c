#pragma once

#include <optional>
#include <vector>

#include "postproc/evaluation/evaluation.hpp"
#include "postproc/tables/column.hpp"

namespace cupola {

/// A place at which a crack was looked for on the building, and what the model has in the sector that is
/// nearest to it.
struct ObservedPlace {
  double azimuth = 0.0;       ///< deg
  double width = 0.0;         ///< m, seen there
  double sector = 0.0;        ///< share of the full turn
  double model_width = 0.0;   ///< m, widest gap of a head joint in the sector
  double model_volume = 0.0;  ///< m3, gap times area of the open contact points of its head joints
  double observed_share = 0.0, model_share = 0.0;  ///< of the sums over all places
};

/// Meridional cracks of a run against those seen on the building.
///
/// With the shares p_i of the observed widths and q_i of the volumes of the model's cracks, the agreement is
///
///     sum_i min(p_i, q_i)
///
/// that is 1 if both spread their cracks over the places in the same way, and 0 if the model has none where
/// some were seen. It does not depend on how far a cause has acted, only on where it cracks the shell.
/// `by_chance` is that of cracks spread evenly.
struct CrackAgreement {
  std::vector<ObservedPlace> places;
  double agreement = 0.0, by_chance = 0.0;
};

/// None without `postproc.observed`, or if the run has no equilibrium.
std::optional<CrackAgreement> crack_agreement(const Evaluation& evaluation);

const Columns<ObservedPlace>& observed_columns();
Table observed_table(const CrackAgreement& agreement);

}  // namespace cupola

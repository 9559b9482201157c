#pragma once

#include <string>
#include <vector>

#include "postproc/figures/gnuplot.hpp"
#include "postproc/studies/ensemble_results.hpp"
#include "postproc/tables/table.hpp"

namespace cupola {

/// The share of members at or below each value of a result: one panel per result, one curve per ensemble.
Figure distribution_figure(const std::vector<EnsembleResults>& ensembles);

/// Estimate and interval over the number of members: mean critical value, or the probability of falling. No
/// commands unless the members are independent.
Figure convergence_figure(const EnsembleResults& ensemble);

/// Quantiles of 5, 50 and 95 % over the members that stand, of every number of one of their tables: row by
/// row.
struct Bands {
  std::string source;  ///< name of the table of a member, without ending
  Table table;  ///< the first two columns of the source, `members`, then three columns per number that varies
};
/// Of the thrust lines, hoop forces and rings of members with tables of equal shape; none with `keep:
/// summary`.
std::vector<Bands> bands_of(const EnsembleResults& ensemble, const std::string& runs_folder);
/// One panel per thrust line and curve of forces.
Figure bands_figure(const std::vector<Bands>& bands);

}  // namespace cupola

#pragma once

#include <optional>
#include <vector>

#include "assembly/case/sweep.hpp"
#include "postproc/studies/ensemble_statistics.hpp"

namespace cupola {

/// Members drawn for Sobol indices (A. Saltelli, 2002): of each of N pairs (A, B) of independent members, for
/// every input i also the member of A with the input i of B.
struct SaltelliDesign {
  std::vector<size_t> a, b;              ///< rows of the samples (N)
  std::vector<std::vector<size_t>> a_b;  ///< (inputs x N)
};

/// The design of the samples, which is recognised by its values: rows A, A with each input of B, B for one
/// pair after the other (the order of SALib, also with its members for second-order indices), or all A, all
/// B, then all A with each input of B. Nothing for other samples.
std::optional<SaltelliDesign> saltelli_design(const Samples& samples);

/// Indices of one input, with intervals of Student's t, in which the variance of the result counts as known.
struct SobolIndices {
  IntervalEstimate
      first_order;         ///< A. Saltelli and others, 2010, Comput. Phys. Commun. 181, 259-270, table 2 (b)
  IntervalEstimate total;  ///< the same, table 2 (f), after M. J. W. Jansen, 1999
};
/// `y`: a result of each member; pairs with a member without it (NaN) are left out. NaN if the result is
/// constant.
SobolIndices sobol_indices(const SaltelliDesign& design, size_t input, const std::vector<double>& y);

}  // namespace cupola

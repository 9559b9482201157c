#pragma once

#include <optional>

#include "solver/contact/contact_problem.hpp"

namespace cupola {

/// How good a pair (v, gamma) is, computed from the problem alone: no solver's own hope enters.
struct Residuals {
  double momentum = 0.0;  ///< max over blocks of |M (v - v_star) - D gamma| in the M^-1 norm over the mean
                          ///< block's |h g| (m/s): relative unbalanced impulse
  double contact_law = 0.0;  ///< ||gamma - P(gamma - rho (y + s n))|| / ||gamma||, rho_i = 1/E_i in the norm
                             ///< of E_i; 1/trace(N_ii) only where E = 0
  double cone_violation = 0.0;  ///< max (|gamma_t| - mu gamma_n)+ and (-gamma_n)+, over the largest gamma_n
  std::optional<double> certified_force_error;  ///< sqrt(2 gap / min E) / |gamma|; none when E = 0
};

/// `reference_speed`: h |g|, the speed a free block picks up in a step; makes the momentum residual relative.
Residuals compute_residuals(const ContactProblem& problem, const ContactSolution& solution,
                            double reference_speed);

}  // namespace cupola

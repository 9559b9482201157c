#pragma once

#include <optional>

#include "assembly/model/choices.hpp"
#include "solver/contact/problem/cone.hpp"
#include "solver/contact/problem/contact_problem.hpp"

namespace cupola {

/// How good a pair (v, gamma) is, computed from the problem alone: no solver's own hope enters.
struct Residuals {
  /// max over blocks k of |M_k (v - v_star)_k - (D gamma)_k| in the norm of M_k^-1, over
  /// sqrt(mean mass) * reference_speed: the unbalanced impulse relative to that of the mean block's weight.
  double momentum = 0.0;
  /// |gamma - P(gamma - rho (y + s n))| / |gamma|, with y = D^T v + b + E gamma and P the projection on the
  /// cone; rho_i = 1/E_i and P in the norm of E_i, and rho_i = 1/trace(N_ii) with the Euclidean norm only
  /// where E_i = 0. s = 0 (associated) or mu |y_t| (coulomb). 0 when gamma = 0 is right, 1 when it should not
  /// be.
  double contact_law = 0.0;
  /// Zero compliance only: max over rigid contacts of |gamma - P(gamma - rho (y + s n))| / (rho
  /// reference_speed), the speed by which a contact misses its law. contact_law weighs it by impulses and is
  /// blind to slow creep.
  double rigid_contact_speed = 0.0;
  /// What rounding of D^T v alone puts into contact_law: eps | |D|^T |v| / E | / |gamma|. Large where blocks
  /// slide fast on contacts of tiny compliance: no pair of doubles (v, gamma) meets the law closer there.
  double contact_law_rounding = 0.0;
  /// max over contacts of (|gamma_t| - mu gamma_n)+ and (-gamma_n)+, over the largest |gamma_n|.
  double cone_violation = 0.0;
  /// Upper bound of |gamma - exact| / |gamma| from the duality gap; none where the dual is not strongly
  /// convex (some E = 0), where gamma leaves the cone, or under the Coulomb law, which is no minimisation.
  std::optional<double> certified_force_error;
};

/// `reference_speed`: h |g|, m/s, > 0, the speed a free block picks up in a step.
Residuals compute_residuals(const ContactProblem& problem, const ContactSolution& solution,
                            double reference_speed, FrictionLaw law = FrictionLaw::associated);

/// Worst of the residuals over what can be asked of it at that tolerance: <= 1 is converged. Nobody can ask
/// the contact law for more than rounding leaves.
double excess(const Residuals& residuals, double tolerance);

/// Smallest compliance that takes part, 1/kg: 0 where some contact is rigid, infinite without contacts.
double smallest_compliance(const ContactProblem& problem);

/// trace(N_ii), N = D^T M^-1 D, 1/kg: how far a unit impulse moves the contact by itself.
double delassus_trace(const ContactProblem& problem, int i);

/// Largest M_k^-1 norm of the blocks' share of r = M (v - v_star) - D gamma, N s / sqrt(kg).
double largest_unbalanced_impulse(const ContactProblem& problem, const ContactSolution& solution);

/// sqrt of the mean of the blocks' masses (a third of the trace of the linear part), sqrt(kg); 1 without
/// blocks.
double root_mean_mass(const ContactProblem& problem);

/// Duality gap of (v, gamma in Y), J, without the difference of two large objectives:
///
///     1/2 r^T M^-1 r + sum_i [ 1/2 |gamma - gamma(v)|_E^2 + gamma . z ],  z = D^T v + b + E gamma(v) in Y*
///
/// The dual objective is strongly convex with modulus min E, so |gamma - exact|^2 <= 2 gap / min E.
double duality_gap(const ContactProblem& problem, const ContactSolution& solution);

/// One contact's term of the sum, >= 0, at y = D^T v + b; needs a compliant contact.
double contact_duality_gap(const ContactLaw& law, const Vec3& y, const Vec3& gamma);

}  // namespace cupola

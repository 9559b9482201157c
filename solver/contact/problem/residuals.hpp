#pragma once

#include "assembly/model/accuracy.hpp"
#include "solver/contact/problem/contact_problem.hpp"
#include "solver/contact/problem/flow_rule.hpp"

namespace cupola {

/// Accuracy of a pair (v, gamma), computed from the problem alone and independent of the method's own
/// convergence test.
struct Residuals {
  /// max over blocks k of |M_k (v - v_star)_k - (D gamma)_k| in the norm of M_k^-1, divided by
  /// sqrt(mean mass) * reference_speed: the unbalanced impulse relative to the weight of a mean block.
  double momentum = 0.0;
  /// |gamma - P(gamma - rho (y + s n))| / |gamma| with y = D^T v + b + E gamma, P the projection on the cone,
  /// and s = (1 - dilatancy) mu |y_t|, De Saxce's term (0: associated law). rho_i = 1/E_i and P is in the
  /// norm of E_i; where E_i = 0, rho_i = 1/trace(N_ii) and P is Euclidean. For gamma = 0: 0 if that is
  /// correct, otherwise 1. One number for all contacts: contact_law_errors() shows where the law is violated.
  double contact_law = 0.0;
  /// Zero compliance only: max over rigid contacts of |gamma - P(gamma - rho (y + s n))| / (rho
  /// reference_speed), the speed by which a contact violates its law. contact_law is weighted by impulses and
  /// does not detect slow creep.
  double rigid_contact_speed = 0.0;
  /// Part of contact_law that is due to rounding of D^T v alone: eps | |D|^T |v| / E | / |gamma|, with E of
  /// shear in stick only. Large where blocks slide fast on contacts of tiny compliance; no pair (v, gamma) in
  /// double precision does better.
  double contact_law_rounding = 0.0;
  /// max over contacts of limit_excess() (dry: (|gamma_t| - mu gamma_n)+ and (-gamma_n)+), over the largest
  /// |gamma_n|.
  double cone_violation = 0.0;
  /// Bound of |gamma - exact|_E / |gamma|_E, see duality_gap.hpp. None where some E = 0, where gamma is
  /// outside the cone or zero, and under Coulomb's law, which is not a minimisation.
  ForceCertificate certificate;
};

/// `reference_speed`: h |g|, m/s, > 0, the speed that a free block gains in a step.
Residuals compute_residuals(const ContactProblem& problem, const ContactSolution& solution,
                            double reference_speed, const FlowRule& law = {});

/// |gamma - P(gamma - rho (y + s n))| of each contact, N s (nc): the terms of Residuals::contact_law.
VecX contact_law_errors(const ContactProblem& problem, const ContactSolution& solution, const FlowRule& law);

/// Largest of the momentum residual, the contact-law residual and the speed of rigid contacts.
double largest_residual(const Residuals& residuals);

/// Largest ratio of a residual to its tolerance; <= 1 means converged. The tolerance of contact_law is raised
/// to what rounding permits, but not above 1e-3: a larger violation is reported as not converged, whatever
/// its cause.
double excess(const Residuals& residuals, double tolerance);

/// The residuals with the tolerance, for messages. States if a contact-law residual above the tolerance is
/// accepted because of rounding.
std::string residuals_text(const Residuals& residuals, double tolerance);

/// Smallest compliance, 1/kg, unused tangential ones excluded. 0 if some contact is rigid, infinite without
/// contacts.
double smallest_compliance(const ContactProblem& problem);

/// Whether the impulses of the problem are unique. They are under the associated law if all E > 0.
ForcesUnique forces_unique(const ContactProblem& problem, const FlowRule& law);

/// M^-1 per block (nb).
std::vector<Mat6> inverse_masses(const ContactProblem& problem);
/// N_ii, N = D^T M^-1 D, of every contact, 1/kg (nc): its response to impulses on itself.
std::vector<Mat3> delassus_blocks(const ContactProblem& problem);
/// Their traces (nc).
VecX delassus_traces(const ContactProblem& problem);

/// Residuals::momentum alone.
double momentum_residual(const ContactProblem& problem, const ContactSolution& solution,
                         double reference_speed);

/// Square root of the mean block mass (a third of the trace of the linear part), sqrt(kg); 1 without blocks.
double root_mean_mass(const ContactProblem& problem);

}  // namespace cupola

#pragma once

#include "assembly/base/named_enum.hpp"
#include "solver/contact/problem/contact_problem.hpp"

namespace cupola {

using MatX = Eigen::MatrixXd;

/// A linear function of the multipliers, t -> constant + slope . t.
struct OfMultipliers {
  double constant = 0.0;
  VecX slope;  ///< (nt)
};

/// sign gamma_n <= bound for one contact. sign: 1 or -1.
struct NormalLimit {
  int contact = 0;
  double sign = 1.0;
  OfMultipliers bound;  ///< N
};

/// A linear objective over the forces that balance the loads within the limits of the joints:
///
///     minimise    c . gamma + e . t
///     subject to  D gamma + P t + w = 0          equilibrium of every block
///                 Q^T gamma + R^T t = r          further linear conditions
///                 gamma_i in Y_i                 |gamma_t| <= mu gamma_n
///
/// with free multipliers t, usually those of loads. Its dual,
///
///     maximise    w . v + r . q
///     subject to  s = c + D^T v - Q q in Y*,     e + P^T v - R q = 0
///
/// is a mechanism v under the imposed dislocations c: w . v is the work of the loads on it. (A Lagrange
/// multiplier of the equilibrium is a velocity.) At the solution gamma . s = 0.
///
/// Joints with strength have |gamma_t| <= c + mu gamma_n and -T <= gamma_n <= F (contact_problem.hpp, in N),
/// each of which may be a linear function of the multipliers. s is then free, and the dual loses what the
/// joints dissipate,
///
///     sum_i c |s_t| + T max(0, d) + F max(0, -d),   d = s_n - mu |s_t|
struct ConicProblem {
  ContactProblem
      contacts;       ///< D, mu, plane, strength; M only scales the unknowns; v_star, b, E and h are not used
  VecX load;          ///< w: N, N m (6 nb)
  VecX cost;          ///< c (3 nc)
  MatX load_columns;  ///< P (6 nb, nt)
  VecX multiplier_cost;  ///< e (nt)
  MatX rows;             ///< Q (3 nc, nq)
  MatX row_multipliers;  ///< R (nt, nq)
  VecX row_values;       ///< r (nq)
  /// Strength of each contact per unit of each multiplier, added to that of `contacts`; empty: none (nt of
  /// nc).
  std::vector<std::vector<ContactStrength>> strength_columns = {};
  std::vector<NormalLimit> limits = {};  ///< further ones
  bool has_strength() const { return !contacts.strength.empty() || !strength_columns.empty(); }
};

/// The strength of a contact at the multipliers t.
ContactStrength strength_at(const ConicProblem& problem, int contact, const VecX& t);

/// The problem without its objective, with one multiplier of a further load and its cost. The multiplier
/// changes no strength.
ConicProblem with_multiplier(ConicProblem problem, const VecX& load, double cost);

/// How solve_conic() ended.
enum class ConicOutcome {
  optimal,     ///< primal and dual values agree to the tolerance
  infeasible,  ///< no forces satisfy the conditions; v is the proof: s = D^T v - Q q in Y*, w . v + r . q > 0
  unbounded,   ///< gamma is a ray: D gamma + P t = 0, Q^T gamma + R^T t = 0, c . gamma + e . t < 0
  stalled      ///< none of these to the tolerance; the best iterate is returned
};
constexpr auto enum_names(ConicOutcome) {
  return std::array{"optimal", "infeasible", "unbounded", "stalled"};
}

struct ConicOptions {
  double tolerance = 1e-9;  ///< largest error of an `optimal` solution; see solve_conic()
  double target =
      1e-12;  ///< error at which the iteration stops; beyond `tolerance` as far as rounding allows
  /// The iteration also stops at this error over the scaled objective (at most 1): for estimates of a value
  /// that is refined later. 0: never.
  double relative_target = 0.0;
  int max_iterations = 100;
};

/// Primal and dual solution, or the certificate that the outcome names (of arbitrary length).
struct ConicSolution {
  ConicOutcome outcome = ConicOutcome::stalled;
  VecX gamma;           ///< N (3 nc)
  VecX multipliers;     ///< t (nt)
  VecX v;               ///< mechanism (6 nb)
  VecX row_velocities;  ///< q (nq)
  double primal = 0.0;  ///< c . gamma + e . t
  double dual = 0.0;    ///< w . v + r . q
  int iterations = 0;
  double seconds = 0.0;
};

}  // namespace cupola

#pragma once

#include <vector>

#include "solver/contact/methods/coulomb_direction.hpp"
#include "solver/contact/problem/cone.hpp"
#include "solver/contact/problem/solve_options.hpp"

namespace cupola {

/// The compliant problem that CoulombNewton solves by Newton's method, whitened:
///
///     F(w) = w - v_star - D Gamma(D^T w + b - R centre) = 0,    Gamma of compliance E + R
struct CoulombSubproblem {
  const WhitenedProblem& white;
  double dilatancy;
  double root_mass;  ///< root_mean_mass() of the given problem, sqrt(kg)
  VecX R;            ///< 1/kg (nc)
  VecX centre;       ///< gamma_k (3 nc)

  ContactLaw contact(int i) const {
    const ContactProblem& p = white.given;
    ContactLaw law = contact_law(p, i, p.E[3 * i] + R[i], p.E[3 * i + 1] + R[i]);
    law.dilatancy = dilatancy;
    return law;
  }
  VecX velocity(const VecX& w) const;
  VecX impulses(const VecX& y) const;
  std::vector<Mat3> stiffnesses(const VecX& y) const;
  /// The error of `gamma` in the given problem due to R, max |R (gamma - centre)|, in the unit of w.
  double distance_to_centre(const VecX& gamma) const;
};

struct CoulombPoint {
  VecX w, y, gamma, F;
};

CoulombPoint point_at(const CoulombSubproblem& sub, VecX w);

/// J w = rhs for the solution with all contacts sticking, including those with a gap.
struct StickingSystem {
  std::vector<Mat3> G;  ///< diagonal
  VecX rhs;
};
StickingSystem sticking_system(const CoulombSubproblem& sub);

/// True if the solution `point` of the sticking system solves the subproblem, but for 3 % of the impulses on
/// each block: no contact opens or slides. It scales with the loads, so that structures without gaps reach it
/// from rest without sliding.
bool keeps_sticking(const CoulombSubproblem& sub, const CoulombPoint& point);

/// Largest norm of the 6-vectors of F; NaN if one is.
double largest_block_norm(const VecX& F);

/// How accurately a subproblem is solved.
struct SubproblemAccuracy {
  double tolerance;                ///< of each block of F
  double share = 0.0;              ///< of the error that R causes; if larger, it replaces the tolerance
  bool inexact_directions = true;  ///< GMRES with an earlier factor where that succeeds
};

/// Semismooth Newton from `point`, with a line search on |F|. True if no block of F exceeds the tolerance;
/// otherwise point is the last iterate. Gives up where |F| has not halved in six iterations.
bool solve_subproblem(const CoulombSubproblem& sub, const SubproblemAccuracy& accuracy,
                      const SolveOptions& options, CoulombDirection* direction, CoulombPoint* point,
                      SolveSummary* summary);

}  // namespace cupola

#pragma once

#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "assembly/base/named_enum.hpp"
#include "solver/analysis/statics/cyclic_symmetry.hpp"
#include "solver/analysis/statics/length_control.hpp"
#include "solver/analysis/statics/static_certificate.hpp"
#include "solver/contact/methods/solve_contact.hpp"
#include "solver/contact/problem/residuals.hpp"
#include "solver/dynamics/equilibrium.hpp"
#include "solver/dynamics/simulation.hpp"
#include "solver/dynamics/time_step.hpp"

namespace cupola {

/// An equilibrium near which the next one is sought first, before the methods that need none.
struct NearbyStart {
  std::vector<int> new_blocks = {};  ///< free blocks that were not part of it
  VecX displacement = {};            ///< expected of the blocks, m, rad (6 nb); empty: unknown
};

struct StaticOptions {
  double tolerance = 1e-9;  ///< largest equilibrium residual accepted; no unit
  /// Method, friction law and iteration limit of each contact solve. Tolerance and reference speed follow
  /// from `tolerance` and h and need not be set. A given iteration limit holds for each solve and excludes
  /// second attempts.
  ContactSolverOptions solve = {};
  const CyclicSymmetry* symmetry = nullptr;  ///< if set, only one sector of the model is solved
  double time_advance = 0.0;                 ///< time by which loads and supports advance, s
  /// If set, that time is an unknown, and `time_advance` its first guess.
  std::optional<LengthControl> control = {};
  /// Non-associated laws: only the path from the start counts, not an equilibrium found from the associated
  /// solution, whose dilatancy may have jammed joints. Motions must reach 5 % of the smallest block.
  bool follow_from_start = false;
  /// If set, the start is an equilibrium but for what it names. Compliant joints and Newton's method only.
  std::optional<NearbyStart> nearby = {};
  std::function<void(const std::string&)> log = [](const std::string&) {};
};

/// Equilibrium residual that is small enough to decide whether a structure stands.
constexpr double kOutcomeTolerance = 1e-5;

/// How a static solve ended.
enum class StaticOutcome {
  equilibrium,  ///< equilibrium residual and contact-law residual <= tolerance
  moving,       ///< proven not to stand, or a steady motion was found
  unconverged   ///< neither was shown
};
constexpr auto enum_names(StaticOutcome) {
  return std::array{"equilibrium", "moving", "unconverged"};
}

/// The best iterate, with its accuracy.
struct StaticSolution {
  StaticOutcome outcome = StaticOutcome::unconverged;
  /// Of an equilibrium: forces in exact equilibrium inside the limits of the joints exist
  /// (exact_equilibrium.hpp). Of a motion: no forces balance the loads (motion_proof.hpp).
  bool proven = false;
  /// Of a motion without proof under the associated law: forces in equilibrium would have to be at least so
  /// many times the loads.
  double forces_over_loads = 0.0;
  std::string message;
  double h = 0.0;                 ///< s, step of the proximal-point iteration
  double time_advance = 0.0;      ///< s, that of the options or found by the control
  StepProblem step;               ///< contact problem of the last iteration
  ContactSolution step_solution;  ///< v: displacement from the start over h; gamma: impulses, forces times h
  VecX increment;                 ///< h times v minus that of the iteration before, m, rad (6 nb)
  SolveSummary solve;             ///< of the last contact solve
  Residuals residuals;
  JointForces forces;
  Equilibrium balance;
  double speed_ratio = 0.0;  ///< max |increment| / (g h^2)
  int iterations = 0;        ///< of the contact solver, sum over all solves
  StaticCertificate certificate;
};

/// Finds displacements d and contact forces F of the static problem
///
///     D F + w = 0,     F in Y  _|_  D^T d + gap + c F in Y*
///
/// (c: compliance, w: loads) by the proximal-point method of Rockafellar (1976), "Monotone operators and the
/// proximal point algorithm", in the metric of the masses:
///
///     M (d_k+1 - d_k) / h^2 = D F_k+1 + w
///
/// Each iteration is one step of the dynamic scheme with v_star = d_k / h + h M^-1 w and the same matrix, so
/// that any contact method solves it. Where an equilibrium exists, the increments fall to zero for every h,
/// and the limit does not depend on h; h only sets by how much each iteration reduces the residual. Paper 2.1
/// takes a single iteration with a large h, which leaves a share of inertia in the forces.
///
/// Where no equilibrium exists under the associated law, the increments tend to a mechanism u with w . u > 0
/// that opens every joint or slides along it. A motion is proven where such a mechanism holds in exact
/// arithmetic: the increment, corrected by a motion that opens every contact, or the one that the conic
/// solver finds (motion_proof.hpp). An equilibrium is proven where forces next to those found balance the
/// loads exactly (exact_equilibrium.hpp). Where they do not, the conic solver decides: it gives such forces,
/// or the mechanism that makes the answer `moving`.
///
/// Non-associated laws (dilatancy below 1, Coulomb's law at 0) have no such theory: several equilibria may
/// exist, and a steady motion does not exclude an equilibrium. The associated problem is solved first: what
/// it proves to move also moves under the other laws, because they admit the same forces. If no compliant
/// contact slips in its solution, this solves every flow rule. Otherwise the iterations follow a path from
/// the solution with all contacts sticking, by pseudo-transient continuation (Kelley, Keyes 1998,
/// "Convergence analysis of pseudo-transient continuation"): h grows where Newton's method converges in a few
/// iterations and shrinks where it fails. The inertia term makes each point of the path easy, and the joints
/// close before they slide. Structures near collapse slide slowly over a long way: where the imbalance falls
/// by less than 30 %, half of the last displacement, scaled by h^2, is added to v_star (momentum, Polyak
/// 1964, "Some methods of speeding up the convergence of iteration methods"). Elsewhere momentum would carry
/// blocks past an equilibrium. The path ends in one of four ways:
///
///   equilibrium   the residuals meet the tolerance
///   moving        blocks moved by 100 times the first settlement, and the imbalance did not fall by a
///                 quarter below its lowest value in that time
///   unconverged   h became too short: Newton's method fails on every step
///   unconverged   the imbalance is still above the tolerance after 250 steps
///
/// Where the path shows nothing (unconverged, or a motion of less than 1 % of the smallest block), the
/// proximal-point iteration above is tried from the associated solution; its equilibrium counts, nothing
/// else of it.
///
/// Where the start was an equilibrium until loads changed or blocks were added (StaticOptions::nearby), the
/// way is short: the iterations start from the displacement expected, or from rest, with new blocks where they
/// would stick to their neighbours. An equilibrium that they reach within a few of Newton's counts; everything
/// else is left to the methods above.
///
/// Under a control of the length (length_control.hpp) each iteration also finds the time at which the control
/// displacement is the one asked for. Under the associated law that displacement is the work-conjugate of the
/// force on the control block, if no other load depends on time; the time is then the multiplier of a convex
/// constraint, and the theory above holds. Under the other laws, and for other controls, the iteration is the
/// same; `moving` is never the outcome.
///
/// A path in the dilatancy, from the associated solution to Coulomb's, is shorter far from collapse. Near
/// collapse it passes through states that exist only because joints have opened: slip grows as 1 / dilatancy
/// there.
StaticSolution solve_static(const Model& model, const State& start, const ContactSet& contacts,
                            const ContactMemories& memories, const StaticOptions& options);

/// The contact problem of the first iteration of solve_static().
StepProblem first_static_problem(const Model& model, const State& start, const ContactSet& contacts,
                                 const ContactMemories& memories, const StaticOptions& options);

/// The state after the displacement, at rest, with the load of each joint in its memory.
LoadedState loaded_state(const Model& model, const State& start, const ContactSet& contacts,
                         const ContactMemories& memories, const StaticSolution& solution,
                         const StaticOptions& options);

}  // namespace cupola

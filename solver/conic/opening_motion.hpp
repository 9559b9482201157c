#pragma once

#include "solver/conic/conic_bounds.hpp"

namespace cupola {

/// s_n - mu |s_t| of each contact, s = D^T v: >= 0 in Y* (nc).
VecX distance_inside(const ContactProblem& contacts, const VecX& v);

/// True if the compression of a contact has a limit. It need not open: what it dissipates is bounded.
bool crushes(const ContactProblem& contacts, int i);

/// A motion v0 that opens every contact by more than mu times its slip, except those that crush (joints with
/// compressive strength, ties that yield): D^T v0 = (1, 0, 0) in the least-squares sense. Empty if that one
/// does not, as in structures that can jam (6 nb).
VecX opening_motion(const ConicProblem& problem);

/// Removes rounding from a mechanism, for problems whose objective is one multiplier alone
/// (with_multiplier()). Contacts that stay closed have s = D^T v = 0 up to rounding, and conic_bounds()
/// charges every s outside Y* by a thousand times the largest force: in a slender tower more than the last
/// digits of the limit. So much of opening_motion() is added that all s that must lie in Y* do; then v is
/// scaled back to e + P^T v = 0. Returns false, and leaves the solution as it was, without such a motion.
[[nodiscard]] bool open_contacts(const ConicProblem& problem, ConicSolution* solution);

/// Bounds of the value of such a problem. Where rounding keeps them farther apart than `enough`, the mechanism
/// is improved by open_contacts().
ConicBounds multiplier_bounds(const ConicProblem& problem, double enough, ConicSolution* solution);

}  // namespace cupola

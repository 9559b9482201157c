#pragma once

#include "solver/conic/conic_problem.hpp"

namespace cupola {

/// Removes rounding from a mechanism, for problems whose objective is one multiplier alone (with_multiplier()). Contacts
/// that stay closed have s = D^T v = 0 up to rounding, and conic_bounds() charges every s outside Y* by a thousand times
/// the largest force: in a slender tower more than the last digits of the limit. So much of a motion v0 with
///
///     D^T v0 = (1, 0, 0) at every contact, in the least-squares sense
///
/// is added that all s lie in Y*; then v is scaled back to e + P^T v = 0. Returns false, and leaves the solution as it
/// was, if v0 does not open every contact, as in structures that can jam.
[[nodiscard]] bool open_contacts(const ConicProblem& problem, ConicSolution* solution);

}  // namespace cupola

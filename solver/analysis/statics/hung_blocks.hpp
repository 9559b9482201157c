#pragma once

#include "solver/dynamics/model.hpp"

namespace cupola {

/// Moves blocks that only taut ties hold, such as a lamp on its chain, to where the forces of the ties balance
/// their loads at `time` (s), the other ends of the ties at rest. Blocks that press on each other move as one.
/// Returns true if any moved.
///
/// Such blocks resist a swing by the tension over the length of their ties alone. A static solve does not know
/// that stiffness, because it keeps the directions of ties: once the other ends have moved, it would take the
/// return of the blocks for a fall.
bool let_hang(const Model& model, const ContactSet& contacts, const ContactMemories& memories, double time,
              State* state);

}  // namespace cupola

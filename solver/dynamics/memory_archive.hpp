#pragma once

#include "solver/dynamics/contact_memory.hpp"

namespace cupola {

// The fields of a contact memory that a checkpoint stores. Add any new field that persists from step to step.

template <class Archive>
void visit(Archive& archive, JointDamage& x) {
  archive(x.damage, x.opening, x.crushing, x.step_damage, x.bears);
}

template <class Archive>
void visit(Archive& archive, ContactMemory& x) {
  archive(x.impulse, x.tangent_A, x.elastic_gap, x.elastic_slip_A, x.plastic_slip, x.force_A, x.filtered_A,
          x.loaded_steps, x.overlap, x.joint);
}

template <class Archive>
void visit(Archive& archive, TieMemory& x) {
  archive(x.impulse, x.yielded);
}

}  // namespace cupola

#pragma once

#include "solver/dynamics/time_step.hpp"

namespace cupola {

/// Steps at whose end a contact must have been loaded before its force has a past. In the first the contact
/// may have closed; the force at its end is that of an impact, and at the end of the next that of a contact.
constexpr int kSmooth = 2;

/// Whether the impulse of a contact depends on its force at the start of the step: generalized alpha method
/// only.
inline bool has_past(const ContactMemory& memory, const StepOptions& options) {
  return !options.integrator.is_euler() && memory.loaded_steps >= kSmooth;
}

/// The part of the relative displacement of a contact in a step that is known at its start, m: up to the
/// configuration in the middle, where the gap is measured, and the rest, without reach v+. Zero for implicit
/// Euler.
struct KnownMotion {
  Vec3 to_middle = Vec3::Zero(), rest = Vec3::Zero();
};
/// `v`: velocities at the start of the step (6 nb).
KnownMotion known_motion(const StepProblem& step, int i, const VecX& v, const StepOptions& options);

}  // namespace cupola

#pragma once

#include "solver/analysis/statics/static_solve.hpp"

namespace cupola {

/// Options of a step of the static solve. Initial penetration is not limited by the recovery speed, so that
/// the problem does not depend on h.
StepOptions static_step_options(const StaticOptions& options, double h);

/// Largest displacement of a support in the step, m.
double imposed_displacement(const Model& model, const State& start, const StaticOptions& options);

/// First guess of h, s: one iteration should reduce the equilibrium residual to about a thousandth. A
/// displacement d reached in one step causes the inertia force m d / h^2, so that h^2 >= d / (g 1e-3). The
/// displacement is estimated from the load, the compliance, the gaps and the number of courses.
double first_static_step(const Model& model, const State& start, const ContactSet& contacts,
                         double acceleration, const StaticOptions& options);

/// Largest useful h, s: c m / h^2 = 1e-12 for the most compliant contact but slivers. Elastic displacements
/// are then negligible, and the impulses of a mechanism still have a quarter of their digits. Infinite where
/// all joints are rigid.
double largest_static_step(const Model& model, const State& start, const ContactSet& contacts);

}  // namespace cupola

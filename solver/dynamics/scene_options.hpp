#pragma once

#include "assembly/case/case.hpp"
#include "solver/collision/contact_detector.hpp"
#include "solver/contact/methods/solve_contact.hpp"
#include "solver/dynamics/simulation.hpp"

namespace cupola {

// The only place where options of the solver are read from a case. Every analysis and `--explain` use these
// functions.

/// Contact detection of any analysis. Compliance per area requires points that integrate over the patch.
/// Throws InputError for contacts from a file in an analysis that moves blocks.
DetectionOptions detection_options(const Case& scene);

/// Contact method, friction law, tolerance and iteration limit of any analysis. The reference speed stays
/// unset: each step sets its own.
FlowRule flow_rule(const Analysis& analysis);
ContactSolverOptions contact_solver_options(const Analysis& analysis);

/// Everything that a dynamic analysis of the case depends on.
SimulationOptions simulation_options(const Case& scene);

/// The simulation of a dynamic case, at rest at time 0. The assembly must outlive it. Throws InputError when
/// the model cannot be built (see make_model) or cannot sleep although the case requires it.
Simulation make_simulation(const Case& scene, const Assembly& assembly);

}  // namespace cupola

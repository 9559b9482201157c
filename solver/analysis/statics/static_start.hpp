#pragma once

#include "solver/analysis/statics/static_solve.hpp"
#include "solver/dynamics/simulation.hpp"

namespace cupola {

/// Static solve from which a dynamic analysis starts, under the loads at time 0.
struct StaticStart {
  State rest;
  ContactSet contacts;
  ContactMemories memories;
  StaticOptions options;
  StaticSolution solution;
};

/// Solves for the equilibrium of the assembly as built and, if there is one, starts the simulation from it.
/// Check `solution.outcome`.
StaticStart start_from_equilibrium(const Case& scene, const std::function<void(const std::string&)>& log,
                                   Simulation* simulation);

}  // namespace cupola

#pragma once

#include <memory>

#include "assembly/case/case.hpp"
#include "solver/conic/conic_problem.hpp"
#include "solver/dynamics/contact_memory.hpp"
#include "solver/dynamics/equilibrium.hpp"
#include "solver/dynamics/model.hpp"

namespace cupola {

/// The assembly as built, before supports move, as rigid blocks with joints that only press and rub: what an
/// admissible state of forces has to satisfy. Compliance does not enter.
struct RigidScene {
  std::shared_ptr<const Assembly> assembly;
  Model model;
  State start;
  ContactSet contacts;  ///< those of a static analysis, all within `contact.margin`, or enough of them
  ContactMemories memories;
  ConicProblem problem;       ///< equilibrium under the loads at time 0, without an objective
  bool open_in_part = false;  ///< some scaled joints are: their points do not scale linearly
};

/// Every contact within `contact.margin` counts as closed, as in a static analysis; a tie carries only
/// tension, a strut only compression. `joint_extent`: see scale_joints(). Throws InputError for a joint with
/// cohesion but without friction.
///
/// Dry joints have the points at the corners of their faces only, which carry the same forces and moments as
/// all points; with `all_points`, for stresses, they have all.
RigidScene rigid_scene(const Case& scene, std::shared_ptr<const Assembly> assembly, double joint_extent = 1.0,
                       bool all_points = false);

/// The frame of the forces gamma (N) on the assembly as built. law_violation: excess over the limits of the
/// joints.
Frame admissible_frame(const RigidScene& scene, const VecX& gamma, double time);

/// Balance of the forces gamma (N), recomputed from points and world forces.
Equilibrium balance_of(const RigidScene& scene, const VecX& gamma);

}  // namespace cupola

#pragma once

#include <vector>

#include "assembly/case/case.hpp"
#include "solver/dynamics/heat.hpp"
#include "solver/dynamics/loads.hpp"
#include "solver/dynamics/supports.hpp"
#include "solver/dynamics/ties.hpp"

namespace cupola {

/// The actions that must lie in the plane of a plane scene.
struct PlaneActions {
  const LoadSet& loads;
  const std::vector<Tie>& ties;
  const std::vector<SupportMotion>& support_motions;
  const HeatedBlocks& heat;
};

/// Throws InputError if a scene is not plane. In a plane scene every block is symmetric about one plane
/// normal to y, with its vertices in pairs, and loads, ties and support motions lie in that plane. All motion
/// then stays in x-z, and each block has the unknowns x, z, rot y. Contacts must come from face clipping,
/// because those of perturbed GJK or of a file are not symmetric.
void require_plane_scene(const Case& scene, const Assembly& assembly, const PlaneActions& actions);

}  // namespace cupola

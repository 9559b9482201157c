#pragma once

#include <vector>

#include "assembly/case/case.hpp"
#include "solver/dynamics/loads.hpp"
#include "solver/dynamics/supports.hpp"
#include "solver/dynamics/ties.hpp"

namespace cupola {

/// What must lie in one plane besides the blocks.
struct PlaneActions {
  const LoadSet& loads;
  const std::vector<Tie>& ties;
  const std::vector<SupportMotion>& support_motions;
};

/// Throws InputError naming what is not plane: a plane scene has every block symmetric about one plane across
/// y, its vertices in pairs, and loads, ties and support motions in that plane. Then motion stays in x-z, and
/// x, z, rot y of each block are all there is to find. Contacts from perturbed GJK or a file are not
/// symmetric.
void require_plane_scene(const Case& scene, const Assembly& assembly, const PlaneActions& actions);

}  // namespace cupola

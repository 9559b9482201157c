#pragma once

#include "solver/dynamics/model.hpp"

namespace cupola {

/// Throws InputError naming what is not plane: a plane scene has every block symmetric about one plane across
/// y, its vertices in pairs, and loads, ties and support motions in that plane. Then motion stays in x-z, and
/// x, z, rot y of each block are all there is to find. Contacts from perturbed GJK or a file are not
/// symmetric.
void require_plane_scene(const Model& model, const Case& scene);

}  // namespace cupola

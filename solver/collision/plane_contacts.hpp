#pragma once

#include "solver/collision/patch_contacts.hpp"

namespace cupola {

/// For a scene that is symmetric about a plane normal to y and moves in x-z only: merges contact points of
/// one patch that differ only in y (within `tolerance`, m) into one point midway, with the sum of their areas
/// and multiplicities and the identity of the first.
void merge_across_plane(double tolerance, AnchoredContacts* contacts);

}  // namespace cupola

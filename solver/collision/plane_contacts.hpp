#pragma once

#include "solver/collision/patch_contacts.hpp"

namespace cupola {

/// Of a scene that is symmetric about a plane across y and moves in x-z only: contact points of one patch
/// that differ by more than nothing in y alone (within `tolerance`, m) become one point midway, which stands
/// for the area and the number of both. It keeps the identity of the first.
void merge_across_plane(double tolerance, AnchoredContacts* contacts);

}  // namespace cupola

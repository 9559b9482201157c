#pragma once

#include "generators/surface/drawn_surface.hpp"

namespace cupola {

// Every kind of surface as a profile along a plan. All throw InputError for dimensions that contradict each
// other.

/// The arc rho = -e + R cos t, z = R sin t about the z axis.
Drawing drawing_of(const DomeSurface& dome);
/// The same arc on the corners of a regular polygon.
Drawing drawing_of(const OctagonalVault& vault);
/// The arc from one springing to the plane x = 0, and its mirror image.
Drawing drawing_of(const ArchSurface& arch);
/// A vertical line; y = 0 on the front (extrados), y = thickness on the back.
Drawing drawing_of(const WallSurface& wall);
Drawing drawing_of(const VaultSurface& vault);

/// The pieces of a profile from the springing to the crown or, without a crown, to its end.
std::vector<ProfilePiece> profile_pieces(const Profile& profile);

}  // namespace cupola

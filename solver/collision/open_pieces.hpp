#pragma once

#include "solver/collision/collision_model.hpp"

namespace cupola {

/// Takes from each face what faces of other parts of its block cover from the other side: nothing touches it
/// there. Faces that are covered wholly become internal, others get pieces. The faces, edges and vertices of
/// the parts, which bound them as convex bodies, stay as they are.
void find_open_pieces(CollisionModel* model);

}  // namespace cupola

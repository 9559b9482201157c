#pragma once

#include "postproc/evaluation/evaluation.hpp"
#include "postproc/viewer/packed_arrays.hpp"

namespace cupola {

// The shapes of a scene: faces of the blocks, outlines of the joints, lines.

/// Two corners of a box.
struct Box {
  Vec3 low, high;
};

/// Box around the blocks that are free to move; around all blocks if none is.
Box box_of(const Assembly& assembly);

/// The lattice of all positions: step 0.1 mm, or less in models of which 16 bits can hold more.
Lattice lattice_of(const Assembly& assembly);

/// Vertices, and the faces of every block: vertices, face_sizes, face_inner, face_vertices, block_faces.
/// Faces between two parts of one block are left out, and so are faces with a partner in another block,
/// unless `inner_faces`.
void add_faces(const Assembly& assembly, bool inner_faces, const Lattice& lattice, PackedArrays* arrays);

/// Thrust lines and open joints: points in the array `lines`; the header's list of {what, count}.
nlohmann::json add_lines(const Evaluation& evaluation, const Lattice& lattice, PackedArrays* arrays);

/// Bars of chains and other ties of an equilibrium: both ends of each in the array `ties`, its tension (N) in
/// `tie.force`. Returns what they are called together; null without any.
nlohmann::json add_ties(const Evaluation& evaluation, const Lattice& lattice, PackedArrays* arrays);

}  // namespace cupola

#pragma once

#include <string>
#include <vector>

#include "generators/importer/block_mesh.hpp"

namespace cupola {

// Readers of block files. Each returns the blocks in the order of the file with coordinates as written, and
// throws InputError with file and line for invalid content.

/// Wavefront OBJ: one block per `o`, or per `g` in a file without `o`. A name is the rest of its line, blanks
/// included. A group `course N` numbers the course of the blocks in it. Only `v` and `f` are read besides.
std::vector<RawBlock> read_obj(const std::string& path);

/// OFF, PLY (ascii, binary little- and big-endian) and STL (ascii, binary). The blocks are the connected
/// components of the mesh, named after the file and numbered from 0 if there are several.
std::vector<RawBlock> read_off(const std::string& path);
std::vector<RawBlock> read_ply(const std::string& path);
std::vector<RawBlock> read_stl(const std::string& path);

/// COMPAS assembly JSON: data.graph.data.node[k].block.data.{vertex, face}; `is_support` fixes a block. The
/// attributes `name` (else k), `density` (kg/m3) and `course` of the node are read if they are there.
std::vector<RawBlock> read_compas(const std::string& path);

/// Contact faces of a COMPAS assembly file: data.graph.data.edge[u][v].interfaces[].data.points.
std::vector<RawInterface> read_compas_interfaces(const std::string& path);

/// Brick CSV, one row per block: ID, fixed, visible, yielding, density, force (3), reference point (3), then
/// the corners x, y, z of its convex parts, separated by 9999. The force must be 0.
std::vector<RawBlock> read_bricks(const std::string& path);

/// Springs of brick models, which carry tension only: ID, A, point on A (3), B, point on B (3), k (N/m), L0
/// (m).
std::vector<RawTie> read_springs(const std::string& path);
/// Rigid rods: ID, A, point on A (3), B, point on B (3). Their length is the distance between the points.
std::vector<RawTie> read_rods(const std::string& path);

/// Merges vertices with equal coordinates.
void merge_equal_vertices(PolygonMesh* mesh);

/// Connected surfaces of a mesh, in the order of their first faces. Vertices with equal coordinates are merged
/// if the surfaces are not closed without that. Surfaces that share corners, edges or faces are apart if their
/// faces are oriented outwards.
std::vector<RawBlock> split_components(PolygonMesh mesh, const std::string& path);

}  // namespace cupola

#pragma once

#include <string>
#include <vector>

#include "generators/importer/block_mesh.hpp"

namespace cupola {

// Readers of block files. Each returns the blocks in the file's order, coordinates as written, and throws
// InputError with file and line for what it cannot use.

/// Wavefront OBJ: one block per `o` (or `g` where there is no `o`). Only `v` and `f` count.
std::vector<RawBlock> read_obj(const std::string& path);

/// OFF and PLY (ascii, binary little- and big-endian) and STL (ascii, binary): one mesh, whose connected
/// components are the blocks, named after the file and numbered from 0 when there are several.
std::vector<RawBlock> read_off(const std::string& path);
std::vector<RawBlock> read_ply(const std::string& path);
std::vector<RawBlock> read_stl(const std::string& path);

/// COMPAS assembly JSON: data.graph.data.node[k].block.data.{vertex, face}; `is_support` fixes a block.
std::vector<RawBlock> read_compas(const std::string& path);

/// Contact faces that a COMPAS assembly file brings along:
/// data.graph.data.edge[u][v].interfaces[].data.points.
std::vector<RawInterface> read_compas_interfaces(const std::string& path);

/// Brick CSV, one row per block: ID, fixed, visible, yielding, density, force (3), reference point (3), then
/// the corners x, y, z of its convex parts, parts separated by 9999. Force and reference point are left out.
std::vector<RawBlock> read_bricks(const std::string& path);

/// Springs of brick models: ID, A, point on A (3), B, point on B (3), k (N/m), L0 (m); they only pull.
std::vector<RawTie> read_springs(const std::string& path);
/// Rigid rods: ID, A, point (3), B, point (3); as long as the points are apart.
std::vector<RawTie> read_rods(const std::string& path);

/// Makes one vertex of those with equal coordinates.
void merge_equal_vertices(PolygonMesh* mesh);

/// Connected components of a mesh (faces that share a vertex), in order of their first face.
std::vector<RawBlock> split_components(const PolygonMesh& mesh, const std::string& path);

}  // namespace cupola

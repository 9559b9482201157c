#pragma once

#include <initializer_list>
#include <optional>
#include <string>
#include <vector>

#include <nlohmann/json.hpp>

#include "assembly/base/error.hpp"
#include "generators/importer/block_mesh.hpp"

namespace cupola {

using Json = nlohmann::ordered_json;  ///< keeps the order of the file

/// Line of a byte of the text, counted from 1.
int line_of(const std::string& text, size_t byte);

/// The value at the end of a path of keys. Throws InputError with the first missing key.
const Json& descend(const Json& node, std::initializer_list<const char*> keys, const FileLocation& where,
                    const std::string& what);

/// The value of an attribute; null if it is missing or null in the file.
const Json* attribute_of(const Json& node, const char* key);

/// `is_support`, true or false; none without it. Throws InputError for another value.
std::optional<bool> support_in(const Json& attributes, const FileLocation& where, const std::string& what);
/// The number of the course that the attributes of a block state; none without it or below 0, as of supports.
/// Throws InputError likewise.
std::optional<int> course_in(const Json& attributes, const FileLocation& where, const std::string& what);

/// The mesh of a block: `vertex` (key: x, y, z) and `face` (key: keys of its corners). Throws InputError that
/// names block, vertex or face.
PolygonMesh read_mesh_of(const Json& data, const FileLocation& where, const std::string& block);

/// The blocks of a file of COMPAS that is no assembly: every mesh in it, in the order of the file, whether in
/// nested lists or as the geometry of an element of a model. An element that says `is_support` is fixed;
/// `course` numbers its course.
/// Empty if there is no mesh.
std::vector<RawBlock> read_compas_meshes(const Json& root, const std::string& path);

}  // namespace cupola

#include "generators/importer/compas_json.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <map>
#include <set>

#include <fmt/format.h>

namespace cupola {
namespace {

double coordinate(const Json& vertex, const char* axis, const FileLocation& where, const std::string& what) {
  const Json& value = descend(vertex, {axis}, where, what);
  if (!value.is_number() || !std::isfinite(value.get<double>()))
    throw InputError(where, fmt::format("{}: {} is not a finite number", what, axis));
  return value.get<double>();
}

bool is_mesh(const Json& node) {
  const Json::json_pointer vertices("/data/vertex"), faces("/data/face");
  return node.is_object() && node.contains("dtype") && node.contains(vertices) && node.contains(faces);
}

/// A file that is read, and what its innermost element says about the meshes in it.
struct Walk {
  FileLocation where;
  std::string stem;  ///< of the file, for blocks without a name of their own
  std::set<std::string> names;
  std::vector<RawBlock> blocks;
  bool support = false;
};

void add_mesh(const Json& node, Walk* walk) {
  const size_t number = walk->blocks.size();
  std::string name;
  for (const Json* holder : {&node, &node["data"]})
    if (name.empty() && holder->contains("name") && (*holder)["name"].is_string())
      name = (*holder)["name"].get<std::string>();
  if (name.empty() || !walk->names.insert(name).second) name = fmt::format("{}_{}", walk->stem, number);
  walk->names.insert(name);
  RawBlock block{name, walk->where, {}, {}, walk->support, {}};
  block.mesh = read_mesh_of(node["data"], walk->where, fmt::format("block {}", name));
  if (block.mesh.faces.empty()) throw InputError(walk->where, fmt::format("block {}: no faces", name));
  walk->blocks.push_back(std::move(block));
}

/// Adds the meshes in `node`. An element is an object with `is_support`; files of compas_dem state it for every block.
void find_meshes(const Json& node, Walk* walk) {
  if (is_mesh(node)) return add_mesh(node, walk);
  if (!node.is_structured()) return;
  const bool outer = walk->support;
  if (node.is_object()) {
    if (const auto moved = node.find("transformation"); moved != node.end() && !moved->is_null())
      throw InputError(walk->where, "an element has a transformation; apply it before the export");
    if (const auto flag = node.find("is_support"); flag != node.end() && flag->is_boolean())
      walk->support = flag->get<bool>();
  }
  for (const Json& child : node) find_meshes(child, walk);
  walk->support = outer;
}

}  // namespace

int line_of(const std::string& text, size_t byte) {
  return 1 +
         static_cast<int>(std::count(
             text.begin(), text.begin() + static_cast<std::ptrdiff_t>(std::min(byte, text.size())), '\n'));
}

const Json& descend(const Json& node, std::initializer_list<const char*> keys, const FileLocation& where,
                    const std::string& what) {
  const Json* here = &node;
  for (const char* key : keys) {
    if (!here->is_object() || !here->contains(key))
      throw InputError(where, fmt::format("{}: key '{}' is missing", what, key));
    here = &(*here)[key];
  }
  return *here;
}

PolygonMesh read_mesh_of(const Json& data, const FileLocation& where, const std::string& block) {
  PolygonMesh mesh;
  std::map<std::string, int> id;
  for (const auto& [key, vertex] : descend(data, {"vertex"}, where, block).items()) {
    const std::string what = fmt::format("{}, vertex {}", block, key);
    id[key] = static_cast<int>(mesh.vertices.size());
    mesh.vertices.emplace_back(coordinate(vertex, "x", where, what), coordinate(vertex, "y", where, what),
                               coordinate(vertex, "z", where, what));
  }
  for (const auto& [key, face] : descend(data, {"face"}, where, block).items()) {
    std::vector<int> ids;
    for (const Json& v : face) {
      const auto found = id.find(v.is_string() ? v.get<std::string>() : v.dump());
      if (found == id.end())
        throw InputError(where, fmt::format("{}, face {}: the block has no vertex {}", block, key, v.dump()));
      ids.push_back(found->second);
    }
    if (ids.size() < 3)
      throw InputError(where, fmt::format("{}, face {}: fewer than three vertices", block, key));
    mesh.faces.push_back(std::move(ids));
  }
  return mesh;
}

std::vector<RawBlock> read_compas_meshes(const Json& root, const std::string& path) {
  Walk walk;
  walk.where = FileLocation{path, 1, 0};
  walk.stem = std::filesystem::path(path).stem().string();
  const Json::json_pointer elements("/data/elements");  // of a model; its graph holds meshes of joints
  find_meshes(root.is_object() && root.contains(elements) ? root[elements] : root, &walk);
  return std::move(walk.blocks);
}

}  // namespace cupola

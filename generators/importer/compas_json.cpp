#include "generators/importer/compas_json.hpp"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <set>
#include <tuple>

#include <fmt/format.h>

namespace cupola {
namespace {

double coordinate(const Json& vertex, const char* axis, const FileLocation& where, const std::string& what) {
  const Json& value = descend(vertex, {axis}, where, what);
  if (!value.is_number() || !std::isfinite(value.get<double>()))
    throw InputError(where, fmt::format("{}: {} is not a finite number", what, axis));
  return value.get<double>();
}

/// The vertices and faces of a mesh: of `node` itself, or of what present and former versions of COMPAS put
/// round them. Null: no mesh.
const Json* mesh_in(const Json& node) {
  const auto has_faces = [](const Json& data) {
    return data.is_object() && !data.contains("node") && data.contains("vertex") &&
           data["vertex"].is_object() && data.contains("face") && data["face"].is_object();
  };
  if (!node.is_object()) return nullptr;
  for (const char* wrapper : {"data", "value"})
    if (const auto inner = node.find(wrapper); inner != node.end() && has_faces(*inner)) return &*inner;
  return has_faces(node) ? &node : nullptr;
}

bool is_whole_number(const std::string& key) {
  return !key.empty() && std::ranges::all_of(key, [](unsigned char c) { return std::isdigit(c); });
}

/// A file that is read, and what its innermost element says about the meshes in it.
struct Walk {
  FileLocation where;
  std::string stem;             ///< of the file, for blocks without a name of their own
  std::string key;              ///< of the innermost element that is numbered
  const Json* nodes = nullptr;  ///< of a separate graph that says which blocks are supports, and courses
  std::set<std::string> names;
  std::vector<RawBlock> blocks;
  bool support = false;
  std::optional<int> course;
};

/// Adds what the attributes of the mesh and its node in a separate graph state to what the element does.
void add_attributes(const Json& data, const Walk& walk, RawBlock* block) {
  const std::string what = fmt::format("block {}", block->name);
  block->fixed = walk.support;
  block->course = walk.course;
  const bool has_node = walk.nodes && walk.nodes->contains(walk.key);
  for (const Json* holder :
       {attribute_of(data, "attributes"), has_node ? &(*walk.nodes)[walk.key] : nullptr}) {
    if (!holder) continue;
    block->fixed = block->fixed || support_in(*holder, walk.where, what).value_or(false);
    if (!block->course) block->course = course_in(*holder, walk.where, what);
  }
}

void add_mesh(const Json& node, const Json& data, Walk* walk) {
  std::string name;
  for (const Json* holder : {&node, &data})
    if (name.empty() && holder->contains("name") && (*holder)["name"].is_string())
      name = (*holder)["name"].get<std::string>();
  if (name.empty()) name = walk->key;
  if (name.empty() || !walk->names.insert(name).second)
    name = fmt::format("{}_{}", walk->stem, walk->blocks.size());
  walk->names.insert(name);
  RawBlock block{name, walk->where, {}, {}, false, {}};
  block.mesh = read_mesh_of(data, walk->where, fmt::format("block {}", name));
  add_attributes(data, *walk, &block);
  if (block.mesh.faces.empty()) throw InputError(walk->where, fmt::format("block {}: no faces", name));
  walk->blocks.push_back(std::move(block));
}

/// Throws InputError for a solid beside meshes that is none: it would be missing. Points, lines and frames
/// mark something.
void refuse_other_solids(const Json& list, const FileLocation& where) {
  if (std::ranges::none_of(list, [](const Json& child) { return mesh_in(child) != nullptr; })) return;
  for (size_t i = 0; i < list.size(); ++i) {
    if (!list[i].is_object() || !list[i].contains("dtype") || !list[i]["dtype"].is_string()) continue;
    const std::string type = list[i]["dtype"].get<std::string>();
    for (const char* solid : {"Box", "Polyhedron", "Brep", "Cylinder", "Cone", "Sphere", "Capsule", "Torus"})
      if (type.ends_with(solid))
        throw InputError(where,
                         fmt::format("object {} of a list of meshes is a {}: export it as a mesh, with "
                                     "`vertex` and `face`",
                                     i + 1, type));
  }
}

/// Adds the meshes in `node`, numbered ones by number. An element is an object with `is_support`; files of
/// compas_dem state it for every block.
void find_meshes(const Json& node, Walk* walk) {
  if (const Json* data = mesh_in(node)) return add_mesh(node, *data, walk);
  if (!node.is_structured()) return;
  if (node.is_array()) {
    refuse_other_solids(node, walk->where);
    for (const Json& child : node) find_meshes(child, walk);
    return;
  }
  if (const auto moved = node.find("transformation"); moved != node.end() && !moved->is_null())
    throw InputError(walk->where, "an element has a transformation; apply it before the export");
  const bool outer = walk->support;
  const std::optional<int> outer_course = walk->course;
  const std::string outer_key = walk->key;
  const std::string what = fmt::format("element {}", walk->key);
  walk->support = support_in(node, walk->where, what).value_or(outer);
  if (const std::optional<int> course = course_in(node, walk->where, what)) walk->course = course;
  std::vector<std::string> keys;
  for (const auto& [key, child] : node.items()) keys.push_back(key);
  std::ranges::sort(keys, {}, [](const std::string& key) {
    const bool number = is_whole_number(key);
    return std::tuple(!number, number ? key.size() : 0, key);
  });
  for (const std::string& key : keys) {
    if (is_whole_number(key)) walk->key = key;
    find_meshes(node[key], walk);
    walk->key = outer_key;
  }
  walk->support = outer;
  walk->course = outer_course;
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

const Json* attribute_of(const Json& node, const char* key) {
  if (!node.is_object()) return nullptr;
  const auto value = node.find(key);
  return value == node.end() || value->is_null() ? nullptr : &*value;
}

std::optional<bool> support_in(const Json& attributes, const FileLocation& where, const std::string& what) {
  const Json* flag = attribute_of(attributes, "is_support");
  if (!flag) return std::nullopt;
  if (!flag->is_boolean())
    throw InputError(where, fmt::format("{}: is_support = {}: must be true or false", what, flag->dump()));
  return flag->get<bool>();
}

std::optional<int> course_in(const Json& attributes, const FileLocation& where, const std::string& what) {
  const Json* course = attribute_of(attributes, "course");
  if (!course) return std::nullopt;
  const double number = course->is_number() ? course->get<double>() : 0.5;
  if (std::abs(number) > std::numeric_limits<int>::max() || number != std::floor(number))
    throw InputError(where, fmt::format("{}: course = {}: must be a whole number", what, course->dump()));
  return number < 0.0 ? std::nullopt : std::optional(static_cast<int>(number));
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
  for (const char* graph : {"/assembly/vertex", "/assembly/node"})  // of former versions, beside their blocks
    if (const Json::json_pointer nodes(graph); root.is_object() && root.contains(nodes))
      walk.nodes = &root[nodes];
  find_meshes(root.is_object() && root.contains(elements) ? root[elements] : root, &walk);
  return std::move(walk.blocks);
}

}  // namespace cupola

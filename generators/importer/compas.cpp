#include <algorithm>
#include <charconv>
#include <map>
#include <set>

#include <fmt/format.h>

#include "assembly/files/atomic_file.hpp"
#include "generators/importer/compas_json.hpp"
#include "generators/importer/readers.hpp"

namespace cupola {
namespace {

/// Orders numeric keys by value, so that block 2 comes before block 10.
bool key_before(const std::string& a, const std::string& b) {
  long x = 0, y = 0;
  const bool both_numbers = std::from_chars(a.data(), a.data() + a.size(), x).ec == std::errc() &&
                            std::from_chars(b.data(), b.data() + b.size(), y).ec == std::errc();
  return both_numbers ? x < y : a < b;
}

/// Parses the file. Throws InputError if two blocks have the same name, because JSON libraries keep only the
/// last.
Json parse_assembly(const std::string& text, const std::string& path) {
  std::vector<std::map<std::string, int>> keys;  // of the open objects
  std::vector<std::string> parents{""};          // key whose value is each open object
  return Json::parse(text, [&](int, Json::parse_event_t event, Json& parsed) {
    if (event == Json::parse_event_t::object_start) {
      keys.emplace_back();
      parents.emplace_back();
    } else if (event == Json::parse_event_t::object_end) {
      keys.pop_back();
      parents.pop_back();
    } else if (event == Json::parse_event_t::key) {
      const std::string key = parsed.get<std::string>();
      const bool in_nodes = parents[parents.size() - 2] == "node";
      if (++keys.back()[key] > 1 && in_nodes)
        throw InputError(FileLocation{path},
                         fmt::format("block {}: two blocks of this file have this name", key));
      parents.back() = key;
    }
    return true;
  });
}

/// A file: its text, for line numbers, and what it holds.
struct CompasFile {
  std::string text;
  Json root;
};

CompasFile read_file(const std::string& path) {
  CompasFile file{read_text(path), {}};
  try {
    file.root = parse_assembly(file.text, path);
  } catch (const Json::parse_error& error) {
    throw InputError(FileLocation{path, line_of(file.text, error.byte), 0}, "not valid JSON here");
  } catch (const Json::out_of_range&) {
    throw InputError(FileLocation{path}, "a number does not fit in double precision");
  }
  return file;
}

/// True for an assembly of compas_assembly, whose blocks are attributes of the nodes of its graph.
bool is_assembly(const Json& root) {
  const Json::json_pointer blocks("/data/graph/data/node"), elements("/data/elements");
  if (!root.is_object() || !root.contains(blocks) || root.contains(elements)) return false;
  const Json& nodes = root[blocks];
  return !nodes.is_object() || nodes.empty() ||
         (nodes.begin()->is_object() && nodes.begin()->contains("block"));
}

const Json& graph_of(const Json& root, const std::string& path) {
  return descend(root, {"data", "graph", "data"}, FileLocation{path, 1, 0}, "not a COMPAS assembly");
}

/// The name of a block: the attribute `name` of its node, else the key of the node.
std::string name_of(const Json& node, const std::string& key) {
  if (!node.is_object()) return key;
  const auto name = node.find("name");
  return name != node.end() && name->is_string() ? name->get<std::string>() : key;
}

}  // namespace

std::vector<RawBlock> read_compas(const std::string& path) {
  const auto [text, root] = read_file(path);
  if (!is_assembly(root)) {
    std::vector<RawBlock> blocks = read_compas_meshes(root, path);
    if (blocks.empty())
      throw InputError(FileLocation{path, 1, 0},
                       "not a COMPAS assembly, and no blocks: an object with `vertex` and `face` is a mesh");
    return blocks;
  }
  const Json& nodes =
      descend(graph_of(root, path), {"node"}, FileLocation{path, 1, 0}, "not a COMPAS assembly");
  if (!nodes.is_object())
    throw InputError(FileLocation{path, 1, 0}, "not a COMPAS assembly: 'node' must be an object");
  std::vector<std::string> keys;
  for (const auto& [key, node] : nodes.items()) keys.push_back(key);
  std::ranges::sort(keys, key_before);

  std::vector<RawBlock> blocks;
  std::set<std::string> names;
  for (const std::string& key : keys) {
    const Json& node = nodes[key];
    const FileLocation here{path, line_of(text, text.find('"' + key + "\": {\"block\"")), 0};
    const std::string name = name_of(node, key), what = fmt::format("block {}", name);
    if (!names.insert(name).second)
      throw InputError(here, fmt::format("{}: two blocks of this file have this name", what));
    RawBlock block{name, here, {}, {}, false, {}};
    block.mesh = read_mesh_of(descend(node, {"block", "data"}, here, what), here, what);
    if (block.mesh.faces.empty()) throw InputError(here, fmt::format("{}: no faces", what));
    block.fixed = support_in(node, here, what).value_or(false);
    if (const Json* density = attribute_of(node, "density")) {
      if (!density->is_number() || !(density->get<double>() > 0.0))
        throw InputError(here, fmt::format("{}: density = {}: must be a number > 0", what, density->dump()));
      block.density = density->get<double>();
    }
    block.course = course_in(node, here, what);
    blocks.push_back(std::move(block));
  }
  return blocks;
}

std::vector<RawInterface> read_compas_interfaces(const std::string& path) {
  const auto [text, root] = read_file(path);
  const Json& graph = graph_of(root, path);
  const FileLocation where{path, line_of(text, text.find("\"edge\"")), 0};
  std::vector<RawInterface> interfaces;
  const Json& nodes = descend(graph, {"node"}, where, "not a COMPAS assembly");
  const auto named = [&](const std::string& key) {
    const auto node = nodes.find(key);
    return node == nodes.end() ? key : name_of(*node, key);
  };
  for (const auto& [key_a, others] : descend(graph, {"edge"}, where, "no interfaces").items())
    for (const auto& [key_b, edge] : others.items()) {
      const std::string block_a = named(key_a), block_b = named(key_b);
      const std::string what = fmt::format("interface of blocks {} and {}", block_a, block_b);
      if (!edge.contains("interfaces") || !edge["interfaces"].is_array()) continue;
      for (const Json& face : edge["interfaces"]) {
        RawInterface polygon{where, block_a, block_b, {}};
        for (const Json& p : descend(face, {"data", "points"}, where, what)) {
          if (!p.is_array() || p.size() != 3 || !p[0].is_number() || !p[1].is_number() || !p[2].is_number())
            throw InputError(where, fmt::format("{}: a point must have three numbers", what));
          polygon.points.emplace_back(p[0].get<double>(), p[1].get<double>(), p[2].get<double>());
        }
        if (polygon.points.size() < 3)
          throw InputError(where, fmt::format("{}: fewer than three points", what));
        interfaces.push_back(std::move(polygon));
      }
    }
  if (interfaces.empty()) throw InputError(where, "no interfaces in this file");
  return interfaces;
}

}  // namespace cupola

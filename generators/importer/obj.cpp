#include <charconv>
#include <map>
#include <optional>
#include <string_view>

#include <fmt/format.h>

#include "generators/importer/readers.hpp"
#include "generators/importer/text_lines.hpp"

namespace cupola {
namespace {

/// Index of a vertex. The file counts vertices from 1, or backwards from -1 for the last one so far.
int vertex_index(const TextLines& lines, std::string_view word, size_t num_vertices) {
  const std::string text(word.substr(0, word.find('/')));
  long index = 0;
  try {
    size_t used = 0;
    index = std::stol(text, &used);
    if (used != text.size()) index = 0;
  } catch (const std::exception&) {
    index = 0;
  }
  if (index < 0) index += static_cast<long>(num_vertices) + 1;
  if (index < 1 || index > static_cast<long>(num_vertices))
    lines.fail(fmt::format("f: no vertex '{}', {} are defined above", word, num_vertices));
  return static_cast<int>(index) - 1;
}

/// N of the name "course N" of a group.
std::optional<int> course_of_group(std::string_view group) {
  constexpr std::string_view kPrefix = "course ";
  if (!group.starts_with(kPrefix)) return std::nullopt;
  group.remove_prefix(kPrefix.size());
  int number = 0;
  const auto [end, error] = std::from_chars(group.data(), group.data() + group.size(), number);
  return error == std::errc() && end == group.data() + group.size() ? std::optional(number) : std::nullopt;
}

/// Copies the vertices that a block uses, in the order of their first use.
void keep_used_vertices(const std::vector<Vec3>& all, RawBlock* block) {
  std::map<int, int> local;
  for (auto& face : block->mesh.faces)
    for (int& v : face) {
      const auto [it, is_new] = local.try_emplace(v, static_cast<int>(local.size()));
      if (is_new) block->mesh.vertices.push_back(all[static_cast<size_t>(v)]);
      v = it->second;
    }
}

}  // namespace

std::vector<RawBlock> read_obj(const std::string& path) {
  TextLines lines(path, "", TextLines::Backslash::continues);
  std::vector<Vec3> vertices;
  std::vector<RawBlock> blocks;
  bool has_objects = false;
  std::optional<int> course;  // of the group in force
  const auto is_last_empty = [&] { return !blocks.empty() && blocks.back().mesh.faces.empty(); };
  while (lines.next()) {
    const auto& words = lines.words();
    if (words[0] == "v") {
      vertices.push_back(lines.point(1));
    } else if (words[0] == "g" && has_objects) {
      course = words.size() > 1 ? course_of_group(lines.rest(1)) : std::nullopt;
    } else if (words[0] == "o" || words[0] == "g") {
      if (!has_objects && is_last_empty()) {  // a group of vertices, or of the first objects
        if (words[0] == "o") course = course_of_group(blocks.back().name);
        blocks.pop_back();
      }
      has_objects = has_objects || words[0] == "o";
      const std::string name = words.size() > 1 ? std::string(lines.rest(1)) : std::to_string(blocks.size());
      blocks.push_back({name, lines.where(), {}, {}, false, {}});
      lines.enter(fmt::format("block {}", name));
    } else if (words[0] == "f") {
      if (blocks.empty()) blocks.push_back({"0", lines.where(), {}, {}, false, {}});
      std::vector<int> face;
      for (size_t i = 1; i < words.size(); ++i)
        face.push_back(vertex_index(lines, words[i], vertices.size()));
      if (face.size() < 3) lines.fail("f: a face must have at least three vertices");
      if (blocks.back().mesh.faces.empty() && has_objects) blocks.back().course = course;
      blocks.back().mesh.faces.push_back(face);
    }
  }
  if (!has_objects && blocks.size() > 1 && is_last_empty()) blocks.pop_back();
  if (blocks.empty()) throw InputError(FileLocation{path}, "no faces in this file");
  for (RawBlock& block : blocks) {
    if (block.mesh.faces.empty())
      throw InputError(block.where, fmt::format("block {}: no faces", block.name));
    keep_used_vertices(vertices, &block);
  }
  return blocks;
}

}  // namespace cupola

#include "generators/importer/source_files.hpp"

#include <algorithm>
#include <cctype>
#include <filesystem>
#include <map>
#include <set>

#include <fmt/format.h>

#include "generators/importer/readers.hpp"

namespace cupola {
namespace {

namespace fs = std::filesystem;
using Format = ImportedBlocks::Format;

Format format_of_ending(const fs::path& path) {
  static const std::map<std::string, Format> endings{
      {".obj", Format::obj},     {".off", Format::off},    {".stl", Format::stl},   {".ply", Format::ply},
      {".json", Format::compas}, {".csv", Format::bricks}, {".txt", Format::bricks}};
  std::string ending = path.extension().string();
  std::ranges::transform(ending, ending.begin(), [](unsigned char c) { return std::tolower(c); });
  const auto found = endings.find(ending);
  return found == endings.end() ? Format::automatic : found->second;
}

std::vector<RawBlock> read_block_file(const ImportedBlocks& source, const fs::path& path) {
  switch (format_of(source, path)) {
    case Format::obj:
      return read_obj(path.string());
    case Format::off:
      return read_off(path.string());
    case Format::stl:
      return read_stl(path.string());
    case Format::ply:
      return read_ply(path.string());
    case Format::compas:
      return read_compas(path.string());
    case Format::bricks:
      return read_bricks(path.string());
    case Format::automatic:
      break;
  }
  throw InputError(FileLocation{path.string()}, "unknown file ending; set geometry.import.format");
}

/// Throws InputError for a name that no block has.
void check_names(const ImportedBlocks& source, const std::vector<std::string>& names,
                 const std::map<std::string, size_t>& block_of, const char* key) {
  std::vector<std::string> known;
  for (const auto& [name, block] : block_of) known.push_back(name);
  for (const std::string& name : names) {
    if (block_of.contains(name)) continue;
    const std::string near = nearest_name(name, known);
    throw InputError(fmt::format("geometry.import.{}: {} has no block named '{}'{}", key, source.path, name,
                                 known.empty()  ? "; it holds no blocks"
                                 : near.empty() ? fmt::format("; its first block is '{}'", known.front())
                                                : fmt::format("; did you mean '{}'?", near)));
  }
}

}  // namespace

Format format_of(const ImportedBlocks& source, const std::string& path) {
  return source.format == Format::automatic ? format_of_ending(path) : source.format;
}

std::vector<RawBlock> read_all(const ImportedBlocks& source) {
  if (!fs::is_directory(source.path)) {
    if (!fs::exists(source.path)) throw InputError(FileLocation{source.path}, "no such file or folder");
    return read_block_file(source, source.path);
  }
  std::vector<fs::path> files;
  for (const auto& entry : fs::directory_iterator(source.path)) {
    if (!entry.is_regular_file() || format_of_ending(entry.path()) == Format::automatic) continue;
    const fs::path inside = fs::canonical(entry.path()).lexically_relative(fs::canonical(source.path));
    if (*inside.begin() == "..")
      throw InputError(FileLocation{entry.path().string()}, "is a link to a file outside the folder");
    files.push_back(entry.path());
  }
  std::ranges::sort(files);
  if (files.empty())
    throw InputError(FileLocation{source.path},
                     "no block files in this folder (.obj, .off, .stl, .ply, .json, .csv, .txt)");
  std::vector<RawBlock> blocks;
  for (const fs::path& file : files)
    for (RawBlock& block : read_block_file(source, file)) blocks.push_back(std::move(block));
  return blocks;
}

Vec3 to_world(const ImportedBlocks& source, const Vec3& p) {
  const Vec3 turned = source.up == ImportedBlocks::UpAxis::y ? Vec3(p.x(), -p.z(), p.y()) : p;
  return source.metres_per_unit.value_or(1.0) * turned;
}

void place_in_world(const ImportedBlocks& source, std::vector<RawBlock>* blocks) {
  std::map<std::string, size_t> block_of;
  for (size_t b = 0; b < blocks->size(); ++b) {
    RawBlock& block = (*blocks)[b];
    const auto [it, is_new] = block_of.try_emplace(block.name, b);
    if (!is_new) {
      const FileLocation& first = (*blocks)[it->second].where;
      throw InputError(block.where, fmt::format("block {}: the same name is used at {}:{}", block.name,
                                                first.file, first.line));
    }
    for (Vec3& v : block.mesh.vertices) v = to_world(source, v);
    for (auto& part : block.point_parts)
      for (Vec3& v : part) v = to_world(source, v);
  }
  check_names(source, source.supports, block_of, "supports");
  std::set<std::string> changed;
  for (const BlockDensity& change : source.densities) {
    check_names(source, change.blocks, block_of, "densities");
    for (const std::string& name : change.blocks) {
      if (!changed.insert(name).second)
        throw InputError(fmt::format("geometry.import.densities: gives block '{}' twice", name));
      (*blocks)[block_of[name]].density = change.density;
    }
  }
}

}  // namespace cupola

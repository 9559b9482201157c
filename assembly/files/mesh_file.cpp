#include "assembly/files/mesh_file.hpp"

#include <algorithm>
#include <functional>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/base/error.hpp"
#include "assembly/files/atomic_file.hpp"
#include "assembly/files/markup.hpp"

namespace cupola {
namespace {

template <class T>
constexpr const char* type_name() {
  if constexpr (std::is_same_v<T, double>) return "Float64";
  if constexpr (std::is_same_v<T, std::int32_t>) return "Int32";
  if constexpr (std::is_same_v<T, std::uint8_t>) return "UInt8";
  return "String";
}

}  // namespace

int Mesh::add_point(double x, double y, double z) {
  points.insert(points.end(), {x, y, z});
  return num_points() - 1;
}

void Mesh::add_cell(CellType type, std::span<const int> ids) {
  cell_types.push_back(type);
  cell_points.insert(cell_points.end(), ids.begin(), ids.end());
  cell_start.push_back(static_cast<int>(cell_points.size()));
}

template <class T>
const std::vector<T>& Mesh::array(const std::vector<MeshArray>& arrays, const std::string& name,
                                  int components) const {
  for (const MeshArray& array : arrays) {
    if (array.name != name) continue;
    const auto* values = std::get_if<std::vector<T>>(&array.values);
    if (!values)
      throw InputError(FileLocation{file},
                       fmt::format("array `{}` must have the type {}", name, type_name<T>()));
    if (array.components != components)
      throw InputError(FileLocation{file}, fmt::format("array `{}` has {}, expected {}", name,
                                                       counted(array.components, "component"), components));
    return *values;
  }
  throw InputError(FileLocation{file}, fmt::format("array `{}` is missing", name));
}

template <class T>
const T& Mesh::field(const std::string& name) const {
  const std::vector<T>& values = array<T>(field_data, name, 1);
  if (values.size() != 1)
    throw InputError(FileLocation{file},
                     fmt::format("field `{}` has {}, expected 1", name, counted(values.size(), "value")));
  return values[0];
}

#define CUPOLA_INSTANTIATE(T)                                                                               \
  template const std::vector<T>& Mesh::array(const std::vector<MeshArray>&, const std::string&, int) const; \
  template const T& Mesh::field(const std::string&) const;
CUPOLA_INSTANTIATE(double)
CUPOLA_INSTANTIATE(std::int32_t)
CUPOLA_INSTANTIATE(std::uint8_t)
CUPOLA_INSTANTIATE(std::string)
#undef CUPOLA_INSTANTIATE

bool Mesh::has(const std::vector<MeshArray>& arrays, const std::string& name) const {
  for (const MeshArray& array : arrays)
    if (array.name == name) return true;
  return false;
}

void write_pvd(const std::string& path, const std::vector<PvdEntry>& entries) {
  std::string text =
      "<?xml version=\"1.0\"?>\n<VTKFile type=\"Collection\" version=\"1.0\" byte_order=\"LittleEndian\">\n"
      "  <Collection>\n";
  // ParaView sorts the files by time, and merges those of equal times.
  const bool increasing =
      std::ranges::adjacent_find(entries, std::greater_equal(), &PvdEntry::time) == entries.end();
  for (size_t i = 0; i < entries.size(); ++i)
    text += fmt::format("    <DataSet timestep=\"{:.17g}\" part=\"0\" file=\"{}\"/>\n",
                        increasing ? entries[i].time : static_cast<double>(i), markup_text(entries[i].file));
  text += "  </Collection>\n</VTKFile>\n";
  write_text_atomically(path, text);
}

}  // namespace cupola

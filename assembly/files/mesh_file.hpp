#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace cupola {

/// A named array of a mesh file: `components` values per point, per cell, or per row of field data.
struct MeshArray {
  std::string name;
  int components = 1;
  std::variant<std::vector<double>, std::vector<std::int32_t>, std::vector<std::uint8_t>,
               std::vector<std::string>>
      values;
};

/// Content of a .vtu or .vtp file, without VTK's types: points, cells given by their faces or their point
/// lists, and named arrays. ParaView opens these files.
struct Mesh {
  enum class CellType : std::uint8_t { vertex, polyline, polygon, hexahedron, polyhedron };

  std::vector<double> points;  ///< (3 x num_points)
  std::vector<CellType> cell_types;
  /// Point ids of cell i: cell_points[cell_start[i] .. cell_start[i + 1]). A polyhedron lists its faces as
  /// [num_faces, size, ids..., size, ids...]; the other types list their points.
  std::vector<int> cell_start{0};
  std::vector<int> cell_points;
  std::vector<MeshArray> point_data;
  std::vector<MeshArray> cell_data;
  std::vector<MeshArray> field_data;

  int num_points() const { return static_cast<int>(points.size() / 3); }
  int num_cells() const { return static_cast<int>(cell_types.size()); }
  int add_point(double x, double y, double z);
  void add_cell(CellType type, std::span<const int> ids);
  void add_cell(CellType type, std::initializer_list<int> ids) {
    add_cell(type, std::span(ids.begin(), ids.size()));
  }

  /// The array with this name and value type. Throws InputError that names the file, the array and what was
  /// found instead.
  template <class T>
  const std::vector<T>& array(const std::vector<MeshArray>& arrays, const std::string& name,
                              int components) const;
  /// The only value of a field data array.
  template <class T>
  const T& field(const std::string& name) const;
  bool has(const std::vector<MeshArray>& arrays, const std::string& name) const;
  std::string file;  ///< path from which it was read, for messages
};

/// Writes an unstructured grid (.vtu: hexahedra, polyhedra) or polygonal data (.vtp: vertices, polylines,
/// polygons), chosen by the extension of `path`, atomically and without loss of digits. Throws SystemError.
void write_mesh(const std::string& path, const Mesh& mesh);

/// Reads files written by write_mesh, and no others: the last line of the file is a checksum of the bytes
/// before it. Throws InputError with the path for a missing, truncated, damaged or foreign file.
Mesh read_mesh(const std::string& path);

/// Time series of mesh files as ParaView's collection; file names are relative to the .pvd. Times that do not
/// increase are replaced by the numbers of the files.
struct PvdEntry {
  double time = 0.0;  ///< s
  std::string file;
};
void write_pvd(const std::string& path, const std::vector<PvdEntry>& entries);
std::vector<PvdEntry> read_pvd(const std::string& path);

}  // namespace cupola

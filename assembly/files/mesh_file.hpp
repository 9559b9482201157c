#pragma once

#include <cstdint>
#include <initializer_list>
#include <span>
#include <string>
#include <variant>
#include <vector>

namespace cupola {

/// A named array of a mesh file: `components` values per point, per cell, or free (field data).
struct MeshArray {
  std::string name;
  int components = 1;
  std::variant<std::vector<double>, std::vector<std::int32_t>, std::vector<std::uint8_t>,
               std::vector<std::string>>
      values;
};

/// What a .vtu or .vtp file holds, without VTK's types: points, cells given by their faces or by their
/// point lists, and named arrays. The file is what ParaView opens.
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

  /// The array of that name and value type, or an InputError that names the file, the array and what is
  /// there instead.
  template <class T>
  const std::vector<T>& array(const std::vector<MeshArray>& arrays, const std::string& name,
                              int components) const;
  /// The only value of a field data array.
  template <class T>
  const T& field(const std::string& name) const;
  bool has(const std::vector<MeshArray>& arrays, const std::string& name) const;
  std::string file;  ///< where it was read from, for messages
};

/// Writes an unstructured grid (.vtu: hexahedra, polyhedra) or polygonal data (.vtp: vertices, polylines,
/// polygons), by the ending of `path`, doubles in full, aside and renamed. Throws SystemError.
void write_mesh(const std::string& path, const Mesh& mesh);

/// Reads what write_mesh wrote, and nothing else: the last line of the file is a checksum of all before it.
/// Throws InputError for a missing, truncated, damaged or foreign file, with the path.
Mesh read_mesh(const std::string& path);

/// Time series of mesh files as ParaView's collection; file names are relative to the .pvd.
struct PvdEntry {
  double time = 0.0;  ///< s
  std::string file;
};
void write_pvd(const std::string& path, const std::vector<PvdEntry>& entries);
std::vector<PvdEntry> read_pvd(const std::string& path);

}  // namespace cupola

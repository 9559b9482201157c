#pragma once

#include <limits>

#include "assembly/files/mesh_file.hpp"
#include "tests/fuzz/reader_under_test.hpp"

namespace cupola {

/// The next value; the largest integer wraps around to the smallest.
template <class T>
T next_value(T value) {
  if constexpr (std::is_integral_v<T>)
    return static_cast<T>(static_cast<std::make_unsigned_t<T>>(value) + 1U);
  return static_cast<T>(value + 1);
}

/// Corrupts a mesh as directed by the bytes but keeps it writable: values, cell ids, names, missing and
/// resized field arrays. The writer adds a valid checksum, so that the other checks of the reader are tested.
inline void edit_mesh(ByteSource bytes, Mesh* mesh) {
  const auto corrupt = [&bytes](auto& value) {
    using T = std::decay_t<decltype(value)>;
    if constexpr (std::is_same_v<T, std::string>) {
      value = std::string(bytes.index(300), static_cast<char>('!' + bytes.index(90)));
    } else {
      const T special[] = {T(0),
                           T(-1),
                           std::numeric_limits<T>::max(),
                           std::numeric_limits<T>::lowest(),
                           std::numeric_limits<T>::quiet_NaN(),
                           std::numeric_limits<T>::infinity(),
                           next_value(value),
                           bytes.template take<T>()};
      value = special[bytes.index(std::size(special))];
    }
  };
  const auto edit_array = [&](std::vector<MeshArray>& arrays, bool resizable) {
    if (arrays.empty()) return;
    MeshArray& array = arrays[bytes.index(arrays.size())];
    switch (bytes.index(8)) {
      case 0:
        arrays.erase(arrays.begin() + (&array - arrays.data()));
        return;
      case 1:
        array.name += 'x';
        return;
      case 2:
        if (!resizable) return;
        std::visit([&](auto& values) { values.resize(bytes.index(2 * values.size() + 3)); }, array.values);
        array.components = 1;
        return;
      default:
        std::visit(
            [&](auto& values) {
              if (!values.empty()) corrupt(values[bytes.index(values.size())]);
            },
            array.values);
    }
  };
  while (!bytes.empty()) {
    switch (bytes.index(5)) {
      case 0:
        edit_array(mesh->point_data, false);
        break;
      case 1:
        edit_array(mesh->cell_data, false);
        break;
      case 2:
        edit_array(mesh->field_data, true);
        break;
      case 3:
        if (!mesh->points.empty()) corrupt(mesh->points[bytes.index(mesh->points.size())]);
        break;
      default:
        // Only point ids of hexahedra and vertices: the face counts of polyhedra must stay valid for writing.
        if (mesh->cell_types.empty()) break;
        const size_t cell = bytes.index(mesh->cell_types.size());
        if (mesh->cell_types[cell] == Mesh::CellType::polyhedron) break;
        const int begin = mesh->cell_start[cell];
        corrupt(mesh->cell_points[static_cast<size_t>(begin) +
                                  bytes.index(static_cast<size_t>(mesh->cell_start[cell + 1] - begin))]);
    }
  }
}

}  // namespace cupola

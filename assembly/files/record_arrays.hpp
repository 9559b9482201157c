#pragma once

#include <algorithm>
#include <type_traits>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/base/error.hpp"
#include "assembly/files/mesh_file.hpp"
#include "assembly/model/assembly.hpp"

namespace cupola {

// Records as arrays of mesh files (assembly/records): vectors and matrices as their components, enumerations
// and truth values as bytes.

template <class T>
constexpr int kComponents = 1;
template <int Rows, int Cols>
constexpr int kComponents<Eigen::Matrix<double, Rows, Cols>> = Rows* Cols;

template <class T>
using Stored = std::conditional_t<std::is_enum_v<T> || std::is_same_v<T, bool>, std::uint8_t,
                                  std::conditional_t<(kComponents<T> > 1), double, T>>;

template <class T>
void append(const T& value, std::vector<Stored<T>>* array) {
  if constexpr (kComponents < T >> 1)
    array->insert(array->end(), value.data(), value.data() + kComponents<T>);
  else
    array->push_back(static_cast<Stored<T>>(value));
}

template <class T>
T value_at(const std::vector<Stored<T>>& array, std::size_t row) {
  if constexpr (kComponents < T >> 1)
    return T(array.data() + row * kComponents<T>);
  else
    return static_cast<T>(array[row]);
}

/// The array with this name, type and number of rows; InputError otherwise.
template <class T>
const std::vector<Stored<T>>& array_of(const Mesh& mesh, const std::vector<MeshArray>& arrays,
                                       const std::string& key, std::size_t rows) {
  const auto& values = mesh.array<Stored<T>>(arrays, key, kComponents<T>);
  if (values.size() != rows * kComponents<T>)
    throw InputError(FileLocation{mesh.file},
                     fmt::format("array `{}` has {}, expected {}", key, counted(values.size(), "value"),
                                 rows * kComponents<T>));
  return values;
}

/// Visitors of a record whose members are columns.
struct ColumnWriter {
  std::size_t rows;
  std::vector<MeshArray>* arrays;

  template <class T>
  void operator()(const char* key, const char*, const char*, const std::vector<T>& column) const {
    CUPOLA_ASSERT(column.size() == rows);
    std::vector<Stored<T>> values;
    values.reserve(rows * kComponents<T>);
    for (const T& value : column) append(value, &values);
    arrays->push_back({key, kComponents<T>, std::move(values)});
  }
};
struct ColumnReader {
  std::size_t rows;
  const Mesh& mesh;
  const std::vector<MeshArray>& arrays;

  template <class T>
  void operator()(const char* key, const char*, const char*, std::vector<T>& column) const {
    const auto& values = array_of<T>(mesh, arrays, key, rows);
    column.reserve(rows);
    for (std::size_t row = 0; row < rows; ++row) column.push_back(value_at<T>(values, row));
  }
};

/// Arrays of records that are rows, one array per member.
template <class Row>
void add_rows(const std::vector<Row>& rows, std::vector<MeshArray>* arrays) {
  const std::size_t first = arrays->size();
  const auto create = [&]<class M>(const char* key, const char*, const char*, const M&) {
    arrays->push_back({key, kComponents<M>, std::vector<Stored<M>>{}});
  };
  const Row prototype{};
  fields(create, prototype);
  for (const Row& row : rows) {
    std::size_t next = first;
    const auto add = [&]<class M>(const char*, const char*, const char*, const M& member) {
      append(member, &std::get<std::vector<Stored<M>>>((*arrays)[next++].values));
    };
    fields(add, row);
  }
}

/// The reverse for a given number of rows. Other members keep their defaults.
template <class Row>
std::vector<Row> read_rows(const Mesh& mesh, const std::vector<MeshArray>& arrays, std::size_t number) {
  std::vector<const MeshArray*> found;
  const auto find = [&]<class M>(const char* key, const char*, const char*, const M&) {
    array_of<M>(mesh, arrays, key, number);
    found.push_back(&*std::ranges::find(arrays, key, &MeshArray::name));
  };
  const Row prototype{};
  fields(find, prototype);
  std::vector<Row> rows(number);
  for (std::size_t i = 0; i < number; ++i) {
    std::size_t next = 0;
    const auto read = [&]<class M>(const char*, const char*, const char*, M& member) {
      member = value_at<M>(std::get<std::vector<Stored<M>>>(found[next++]->values), i);
    };
    fields(read, rows[i]);
  }
  return rows;
}

inline std::vector<Vec3> points_of(const Mesh& mesh) {
  std::vector<Vec3> points;
  points.reserve(mesh.points.size() / 3);
  for (int i = 0; i < mesh.num_points(); ++i) points.emplace_back(mesh.points.data() + 3 * i);
  return points;
}

}  // namespace cupola

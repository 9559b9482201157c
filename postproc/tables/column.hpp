#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <span>
#include <string>
#include <type_traits>
#include <variant>
#include <vector>

#include "assembly/base/error.hpp"
#include "assembly/files/mesh_file.hpp"
#include "assembly/model/results.hpp"
#include "postproc/tables/table.hpp"

namespace cupola {

/// A value of a column. Kinds are names in tables and codes in mesh files; texts occur in tables only.
using Value = std::variant<double, int, Vec3, BlockKind, JointKind, std::string>;

/// What is known about a column apart from its values.
struct ColumnInfo {
  std::string key;       ///< snake_case, unit last; `{}` stands for x, y and z in the three keys of a vector
  std::string unit;      ///< "" for pure numbers and names
  std::string meaning;   ///< one phrase
  bool in_table = true;  ///< false: an array of mesh files only
  bool is_vector = false;
  bool is_real = false;  ///< doubles; otherwise integers

  std::string array_name() const;               ///< in mesh files and JSON: force_{}_N is force_N
  std::vector<std::string> table_keys() const;  ///< in CSV files: one key, or three for a vector
};

/// One column of results, stated once: tables, mesh files, the summary and the reference of columns are all
/// made from it. The getter is a function of a row, or a member of the row's type.
template <class Row>
struct Column : ColumnInfo {
  std::function<Value(const Row&)> value;

  template <class Getter>
  Column(const std::string& name, const std::string& si_unit, const std::string& phrase, Getter getter,
         bool tabulated = true)
      : ColumnInfo{name, si_unit, phrase, tabulated, kIsVector<Getter>, kIsReal<Getter>}, value(getter) {
    static_assert(std::is_constructible_v<Value, Result<Getter>>, "the getter returns one of Value's types");
  }

 private:
  template <class Getter>
  using Result = std::decay_t<std::invoke_result_t<Getter, const Row&>>;
  template <class Getter>
  static constexpr bool kIsVector = std::is_same_v<Result<Getter>, Vec3>;
  template <class Getter>
  static constexpr bool kIsReal = kIsVector<Getter> || std::is_same_v<Result<Getter>, double>;
};

template <class Row>
using Columns = std::vector<Column<Row>>;

/// Keys of the columns that one file holds, in its order.
using Keys = std::span<const char* const>;

/// Appends the column's one header or three.
void append_headers(const ColumnInfo& column, std::vector<Table::Column>* headers);
/// Appends the value's one cell or three.
void append_cells(const Value& value, std::vector<Table::Cell>* cells);
/// Appends the value's one or three numbers.
void append_reals(const Value& value, std::vector<double>* numbers);
int to_int(const Value& value);

/// The column whose array has the given name; it must exist.
template <class Row>
const Column<Row>& column_named(const Columns<Row>& columns, const std::string& array_name) {
  const auto found = std::find_if(columns.begin(), columns.end(), [&](const Column<Row>& column) {
    return column.array_name() == array_name;
  });
  CUPOLA_ASSERT(found != columns.end());
  return *found;
}

/// A table of all columns that belong in tables. `rows` is any range of Row.
template <class Row, class Rows>
Table make_table(const std::string& name, const std::string& title, const Columns<Row>& columns,
                 const Rows& rows) {
  Table table{name, title, {}, {}};
  for (const Column<Row>& column : columns)
    if (column.in_table) append_headers(column, &table.columns);
  for (const Row& row : rows) {
    std::vector<Table::Cell>& cells = table.rows.emplace_back();
    cells.reserve(table.columns.size());
    for (const Column<Row>& column : columns)
      if (column.in_table) append_cells(column.value(row), &cells);
    CUPOLA_ASSERT(cells.size() == table.columns.size());
  }
  return table;
}

/// Arrays of a mesh file, one per key, with one entry per row.
template <class Row, class Rows>
std::vector<MeshArray> mesh_arrays(const Columns<Row>& columns, const Rows& rows, Keys keys) {
  std::vector<MeshArray> arrays;
  for (const char* key : keys) {
    const Column<Row>& column = column_named(columns, key);
    MeshArray& array = arrays.emplace_back(MeshArray{key, column.is_vector ? 3 : 1, {}});
    if (column.is_real) {
      std::vector<double> numbers;
      numbers.reserve(rows.size() * static_cast<size_t>(array.components));
      for (const Row& row : rows) append_reals(column.value(row), &numbers);
      array.values = std::move(numbers);
    } else {
      std::vector<std::int32_t> numbers;
      numbers.reserve(rows.size());
      for (const Row& row : rows) numbers.push_back(to_int(column.value(row)));
      array.values = std::move(numbers);
    }
  }
  return arrays;
}

}  // namespace cupola

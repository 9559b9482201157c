#include "postproc/tables/column.hpp"

#include <fmt/format.h>

#include "assembly/base/variant.hpp"

namespace cupola {
namespace {

const std::string kComponent = "{}";

}  // namespace

std::string ColumnInfo::array_name() const {
  const size_t at = key.find(kComponent);
  return at == std::string::npos ? key : key.substr(0, at) + key.substr(at + kComponent.size() + 1);
}

std::vector<std::string> ColumnInfo::table_keys() const {
  CUPOLA_ASSERT(!in_table || is_vector == (key.find(kComponent) != std::string::npos));
  if (!is_vector) return {key};
  std::vector<std::string> keys;
  for (const char* component : {"x", "y", "z"}) keys.push_back(fmt::format(fmt::runtime(key), component));
  return keys;
}

void append_headers(const ColumnInfo& column, std::vector<Table::Column>* headers) {
  const std::vector<std::string> keys = column.table_keys();
  for (size_t i = 0; i < keys.size(); ++i) {
    constexpr const char* kComponents[] = {", x", ", y", ", z"};
    headers->push_back({keys[i], column.unit, column.meaning + (column.is_vector ? kComponents[i] : "")});
  }
}

void append_cells(const Value& value, std::vector<Table::Cell>* cells) {
  std::visit(Overloaded{[&](const Vec3& v) {
                          cells->insert(cells->end(), {v.x(), v.y(), v.z()});
                        },
                        [&](double number) { cells->push_back(number); },
                        [&](int number) { cells->push_back(number); },
                        [&](const std::string& text) { cells->push_back(text); },
                        [&](auto kind) { cells->push_back(to_string(kind)); }},
             value);
}

void append_reals(const Value& value, std::vector<double>* numbers) {
  if (const Vec3* v = std::get_if<Vec3>(&value))
    numbers->insert(numbers->end(), v->begin(), v->end());
  else
    numbers->push_back(std::get<double>(value));
}

int to_int(const Value& value) {
  if (const int* number = std::get_if<int>(&value)) return *number;
  if (const BlockKind* kind = std::get_if<BlockKind>(&value)) return static_cast<int>(*kind);
  return static_cast<int>(std::get<JointKind>(value));
}

}  // namespace cupola

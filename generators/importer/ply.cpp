#include <limits>
#include <optional>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/files/atomic_file.hpp"
#include "generators/importer/binary_bytes.hpp"
#include "generators/importer/readers.hpp"
#include "generators/importer/text_lines.hpp"

namespace cupola {
namespace {

enum class Type { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

struct Property {
  std::string name;
  Type type = Type::float32;
  std::optional<Type> list_count;  ///< type of the count, for a list
};

struct Element {
  std::string name;
  size_t count = 0;
  std::vector<Property> properties;
};

struct Header {
  bool ascii = true, big_endian = false;
  std::vector<Element> elements;
};

Type type_of(const TextLines& lines, std::string_view word) {
  constexpr std::pair<std::string_view, Type> names[] = {
      {"char", Type::int8},      {"int8", Type::int8},       {"uchar", Type::uint8},
      {"uint8", Type::uint8},    {"short", Type::int16},     {"int16", Type::int16},
      {"ushort", Type::uint16},  {"uint16", Type::uint16},   {"int", Type::int32},
      {"int32", Type::int32},    {"uint", Type::uint32},     {"uint32", Type::uint32},
      {"float", Type::float32},  {"float32", Type::float32}, {"double", Type::float64},
      {"float64", Type::float64}};
  for (const auto& [name, type] : names)
    if (name == word) return type;
  lines.fail(fmt::format("'{}' is not a PLY type", word));
}

/// Reads the header; the next line of `lines` is then the first line of data.
Header read_header(TextLines* lines) {
  Header header;
  if (!lines->next() || lines->words()[0] != "ply") lines->fail("a PLY file must begin with ply");
  while (lines->next()) {
    const auto& w = lines->words();
    const auto need = [&](size_t n) {
      if (w.size() < n) lines->fail(fmt::format("'{}' requires {}", w[0], counted(n - 1, "more word")));
    };
    if (w[0] == "end_header") return header;
    if (w[0] == "format") {
      need(2);
      header.ascii = w[1] == "ascii";
      header.big_endian = w[1] == "binary_big_endian";
      if (!header.ascii && !header.big_endian && w[1] != "binary_little_endian")
        lines->fail(fmt::format(
            "unknown format '{}', must be ascii, binary_little_endian or binary_big_endian", w[1]));
    } else if (w[0] == "element") {
      need(3);
      header.elements.push_back({std::string(w[1]), lines->count(2, 1), {}});
    } else if (w[0] == "property") {
      need(3);
      if (header.elements.empty()) lines->fail("property before the first element");
      auto& properties = header.elements.back().properties;
      if (w[1] == "list") {
        need(5);
        properties.push_back({std::string(w[4]), type_of(*lines, w[3]), type_of(*lines, w[2])});
      } else {
        properties.push_back({std::string(w[2]), type_of(*lines, w[1]), std::nullopt});
      }
    }
  }
  lines->fail("the header does not end with end_header");
}

double take(BinaryBytes* data, Type type) {
  switch (type) {
    case Type::int8:
      return data->take<std::int8_t>();
    case Type::uint8:
      return data->take<std::uint8_t>();
    case Type::int16:
      return data->take<std::int16_t>();
    case Type::uint16:
      return data->take<std::uint16_t>();
    case Type::int32:
      return data->take<std::int32_t>();
    case Type::uint32:
      return data->take<std::uint32_t>();
    case Type::float32:
      return data->take<float>();
    case Type::float64:
      return data->take<double>();
  }
  return 0.0;
}

/// Reads consecutive numbers from ascii or binary data.
class Values {
 public:
  Values(TextLines* lines, BinaryBytes* data) : lines_(lines), data_(data) {}
  void start_row() {
    word_ = 0;
    if (!data_ && !lines_->next()) lines_->fail("the file ends before its last element");
  }
  double next(Type type) {
    if (data_) return take(data_, type);
    return lines_->number(word_++);
  }
  size_t next_count(Type type) {
    const double value = next(type);
    const size_t left = data_ ? data_->bytes_left() : lines_->words().size();
    if (!(value >= 0.0 && value <= static_cast<double>(left)))
      throw InputError(lines_->where(),
                       fmt::format("a list declares {} items, more than the file holds", value));
    return static_cast<size_t>(value);
  }

 private:
  TextLines* lines_;
  BinaryBytes* data_;  // null: ascii
  size_t word_ = 0;
};

/// Converts a vertex index. Values that are not an index become -1, which is out of range.
int to_index(double value) {
  return value >= 0.0 && value <= std::numeric_limits<int>::max() ? static_cast<int>(value) : -1;
}

void read_row(const Element& element, Values* values, const std::string& path, PolygonMesh* mesh) {
  Vec3 point = Vec3::Zero();
  values->start_row();
  for (const Property& property : element.properties) {
    if (!property.list_count) {
      const double value = values->next(property.type);
      if (property.name.size() == 1 && property.name >= "x" && property.name <= "z")
        point[property.name[0] - 'x'] = value;
      continue;
    }
    const size_t size = values->next_count(*property.list_count);
    std::vector<int> list;
    for (size_t i = 0; i < size; ++i) list.push_back(to_index(values->next(property.type)));
    if (element.name != "face" || (property.name != "vertex_indices" && property.name != "vertex_index"))
      continue;
    for (int v : list)
      if (v < 0 || v >= static_cast<int>(mesh->vertices.size()))
        throw InputError(
            FileLocation{path},
            fmt::format("face {}: vertex {} is out of range, the file defines {}", mesh->faces.size(), v,
                        counted(mesh->vertices.size(), "vertex", "vertices")));
    if (list.size() < 3)
      throw InputError(FileLocation{path},
                       fmt::format("face {}: fewer than three vertices", mesh->faces.size()));
    mesh->faces.push_back(std::move(list));
  }
  if (element.name != "vertex") return;
  if (!point.allFinite())
    throw InputError(FileLocation{path}, fmt::format("vertex {} is not finite", mesh->vertices.size()));
  mesh->vertices.push_back(point);
}

}  // namespace

std::vector<RawBlock> read_ply(const std::string& path) {
  TextLines lines(path);
  const Header header = read_header(&lines);
  const std::string bytes = header.ascii ? std::string() : read_text(path);
  std::optional<BinaryBytes> data;
  if (!header.ascii) data.emplace(path, bytes, bytes.size() - lines.bytes_left(), header.big_endian);
  Values values(&lines, data ? &*data : nullptr);
  PolygonMesh mesh;
  for (const Element& element : header.elements)
    for (size_t i = 0; i < element.count; ++i) read_row(element, &values, path, &mesh);
  return split_components(std::move(mesh), path);
}

}  // namespace cupola

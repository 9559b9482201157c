#include <algorithm>
#include <cctype>
#include <cmath>
#include <string_view>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/files/atomic_file.hpp"
#include "generators/importer/binary_bytes.hpp"
#include "generators/importer/readers.hpp"
#include "generators/importer/text_lines.hpp"

namespace cupola {
namespace {

constexpr size_t kHeaderBytes = 84, kTriangleBytes = 50;

/// Some programs write the words of the format in upper case.
std::string lower_case(std::string_view text) {
  std::string lower(text);
  std::ranges::transform(lower, lower.begin(), [](unsigned char c) { return std::tolower(c); });
  return lower;
}

PolygonMesh read_ascii(const std::string& path) {
  TextLines lines(path);
  PolygonMesh mesh;
  while (lines.next()) {
    if (lower_case(lines.words()[0]) != "vertex") continue;
    mesh.vertices.push_back(lines.point(1));
    const int n = static_cast<int>(mesh.vertices.size());
    if (n % 3 == 0) mesh.faces.push_back({n - 3, n - 2, n - 1});
  }
  if (mesh.vertices.size() % 3 != 0) lines.fail("the last triangle has fewer than three vertices");
  return mesh;
}

PolygonMesh read_binary(const std::string& path, const std::string& bytes) {
  BinaryBytes data(path, bytes, kHeaderBytes - 4, false);
  const auto num_triangles = data.take<std::uint32_t>();
  if (num_triangles > data.bytes_left() / kTriangleBytes)
    throw InputError(FileLocation{path},
                     fmt::format("declares {}, but the rest of the file has {}",
                                 counted(num_triangles, "triangle"), counted(data.bytes_left(), "byte")));
  PolygonMesh mesh;
  for (std::uint32_t t = 0; t < num_triangles; ++t) {
    for (int i = 0; i < 3; ++i) data.take<float>();  // normal; the order of the vertices defines it
    for (int corner = 0; corner < 3; ++corner) {
      const double x = data.take<float>(), y = data.take<float>(), z = data.take<float>();
      if (!std::isfinite(x + y + z))
        throw InputError(FileLocation{path}, fmt::format("triangle {}: a coordinate is not finite", t));
      mesh.vertices.emplace_back(x, y, z);
    }
    data.take<std::uint16_t>();
    const int n = static_cast<int>(mesh.vertices.size());
    mesh.faces.push_back({n - 3, n - 2, n - 1});
  }
  return mesh;
}

}  // namespace

std::vector<RawBlock> read_stl(const std::string& path) {
  const std::string text = lower_case(read_text(path));
  const bool ascii = text.starts_with("solid") && text.find("facet") != std::string::npos;
  return split_components(ascii ? read_ascii(path) : read_binary(path, read_bytes(path)), path);
}

}  // namespace cupola

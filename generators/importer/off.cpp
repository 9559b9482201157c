#include <fmt/format.h>

#include "generators/importer/readers.hpp"
#include "generators/importer/text_lines.hpp"

namespace cupola {

std::vector<RawBlock> read_off(const std::string& path) {
  TextLines lines(path);
  const auto advance = [&](const char* expected) {
    if (!lines.next()) lines.fail(fmt::format("the file ends before {}", expected));
  };
  advance("its header");
  if (lines.words()[0] != "OFF") lines.fail("an OFF file must begin with OFF");
  const size_t shift = lines.words().size() > 1 ? 1 : 0;  // the counts may be on the same line
  if (shift == 0) advance("the counts of vertices and faces");
  const size_t num_vertices = lines.count(shift, 5);
  const size_t num_faces = lines.count(shift + 1, 7);

  PolygonMesh mesh;
  for (size_t v = 0; v < num_vertices; ++v) {
    advance("all vertices");
    mesh.vertices.push_back(lines.point(0));
  }
  for (size_t f = 0; f < num_faces; ++f) {
    advance("all faces");
    const long size = lines.integer(0);
    std::vector<int> face;
    for (long i = 0; i < size; ++i) {  // integer() fails when the line ends
      const long v = lines.integer(static_cast<size_t>(1 + i));
      if (v < 0 || v >= static_cast<long>(num_vertices))
        lines.fail(fmt::format("no vertex {}, {} are defined", v, num_vertices));
      face.push_back(static_cast<int>(v));
    }
    if (face.size() < 3) lines.fail("a face must have at least three vertices");
    mesh.faces.push_back(std::move(face));
  }
  return split_components(std::move(mesh), path);
}

}  // namespace cupola

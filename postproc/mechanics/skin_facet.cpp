#include "postproc/mechanics/skin_facet.hpp"

#include <algorithm>
#include <span>

namespace cupola {
namespace {

/// The edges of `face` that it shares with faces of the given kind of the same part.
std::vector<size_t> edges_on(const Assembly& assembly, const Part& part, std::span<const int> face,
                             FaceKind kind) {
  std::vector<size_t> edges;
  for (int f = part.face_start; f < part.face_start + part.num_faces; ++f) {
    if (assembly.face_kinds[f] != kind) continue;
    const auto skin = assembly.face(f);
    for (size_t i = 0; i < face.size(); ++i)
      for (size_t j = 0; j < skin.size(); ++j)  // neighbouring faces run along an edge in opposite directions
        if (face[i] == skin[(j + 1) % skin.size()] && face[(i + 1) % face.size()] == skin[j])
          edges.push_back(i);
  }
  return edges;
}

}  // namespace

void add_skin_facet(const Assembly& assembly, const Part& part, int f, std::vector<BedFacet>* bed) {
  const auto face = assembly.face(f);
  const size_t n = face.size();
  const auto inner = edges_on(assembly, part, face, FaceKind::intrados);
  const auto outer = edges_on(assembly, part, face, FaceKind::extrados);
  const auto vertex = [&](size_t i) { return assembly.vertices[face[i % n]]; };
  const Sheet axis = assembly.axis_of(part.ring);
  // The end of an edge; if it is on the other skin, too, what lies beyond the azimuth of that skin's corner is
  // of the cut.
  const auto end = [&](size_t at, size_t from, size_t beside, const std::vector<size_t>& others) -> Vec3 {
    const Vec3 p = vertex(at), q = vertex(from), radius = axis.own(vertex(beside));
    const auto across = [&](const Vec3& x) {
      const Vec3 own = axis.own(x);
      return radius.x() * own.y() - radius.y() * own.x();
    };
    const auto ends = [&](size_t other) { return other == at % n || (other + 1) % n == at % n; };
    const double s = across(p), t = across(q);
    return std::ranges::any_of(others, ends) && s * t < 0.0 ? Vec3(p + s / (s - t) * (q - p)) : p;
  };
  for (const size_t i : inner)
    for (const size_t o : outer) {
      if ((i + 1) % n == o || (o + 1) % n == i) continue;
      // Going round the face, the two edges run in opposite directions.
      bed->push_back({part.block, end(i, i + 1, o + 1, outer), end(i + 1, i, o, outer),
                      end(o + 1, o, i, inner), end(o, o + 1, i + 1, inner),
                      assembly.face_kinds[f] == FaceKind::internal});
      return;
    }
}

}  // namespace cupola

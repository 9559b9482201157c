#include "assembly/model/thickness.hpp"

#include <algorithm>
#include <limits>
#include <map>
#include <set>

#include <fmt/format.h>
#include <fmt/ranges.h>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

std::set<int> vertices_on(const Assembly& assembly, const Part& part, FaceKind kind) {
  std::set<int> vertices;
  for (int f = part.face_start; f < part.face_start + part.num_faces; ++f)
    if (assembly.face_kinds[f] == kind) vertices.insert(assembly.face(f).begin(), assembly.face(f).end());
  return vertices;
}

/// Adds the edges of a part that connect its intrados with its extrados.
void add_edges_across(const Assembly& assembly, const Part& part, std::map<int, int>* extrados_of) {
  const std::set<int> inner = vertices_on(assembly, part, FaceKind::intrados);
  const std::set<int> outer = vertices_on(assembly, part, FaceKind::extrados);
  for (int f = part.face_start; f < part.face_start + part.num_faces; ++f) {
    const auto ids = assembly.face(f);
    for (std::size_t i = 0; i < ids.size(); ++i) {
      int a = ids[i], b = ids[(i + 1) % ids.size()];
      if (!inner.contains(a)) std::swap(a, b);
      if (!inner.contains(a) || !outer.contains(b)) continue;
      if (const auto [edge, is_new] = extrados_of->emplace(a, b); !is_new && edge->second != b)
        throw InputError(
            "analysis.limit.parameter: thickness: a vertex of the intrados has edges to two vertices of the "
            "extrados, so that the thickness is not defined");
    }
  }
}

/// Each corner of a stone needs one edge across: those that a cut or an opening makes between the skins would
/// stay where they are, and bend the faces.
void check_corners(const Assembly& assembly, const std::map<int, int>& extrados_of) {
  std::set<int> across;
  for (const auto& [inner, outer] : extrados_of) across.insert({inner, outer});
  const auto is_across = [&](int vertex) { return across.contains(vertex); };
  for (const Part& part : assembly.parts)
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f)
      if (!assembly.blocks[part.block].fixed && !std::ranges::all_of(assembly.face(f), is_across))
        throw InputError(fmt::format(
            "analysis.limit.parameter: thickness: requires stones whose corners all lie on edges from the "
            "intrados to the extrados; some of block {} do not, as where a cut, an opening or a groin meets "
            "joints; compare runs with other thicknesses of the member instead, by --set",
            part.block));
}

/// From the vertices on the intrados to those across the thickness.
std::map<int, int> edges_across(const Assembly& assembly) {
  if (assembly.members.size() > 1)
    throw InputError(
        fmt::format("analysis.limit.parameter: thickness: requires one member without wythes, and the model "
                    "has {}; compare runs with other thicknesses of a member instead, by --set",
                    fmt::join(assembly.members, ", ")));
  std::map<int, int> extrados_of;
  for (const Part& part : assembly.parts) add_edges_across(assembly, part, &extrados_of);
  if (extrados_of.empty())
    throw InputError("analysis.limit.parameter: thickness: no block has both an intrados and an extrados");
  check_corners(assembly, extrados_of);
  return extrados_of;
}

std::vector<Vec3> scaled_vertices(const Assembly& assembly, const std::map<int, int>& extrados_of,
                                  double factor) {
  std::vector<Vec3> vertices = assembly.vertices;
  for (const auto& [inner, outer] : extrados_of) {
    const Vec3 middle = 0.5 * (assembly.vertices[inner] + assembly.vertices[outer]);
    const Vec3 half = 0.5 * factor * (assembly.vertices[outer] - assembly.vertices[inner]);
    vertices[inner] = middle - half;
    vertices[outer] = middle + half;
  }
  return vertices;
}

}  // namespace

ThicknessLimit largest_thickness(const Assembly& assembly) {
  constexpr double kSliver = 1e-3;  // of its length as built, to which the shortest edge of a skin shrinks
  const std::vector<Vec3> twice = scaled_vertices(assembly, edges_across(assembly), 2.0);
  ThicknessLimit limit{std::numeric_limits<double>::infinity(), -1};
  for (const Part& part : assembly.parts) {
    if (assembly.blocks[part.block].fixed) continue;
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f) {
      if (assembly.face_kinds[f] != FaceKind::intrados && assembly.face_kinds[f] != FaceKind::extrados)
        continue;
      const auto ids = assembly.face(f);
      for (std::size_t i = 0; i < ids.size(); ++i) {
        const int a = ids[i], b = ids[(i + 1) % ids.size()];
        const Vec3 edge = assembly.vertices[b] - assembly.vertices[a];
        const double shrinks = -edge.dot(twice[b] - twice[a] - edge) / edge.squaredNorm();  // linear
        const double factor = 1.0 + (1.0 - kSliver) / shrinks;
        if (shrinks > 0.0 && factor < limit.factor) limit = {factor, part.block};
      }
    }
  }
  return limit;
}

Assembly with_thickness(const Assembly& assembly, double factor) {
  CUPOLA_ASSERT(factor > 0.0);
  Assembly changed = assembly;
  changed.vertices = scaled_vertices(assembly, edges_across(assembly), factor);
  compute_mass_properties(&changed);
  return changed;
}

}  // namespace cupola

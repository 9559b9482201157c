#include "assembly/model/thickness.hpp"

#include <algorithm>
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

}  // namespace

Assembly with_thickness(const Assembly& assembly, double factor) {
  CUPOLA_ASSERT(factor > 0.0);
  if (assembly.members.size() > 1)
    throw InputError(
        fmt::format("analysis.limit.parameter: thickness: requires one member without wythes, and the model "
                    "has {}; compare runs with other thicknesses of a member instead, by --set",
                    fmt::join(assembly.members, ", ")));
  std::map<int, int> extrados_of;  // vertex on the intrados -> vertex across the thickness
  for (const Part& part : assembly.parts) add_edges_across(assembly, part, &extrados_of);
  if (extrados_of.empty())
    throw InputError("analysis.limit.parameter: thickness: no block has both an intrados and an extrados");
  check_corners(assembly, extrados_of);
  Assembly changed = assembly;
  for (const auto& [inner, outer] : extrados_of) {
    const Vec3 middle = 0.5 * (assembly.vertices[inner] + assembly.vertices[outer]);
    const Vec3 half = 0.5 * factor * (assembly.vertices[outer] - assembly.vertices[inner]);
    changed.vertices[inner] = middle - half;
    changed.vertices[outer] = middle + half;
  }
  compute_mass_properties(&changed);
  return changed;
}

}  // namespace cupola

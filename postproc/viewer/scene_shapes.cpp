#include "postproc/viewer/scene_shapes.hpp"

#include <algorithm>
#include <span>
#include <utility>

#include "postproc/tables/mesh_output.hpp"

namespace cupola {
namespace {

/// Faces with the same vertices are the two sides of a joint. Returns true for each of them.
std::vector<bool> faces_with_partner(const Assembly& assembly) {
  std::vector<int> sorted = assembly.face_vertices;
  const auto vertices_of = [&](int f) {
    const auto begin = sorted.begin() + assembly.face_vertex_start[f];
    return std::span(begin, sorted.begin() + assembly.face_vertex_start[f + 1]);
  };
  // The faces with the same first vertex are chained.
  std::vector<int> last_with(assembly.vertices.size(), -1);
  std::vector<int> previous(static_cast<size_t>(assembly.num_faces()), -1);
  std::vector<bool> has_partner(previous.size(), false);
  for (int f = 0; f < assembly.num_faces(); ++f) {
    const std::span<int> ids = vertices_of(f);
    std::ranges::sort(ids);
    for (int g = last_with[ids.front()]; g >= 0; g = previous[g])
      if (std::ranges::equal(ids, vertices_of(g))) has_partner[f] = has_partner[g] = true;
    previous[f] = std::exchange(last_with[ids.front()], f);
  }
  return has_partner;
}

/// Polylines of one kind.
struct Lines {
  nlohmann::json list = nlohmann::json::array();
  std::vector<Vec3> points;

  void add(const char* what, const std::vector<Vec3>& line) {
    if (line.size() < 2) return;
    list.push_back({{"what", what}, {"count", line.size()}});
    points.insert(points.end(), line.begin(), line.end());
  }

  void add(const char* what, const ThrustLine& thrust) {
    for (const std::vector<Vec3>& run : thrust.runs()) add(what, run);
  }
};

}  // namespace

Box box_of(const Assembly& assembly) {
  constexpr double kFar = std::numeric_limits<double>::infinity();
  const bool any_free =
      std::any_of(assembly.blocks.begin(), assembly.blocks.end(), [](const Block& b) { return !b.fixed; });
  Box box{Vec3::Constant(kFar), Vec3::Constant(-kFar)};
  for (const Part& part : assembly.parts) {
    if (any_free && assembly.blocks[part.block].fixed) continue;
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f)
      for (const int v : assembly.face(f)) {
        box.low = box.low.cwiseMin(assembly.vertices[v]);
        box.high = box.high.cwiseMax(assembly.vertices[v]);
      }
  }
  return box;
}

Lattice lattice_of(const Assembly& assembly) {
  constexpr double kLargestStep = 1e-4;  // m
  constexpr double kSteps = 65535.0;     // of 16 bits
  const Box box = box_of(assembly);
  return {std::min(kLargestStep, (box.high - box.low).maxCoeff() / kSteps), box.low};
}

void add_faces(const Assembly& assembly, bool inner_faces, const Lattice& lattice, PackedArrays* arrays) {
  constexpr size_t kMostCorners = 255;  // of one face, as a byte counts them; further ones are left out
  const std::vector<bool> has_partner = faces_with_partner(assembly);
  std::vector<std::uint8_t> sizes, inner;
  std::vector<int> vertices, of_block(assembly.blocks.size(), 0);
  for (const Part& part : assembly.parts) {
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f) {
      if (assembly.face_kinds[f] == FaceKind::internal || (has_partner[f] && !inner_faces)) continue;
      const auto face = assembly.face(f);
      const size_t corners = std::min(face.size(), kMostCorners);
      sizes.push_back(static_cast<std::uint8_t>(corners));
      inner.push_back(has_partner[f]);
      vertices.insert(vertices.end(), face.begin(), face.begin() + static_cast<std::ptrdiff_t>(corners));
      ++of_block[part.block];
    }
  }
  arrays->add_points("vertices", assembly.vertices, lattice);
  arrays->add("face_sizes", sizes);
  arrays->add("face_inner", inner);
  arrays->add("face_vertices", vertices, 1);
  arrays->add("block_faces", of_block);
}

nlohmann::json add_lines(const Evaluation& e, const Lattice& lattice, PackedArrays* arrays) {
  Lines lines;
  if (at_rest(e)) {
    for (const MeridianEvaluation& m : e.meridians) {
      lines.add("thrust", m.thrust);
      for (const ThrustLine& wythe : m.wythes) lines.add("wythe", wythe);
      if (m.least_thrust) lines.add("least", *m.least_thrust);
      if (m.greatest_thrust) lines.add("greatest", *m.greatest_thrust);
    }
    const Mesh cracks = cracks_mesh(e);
    for (int cell = 0; cell < cracks.num_cells(); ++cell) {
      std::vector<Vec3> outline;
      for (int i = cracks.cell_start[cell]; i < cracks.cell_start[cell + 1]; ++i)
        outline.emplace_back(&cracks.points[3 * static_cast<size_t>(cracks.cell_points[i])]);
      lines.add("crack", outline);
    }
  }
  arrays->add_points("lines", lines.points, lattice);
  return lines.list;
}

nlohmann::json add_ties(const Evaluation& e, const Lattice& lattice, PackedArrays* arrays) {
  const TieTable& ties = e.last.frame.ties;
  if (!at_rest(e) || ties.size() == 0) return nullptr;
  std::vector<Vec3> ends;
  std::vector<double> tensions;
  for (int i = 0; i < ties.size(); ++i) {
    const double tension = ties.strut[i] != 0 ? -ties.force[i] : ties.force[i];
    const size_t n = ends.size();  // a rod is a tie and a strut between the same points
    if (n > 0 && ends[n - 2] == ties.point_a[i] && ends[n - 1] == ties.point_b[i]) {
      tensions.back() += tension;
      continue;
    }
    ends.insert(ends.end(), {ties.point_a[i], ties.point_b[i]});
    tensions.push_back(tension);
  }
  arrays->add_points("ties", ends, lattice);
  arrays->add("tie.force", tensions);
  return e.chains.empty() ? "Ties" : "Chains";
}

}  // namespace cupola

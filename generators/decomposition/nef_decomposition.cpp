#include <CGAL/Exact_predicates_exact_constructions_kernel.h>
#include <CGAL/Nef_polyhedron_3.h>
#include <CGAL/Polyhedron_3.h>
#include <CGAL/boost/graph/convert_nef_polyhedron_to_polygon_mesh.h>
#include <CGAL/convex_decomposition_3.h>

#include "generators/decomposition/decompose.hpp"

namespace cupola {
namespace {

using ExactKernel = CGAL::Exact_predicates_exact_constructions_kernel;
using Polyhedron = CGAL::Polyhedron_3<ExactKernel>;
using Nef = CGAL::Nef_polyhedron_3<ExactKernel>;

template <class HalfedgeStructure>
class MeshBuilder : public CGAL::Modifier_base<HalfedgeStructure> {
 public:
  explicit MeshBuilder(const TriangleMesh& mesh) : mesh_(mesh) {}
  void operator()(HalfedgeStructure& structure) override {
    CGAL::Polyhedron_incremental_builder_3<HalfedgeStructure> builder(structure, false);
    builder.begin_surface(mesh_.vertices.size(), mesh_.triangles.size());
    for (const Vec3& v : mesh_.vertices) builder.add_vertex({v.x(), v.y(), v.z()});
    for (const auto& t : mesh_.triangles) builder.add_facet(t.begin(), t.end());
    builder.end_surface();
  }

 private:
  const TriangleMesh& mesh_;
};

/// One volume of the decomposition, whose facets already join the coplanar triangles.
ConvexPolyhedron to_convex(const Polyhedron& polyhedron) {
  TriangleMesh mesh;
  std::map<Polyhedron::Vertex_const_handle, int> id;
  for (auto v = polyhedron.vertices_begin(); v != polyhedron.vertices_end(); ++v) {
    id[v] = static_cast<int>(mesh.vertices.size());
    mesh.vertices.emplace_back(CGAL::to_double(v->point().x()), CGAL::to_double(v->point().y()),
                               CGAL::to_double(v->point().z()));
  }
  ConvexPolyhedron solid;
  solid.vertices = mesh.vertices;
  for (auto f = polyhedron.facets_begin(); f != polyhedron.facets_end(); ++f) {
    std::vector<int> loop;
    std::vector<Vec3> corners;
    auto h = f->facet_begin();
    do {
      loop.push_back(id.at(h->vertex()));
      corners.push_back(solid.vertices[loop.back()]);
    } while (++h != f->facet_begin());
    solid.faces.push_back(loop);
    solid.planes.push_back(polygon_plane(corners));
  }
  return solid;
}

}  // namespace

std::vector<ConvexPolyhedron> decompose_by_nef(const TriangleMesh& mesh) try {
  Polyhedron polyhedron;
  MeshBuilder<Polyhedron::HalfedgeDS> builder(mesh);
  polyhedron.delegate(builder);
  Nef nef(polyhedron);
  CGAL::convex_decomposition_3(nef);
  std::vector<ConvexPolyhedron> parts;
  auto volume = ++nef.volumes_begin();  // the first volume is the outside
  for (; volume != nef.volumes_end(); ++volume) {
    if (!volume->mark()) continue;
    Polyhedron part;
    nef.convert_inner_shell_to_polyhedron(volume->shells_begin(), part);
    parts.push_back(to_convex(part));
  }
  return parts;
} catch (const CGAL::Failure_exception&) {
  return {};
}

}  // namespace cupola

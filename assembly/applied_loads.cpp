#include "assembly/applied_loads.hpp"

#include <fmt/format.h>

#include "assembly/error.hpp"

namespace cupola {
namespace {

/// Spreads a weight over the top faces by area, as forces along `down` (unit) at the face centroids.
void add_top_load(const Assembly& assembly, double weight, const Vec3& down, const char* key,
                  std::vector<PointForce>* forces) {
  struct TopFace {
    int block;
    Vec3 centroid;
    double area;
  };
  std::vector<TopFace> faces;
  double total_area = 0.0;
  for (const Part& part : assembly.parts) {
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f) {
      if (assembly.face_kinds[f] != FaceKind::top) continue;
      const std::vector<Vec3> polygon = face_points(assembly, f);
      faces.push_back({part.block, polygon_centroid(polygon), polygon_area(polygon)});
      total_area += faces.back().area;
    }
  }
  if (faces.empty())
    throw InputError(fmt::format("loads.{}: the assembly has no top faces to carry it", key));
  for (const TopFace& face : faces)
    forces->push_back({face.block, face.centroid, weight * face.area / total_area * down});
}

}  // namespace

std::vector<PointForce> applied_loads(const Loads& loads, const Assembly& assembly) {
  std::vector<PointForce> forces;
  const double g = loads.gravity.norm();
  const double weight = free_weight(assembly, g);
  const Vec3 down = g > 0.0 ? Vec3(loads.gravity / g) : Vec3(-Vec3::UnitZ());
  const auto add = [&](const std::optional<TopLoad>& load, const char* key) {
    if (load && load->weight_fraction > 0.0)
      add_top_load(assembly, load->weight_fraction * weight, down, key, &forces);
  };
  add(loads.lantern, "lantern");
  add(loads.top_load, "top_load");
  return forces;
}

}  // namespace cupola

#include "assembly/model/applied_loads.hpp"

#include <cmath>

#include <fmt/format.h>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

struct LoadedFace {
  int block;
  Vec3 centroid;
  Vec3 normal;  // outward
  double area;
};

bool is_of_member(const Assembly& assembly, const Block& block, const std::string& member) {
  return member.empty() || (!assembly.members.empty() && assembly.members[block.member] == member);
}

/// Faces of one kind on the free blocks of a member, for parts in a range of rings.
std::vector<LoadedFace> faces_of_kind(const Assembly& assembly, FaceKind kind, int from_ring, int to_ring,
                                      const std::string& member) {
  std::vector<LoadedFace> faces;
  for (const Part& part : assembly.parts) {
    const Block& block = assembly.blocks[part.block];
    if (part.ring < from_ring || part.ring > to_ring || block.fixed || !is_of_member(assembly, block, member))
      continue;
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f) {
      if (assembly.face_kinds[f] != kind) continue;
      const std::vector<Vec3> polygon = face_points(assembly, f);
      faces.push_back(
          {part.block, polygon_centroid(polygon), polygon_plane(polygon).normal, polygon_area(polygon)});
    }
  }
  return faces;
}

/// Distributes a weight over the top faces by area, as forces along the unit vector `down` at the face
/// centroids.
void add_top_load(const Assembly& assembly, double weight, const Vec3& down, const char* key,
                  std::vector<PointForce>* forces) {
  CUPOLA_ASSERT(std::abs(down.norm() - 1.0) < 1e-9);
  const std::vector<LoadedFace> faces = faces_of_kind(assembly, FaceKind::top, 0, kLastRing, "");
  if (faces.empty())
    throw InputError(fmt::format("loads.{}: the assembly has no faces of kind top to carry it", key));
  double total_area = 0.0;
  for (const LoadedFace& face : faces) total_area += face.area;
  for (const LoadedFace& face : faces)
    forces->push_back({face.block, face.centroid, weight * face.area / total_area * down});
}

PointForce block_force(const BlockForce& load, const Assembly& assembly, int time) {
  const int num_blocks = static_cast<int>(assembly.blocks.size());
  if (load.block >= num_blocks)
    throw InputError(
        fmt::format("loads.forces: block {}: the assembly has blocks 0 to {}", load.block, num_blocks - 1));
  const Block& block = assembly.blocks[load.block];
  if (block.fixed)
    throw InputError(
        fmt::format("loads.forces: block {} is fixed; apply the force to a free block", load.block));
  return {load.block, load.point.value_or(block.centroid), load.force, time};
}

void add_face_load(const FaceLoad& load, const Assembly& assembly, int time,
                   std::vector<PointForce>* forces) {
  const std::vector<LoadedFace> faces =
      faces_of_kind(assembly, load.faces, load.from_ring, load.to_ring, load.member);
  if (faces.empty())
    throw InputError(fmt::format("loads.faces: no free block{} in rings {} to {} has faces of kind {}",
                                 load.member.empty() ? "" : " of " + load.member, load.from_ring,
                                 load.to_ring, to_string(load.faces)));
  for (const LoadedFace& face : faces)
    forces->push_back(
        {face.block, face.centroid, face.area * (load.traction - load.pressure * face.normal), time});
}

}  // namespace

std::vector<PointForce> applied_loads(const Loads& loads, const Assembly& assembly) {
  std::vector<PointForce> forces;
  const double g = loads.gravity.norm();
  const double weight = free_weight(assembly, g);
  const Vec3 down = g > 0.0 ? Vec3(loads.gravity / g) : Vec3(-Vec3::UnitZ());
  const auto add_top = [&](const std::optional<TopLoad>& load, const char* key) {
    if (load && load->weight_fraction != 0.0)  // negative in the derivative of a limit analysis
      add_top_load(assembly, load->weight_fraction * weight, down, key, &forces);
  };
  add_top(loads.lantern, "lantern");
  add_top(loads.top_load, "top_load");
  int time = 0;
  for (const BlockForce& load : loads.forces) forces.push_back(block_force(load, assembly, time++));
  for (const FaceLoad& load : loads.faces) add_face_load(load, assembly, time++, &forces);
  return forces;
}

std::vector<TimeFunction> load_times(const Loads& loads) {
  std::vector<TimeFunction> times;
  for (const BlockForce& load : loads.forces) times.push_back(load.time);
  for (const FaceLoad& load : loads.faces) times.push_back(load.time);
  return times;
}

}  // namespace cupola

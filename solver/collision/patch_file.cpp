#include "solver/collision/patch_file.hpp"

#include "assembly/base/process.hpp"
#include "assembly/files/mesh_file.hpp"

namespace cupola {

void write_patches(const std::string& path, const ContactSet& contacts, const std::string& assembly_hash) {
  Mesh mesh;
  std::vector<std::int32_t> block_a, block_b, ring;
  std::vector<std::uint8_t> kind;
  std::vector<double> area, centroid;
  for (const Patch& patch : contacts.patches) {
    if (patch.polygon.size() < 3) continue;
    std::vector<int> ids;
    for (const Vec3& x : patch.polygon) ids.push_back(mesh.add_point(x.x(), x.y(), x.z()));
    mesh.add_cell(Mesh::CellType::polygon, ids);
    const Vec3 center = polygon_centroid(patch.polygon);
    block_a.push_back(patch.block_a);
    block_b.push_back(patch.block_b);
    kind.push_back(static_cast<std::uint8_t>(patch.kind));
    ring.push_back(patch.ring);
    area.push_back(patch.area);
    centroid.insert(centroid.end(), center.begin(), center.end());
  }
  mesh.cell_data = {{"block_a", 1, block_a}, {"block_b", 1, block_b}, {"kind", 1, kind},
                    {"ring", 1, ring},       {"area_m2", 1, area},    {"centroid", 3, centroid}};
  mesh.field_data = {{"program_version", 1, std::vector<std::string>{program_version()}},
                     {"assembly_hash", 1, std::vector<std::string>{assembly_hash}}};
  write_mesh(path, mesh);
}

}  // namespace cupola

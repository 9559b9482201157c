#include <cstdint>
#include <cstring>

#include <nlohmann/json.hpp>

#include "assembly/base/process.hpp"
#include "assembly/export/arrows.hpp"
#include "assembly/export/formats.hpp"
#include "assembly/files/base64.hpp"
#include "assembly/model/block_names.hpp"

namespace cupola {
namespace {

using Json = nlohmann::ordered_json;

/// Turns z up into y up.
const Eigen::Quaterniond kToYUp(Eigen::AngleAxisd(-EIGEN_PI / 2, Vec3::UnitX()));

/// The file while it is being built. All positions lie in one view of the buffer, all indices in another.
struct Gltf {
  std::vector<float> positions;
  std::vector<std::uint32_t> indices;
  Json nodes = Json::array(), meshes = Json::array(), accessors = Json::array();

  /// Adds a mesh of triangles around the origin and returns its number.
  size_t add_mesh(const std::string& name, const std::vector<Vec3>& points,
                  const std::vector<std::uint32_t>& triangles, int material) {
    const Eigen::Matrix3Xf turned = [&] {
      Eigen::Matrix3Xf columns(3, static_cast<Eigen::Index>(points.size()));
      for (size_t i = 0; i < points.size(); ++i)
        columns.col(static_cast<Eigen::Index>(i)) = (kToYUp * points[i]).cast<float>();
      return columns;
    }();
    const Eigen::Vector3f low = turned.rowwise().minCoeff(), high = turned.rowwise().maxCoeff();
    accessors.push_back({{"bufferView", 0},
                         {"byteOffset", positions.size() * sizeof(float)},
                         {"componentType", 5126},  // float
                         {"count", points.size()},
                         {"type", "VEC3"},
                         {"min", {low.x(), low.y(), low.z()}},
                         {"max", {high.x(), high.y(), high.z()}}});
    accessors.push_back({{"bufferView", 1},
                         {"byteOffset", indices.size() * sizeof(std::uint32_t)},
                         {"componentType", 5125},  // unsigned integer of 32 bits
                         {"count", triangles.size()},
                         {"type", "SCALAR"}});
    positions.insert(positions.end(), turned.data(), turned.data() + turned.size());
    indices.insert(indices.end(), triangles.begin(), triangles.end());
    Json primitive{{"attributes", {{"POSITION", accessors.size() - 2}}},
                   {"indices", accessors.size() - 1},
                   {"material", material}};
    meshes.push_back({{"name", name}, {"primitives", Json::array({std::move(primitive)})}});
    return meshes.size() - 1;
  }
};

enum Material { laid_flat, across_corner, upright, support, imported, force };

/// Base colours in linear light, by Material.
Json materials() {
  const std::array<std::pair<const char*, std::array<double, 3>>, 6> kColours{
      {{"laid flat", {0.85, 0.76, 0.62}},
       {"across a corner", {0.80, 0.52, 0.36}},
       {"upright", {0.25, 0.45, 0.65}},
       {"support", {0.55, 0.55, 0.55}},
       {"imported", {0.80, 0.74, 0.62}},
       {"force", {0.75, 0.05, 0.02}}}};
  Json list = Json::array();
  for (const auto& [name, c] : kColours)
    list.push_back({{"name", name},
                    {"pbrMetallicRoughness",
                     {{"baseColorFactor", {c[0], c[1], c[2], 1.0}},
                      {"metallicFactor", 0.0},
                      {"roughnessFactor", 0.9}}}});
  return list;
}

Material material_of(const Block& block) {
  if (block.fixed) return support;
  if (block.kind == BlockKind::herringbone) return upright;
  if (block.kind == BlockKind::imported) return imported;
  return block.rib ? across_corner : laid_flat;
}

/// Fans of triangles.
std::vector<std::uint32_t> triangles_of(const BlockSurface& surface) {
  std::vector<std::uint32_t> triangles;
  for (const std::vector<int>& face : surface.faces)
    for (size_t i = 2; i < face.size(); ++i)
      for (const int v : {face[0], face[i - 1], face[i]}) triangles.push_back(static_cast<std::uint32_t>(v));
  return triangles;
}

size_t add_block(const ExportModel& model, int b, const BlockSurface& surface, Gltf* file) {
  const Block& block = model.assembly.blocks[b];
  const Vec3 origin = model.placed(b, block.centroid);
  std::vector<Vec3> points;
  points.reserve(surface.vertices.size());
  for (const Vec3& p : surface.vertices) points.push_back(p - origin);
  const std::string label = block_label(model.assembly, b);
  const size_t mesh = file->add_mesh(label, points, triangles_of(surface), material_of(block));
  const Vec3 t = kToYUp * origin;
  file->nodes.push_back({{"name", label},
                         {"mesh", mesh},
                         {"translation", {t.x(), t.y(), t.z()}},
                         {"extras",
                          {{"block", b},
                           {"kind", to_string(block.kind)},
                           {"course", block.ring},
                           {"fixed", block.fixed},
                           {"mass_kg", block.mass}}}});
  return file->nodes.size() - 1;
}

void add_forces(const ExportModel& model, Gltf* file) {
  double longest = 0.0;
  for (const ExportedJoint& joint : model.joints)
    longest = std::max(longest, model.force_scale * joint.force.norm());
  BlockSurface arrows;
  for (const ExportedJoint& joint : model.joints)
    add_arrow(joint.centre, model.force_scale * joint.force, kArrowThickness * longest, &arrows);
  if (arrows.faces.empty()) return;
  const size_t mesh = file->add_mesh("forces", arrows.vertices, triangles_of(arrows), force);
  file->nodes.push_back(
      {{"name", "forces"}, {"mesh", mesh}, {"extras", {{"scale_m_per_N", model.force_scale}}}});
}

template <class T>
void append_bytes(const std::vector<T>& values, std::string* bytes) {
  const size_t start = bytes->size();
  bytes->resize(start + values.size() * sizeof(T));
  if (!values.empty()) std::memcpy(bytes->data() + start, values.data(), values.size() * sizeof(T));
}

}  // namespace

std::string gltf_text(const ExportModel& model) {
  Gltf file;
  const std::vector<BlockSurface> surfaces = block_surfaces(model);
  Json blocks = Json::array();
  for (size_t b = 0; b < surfaces.size(); ++b)
    blocks.push_back(add_block(model, static_cast<int>(b), surfaces[b], &file));
  Json roots = Json::array();
  file.nodes.push_back({{"name", "blocks"}, {"children", blocks}});
  roots.push_back(file.nodes.size() - 1);
  add_forces(model, &file);
  if (file.nodes.back()["name"] == "forces") roots.push_back(file.nodes.size() - 1);

  std::string bytes;
  append_bytes(file.positions, &bytes);
  const size_t split = bytes.size();
  append_bytes(file.indices, &bytes);
  const Json scene{{"name", model.assembly.title}, {"nodes", roots}};
  const Json position_view{{"buffer", 0}, {"byteOffset", 0}, {"byteLength", split}, {"target", 34962}};
  const Json index_view{
      {"buffer", 0}, {"byteOffset", split}, {"byteLength", bytes.size() - split}, {"target", 34963}};
  const Json buffer{{"byteLength", bytes.size()},
                    {"uri", "data:application/octet-stream;base64," + base64(bytes)}};
  const Json root{{"asset", {{"version", "2.0"}, {"generator", "Cupola " + program_version()}}},
                  {"scene", 0},
                  {"scenes", Json::array({scene})},
                  {"nodes", file.nodes},
                  {"meshes", file.meshes},
                  {"materials", materials()},
                  {"accessors", file.accessors},
                  {"bufferViews", Json::array({position_view, index_view})},
                  {"buffers", Json::array({buffer})}};
  return root.dump() + "\n";
}

}  // namespace cupola

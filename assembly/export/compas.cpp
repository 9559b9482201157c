#include <optional>

#include <nlohmann/json.hpp>

#include "assembly/export/formats.hpp"
#include "assembly/model/block_names.hpp"

namespace cupola {
namespace {

using Json = nlohmann::ordered_json;

Json coordinates(const Vec3& p) {
  return {p.x(), p.y(), p.z()};
}

Json block_node(const ExportModel& model, int b, const BlockSurface& surface) {
  const Block& block = model.assembly.blocks[b];
  Json vertices = Json::object(), faces = Json::object();
  for (size_t v = 0; v < surface.vertices.size(); ++v) {
    const Vec3& p = surface.vertices[v];
    vertices[std::to_string(v)] = {{"x", p.x()}, {"y", p.y()}, {"z", p.z()}};
  }
  for (size_t f = 0; f < surface.faces.size(); ++f) faces[std::to_string(f)] = surface.faces[f];
  const std::string label = block_label(model.assembly, b);
  Json data{{"attributes", {{"name", label}}},
            {"default_vertex_attributes", {{"x", 0.0}, {"y", 0.0}, {"z", 0.0}}},
            {"default_edge_attributes", Json::object()},
            {"default_face_attributes", Json::object()},
            {"vertex", std::move(vertices)},
            {"face", std::move(faces)},
            {"facedata", Json::object()},
            {"edgedata", Json::object()},
            {"max_vertex", static_cast<int>(surface.vertices.size()) - 1},
            {"max_face", static_cast<int>(surface.faces.size()) - 1}};
  Json node{{"block", {{"dtype", "compas_assembly.datastructures/Block"}, {"data", std::move(data)}}},
            {"is_support", block.fixed},
            {"name", label},
            {"density", block.density}};
  if (model.assembly.num_rings > 0 && !block.fixed) node["course"] = block.ring;
  return node;
}

/// The force of the contact point at a corner; none if no point lies there.
std::optional<Vec3> force_at(const ExportedJoint& joint, const Vec3& corner) {
  constexpr double kSamePoint = 1e-9;  // m, beyond the rounding of coordinates in a model of a kilometre
  for (size_t i = 0; i < joint.points.size(); ++i)
    if ((joint.points[i] - corner).norm() <= kSamePoint) return joint.forces[i];
  return std::nullopt;
}

/// Forces on block_b at the corners, in the axes of the frame, as compas_cra writes them; null if contact
/// points lie elsewhere.
Json corner_forces(const ExportedJoint& joint, const Vec3& x_axis, const Vec3& y_axis) {
  if (joint.points.size() != joint.outline.size()) return nullptr;
  Json forces = Json::array();
  for (const Vec3& corner : joint.outline) {
    const std::optional<Vec3> force = force_at(joint, corner);
    if (!force) return nullptr;
    const double normal = force->dot(joint.normal);
    forces.push_back({{"c_np", std::max(normal, 0.0)},
                      {"c_nn", std::max(-normal, 0.0)},
                      {"c_u", force->dot(x_axis)},
                      {"c_v", force->dot(y_axis)}});
  }
  return forces;
}

Json joint_interface(const ExportedJoint& joint) {
  const Vec3 x_axis = (joint.outline[1] - joint.outline[0]).normalized();
  const Vec3 y_axis = joint.normal.cross(x_axis);
  Json points = Json::array();
  for (const Vec3& p : joint.outline) points.push_back(coordinates(p));
  Json frame{{"dtype", "compas.geometry/Frame"},
             {"data",
              {{"point", coordinates(joint.outline[0])},
               {"xaxis", coordinates(x_axis)},
               {"yaxis", coordinates(y_axis)}}}};
  Json data{{"points", std::move(points)},
            {"type", "face_face"},
            {"size", joint.area},
            {"frame", std::move(frame)},
            {"forces", corner_forces(joint, x_axis, y_axis)},
            {"mesh", nullptr}};
  return {{"dtype", "compas_assembly.datastructures/Interface"}, {"data", std::move(data)}};
}

/// The edges of the graph. Joints without an area, along a line or at a point, have no interface.
Json joint_edges(const ExportModel& model) {
  Json edges = Json::object();
  for (const ExportedJoint& joint : model.joints) {
    Json& edge = edges[std::to_string(joint.block_a)][std::to_string(joint.block_b)];
    if (edge.is_null()) edge = {{"interfaces", Json::array()}, {"resultants", Json::array()}};
    if (joint.outline.size() >= 3) edge["interfaces"].push_back(joint_interface(joint));
    edge["resultants"].push_back({{"kind", to_string(joint.kind)},
                                  {"point", coordinates(joint.centre)},
                                  {"force", coordinates(joint.force)}});
  }
  return edges;
}

}  // namespace

std::string compas_text(const ExportModel& model) {
  const std::vector<BlockSurface> surfaces = block_surfaces(model);
  Json nodes = Json::object(), adjacency = Json::object();
  for (size_t b = 0; b < surfaces.size(); ++b) {
    nodes[std::to_string(b)] = block_node(model, static_cast<int>(b), surfaces[b]);
    adjacency[std::to_string(b)] = Json::object();
  }
  for (const ExportedJoint& joint : model.joints) {
    const std::string a = std::to_string(joint.block_a), b = std::to_string(joint.block_b);
    adjacency[a][b] = nullptr;
    adjacency[b][a] = nullptr;
  }
  Json graph{{"attributes", {{"name", "Graph"}}},
             {"default_node_attributes", {{"block", nullptr}, {"is_support", false}}},
             {"default_edge_attributes", {{"interfaces", nullptr}}},
             {"node", std::move(nodes)},
             {"edge", joint_edges(model)},
             {"adjacency", std::move(adjacency)},
             {"max_node", static_cast<int>(surfaces.size()) - 1}};
  const std::string title = model.assembly.title.empty() ? "Assembly" : model.assembly.title;
  return Json{{"dtype", "compas_assembly.datastructures/Assembly"},
              {"data",
               {{"attributes", {{"name", title}}},
                {"graph", {{"dtype", "compas.datastructures/Graph"}, {"data", std::move(graph)}}}}}}
             .dump() +
         "\n";
}

}  // namespace cupola

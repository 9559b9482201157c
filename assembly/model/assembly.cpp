#include "assembly/model/assembly.hpp"

#include <algorithm>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

/// Volume, first and second moments of one solid, relative to a fixed point.
struct Moments {
  double volume = 0.0;
  Vec3 first = Vec3::Zero();
  Mat3 second = Mat3::Zero();  // integral of x x^T

  /// Adds the tetrahedron (0, a, b, c), signed by its orientation.
  void add(const Vec3& a, const Vec3& b, const Vec3& c) {
    const double v = a.dot(b.cross(c)) / 6.0;
    const Vec3 sum = a + b + c;
    volume += v;
    first += v / 4.0 * sum;
    second += v / 20.0 * (sum * sum.transpose() + a * a.transpose() + b * b.transpose() + c * c.transpose());
  }

  SolidProperties about_centroid(const Vec3& origin) const {
    SolidProperties solid;
    solid.volume = volume;
    if (volume == 0.0) return solid;
    const Vec3 offset = first / volume;
    solid.centroid = origin + offset;
    const Mat3 covariance = second - volume * offset * offset.transpose();
    solid.inertia = covariance.trace() * Mat3::Identity() - covariance;
    return solid;
  }
};

void add_part(const Assembly& assembly, const Part& part, const Vec3& origin, Moments* moments) {
  for (int f = part.face_start; f < part.face_start + part.num_faces; ++f) {
    const auto ids = assembly.face(f);
    const Vec3 a = assembly.vertices[ids[0]] - origin;
    for (size_t i = 2; i < ids.size(); ++i)
      moments->add(a, assembly.vertices[ids[i - 1]] - origin, assembly.vertices[ids[i]] - origin);
  }
}

const Vec3& first_vertex(const Assembly& assembly, const Part& part) {
  return assembly.vertices[assembly.face(part.face_start)[0]];
}

}  // namespace

const Sheet* Assembly::sheet_of(int ring) const {
  const auto found = std::ranges::find_if(sheets, [&](const Sheet& sheet) { return sheet.has_ring(ring); });
  return found == sheets.end() ? nullptr : &*found;
}

Sheet Assembly::axis_of(int ring) const {
  const Sheet* sheet = num_rings == 0 && !sheets.empty() ? &sheets.front() : sheet_of(ring);
  return sheet ? *sheet : Sheet{};
}

std::pair<int, int> Assembly::stack_of(int ring) const {
  std::pair<int, int> stack{0, num_rings};
  for (const Sheet& sheet : sheets) {
    if (sheet.on_previous) continue;
    if (sheet.first_ring > ring) {
      stack.second = sheet.first_ring;
      break;
    }
    stack.first = sheet.first_ring;
  }
  return stack;
}

const Sheet* Assembly::vault_of(int ring) const {
  const auto has_outward = [](const Sheet& sheet) { return sheet.thrust_lines != Sheet::ThrustLines::none; };
  const auto own = std::ranges::find_if(sheets, [&](const Sheet& sheet) { return sheet.has_ring(ring); });
  if (own != sheets.end() && own->vault >= 0) return &sheets[own->vault];
  const auto next = std::find_if(own, sheets.end(), has_outward);
  if (next != sheets.end()) return &*next;
  const auto before = std::find_if(std::make_reverse_iterator(own), sheets.rend(), has_outward);
  return before == sheets.rend() ? nullptr : &*before;
}

Vec3 Assembly::outward(int ring, const Vec3& point) const {
  const Sheet* vault = vault_of(ring);
  return vault ? vault->outward(point).value() : Vec3::Constant(std::numeric_limits<double>::quiet_NaN());
}

void Assembly::add_face(std::span<const int> vertex_ids, FaceKind kind) {
  CUPOLA_ASSERT(!parts.empty() && vertex_ids.size() >= 3);
  if (face_vertex_start.empty()) face_vertex_start.push_back(0);
  face_vertices.insert(face_vertices.end(), vertex_ids.begin(), vertex_ids.end());
  face_vertex_start.push_back(static_cast<int>(face_vertices.size()));
  face_kinds.push_back(kind);
  ++parts.back().num_faces;
}

Plane polygon_plane(std::span<const Vec3> polygon) {
  // Coordinates relative to the first vertex keep the normal accurate far from the origin.
  CUPOLA_ASSERT(polygon.size() >= 3);
  const Vec3& origin = polygon[0];
  Vec3 normal = Vec3::Zero();
  Vec3 mean = Vec3::Zero();
  for (size_t i = 0; i < polygon.size(); ++i) {
    const Vec3 a = polygon[i] - origin;
    normal += a.cross(polygon[(i + 1) % polygon.size()] - origin);
    mean += a;
  }
  mean /= static_cast<double>(polygon.size());
  normal.normalize();
  return {normal, normal.dot(origin) + normal.dot(mean)};
}

double polygon_area(std::span<const Vec3> polygon) {
  Vec3 twice = Vec3::Zero();
  for (size_t i = 2; i < polygon.size(); ++i)
    twice += (polygon[i - 1] - polygon[0]).cross(polygon[i] - polygon[0]);
  return 0.5 * twice.norm();
}

Vec3 polygon_centroid(std::span<const Vec3> polygon) {
  Vec3 normal = Vec3::Zero();
  for (size_t i = 2; i < polygon.size(); ++i)
    normal += (polygon[i - 1] - polygon[0]).cross(polygon[i] - polygon[0]);
  const double twice_area = normal.norm();
  Vec3 offset = Vec3::Zero();
  if (twice_area == 0.0) return polygon[0];
  normal /= twice_area;
  for (size_t i = 2; i < polygon.size(); ++i) {
    const Vec3 a = polygon[i - 1] - polygon[0];
    const Vec3 b = polygon[i] - polygon[0];
    offset += normal.dot(a.cross(b)) / (3.0 * twice_area) * (a + b);
  }
  return polygon[0] + offset;
}

std::vector<Vec3> face_points(const Assembly& assembly, int face) {
  std::vector<Vec3> points;
  for (int v : assembly.face(face)) points.push_back(assembly.vertices[v]);
  return points;
}

SolidProperties solid_properties(const Assembly& assembly, const Part& part) {
  CUPOLA_ASSERT(part.num_faces >= 4 && part.face_start + part.num_faces <= assembly.num_faces());
  Moments moments;
  const Vec3 origin = first_vertex(assembly, part);
  add_part(assembly, part, origin, &moments);
  return moments.about_centroid(origin);
}

void compute_mass_properties(Assembly* assembly) {
  std::vector<Moments> moments(assembly->blocks.size());
  std::vector<const Part*> first_part(assembly->blocks.size(), nullptr);
  for (Part& part : assembly->parts) {
    if (!first_part[part.block]) first_part[part.block] = &part;
    part.volume = solid_properties(*assembly, part).volume;
    add_part(*assembly, part, first_vertex(*assembly, *first_part[part.block]), &moments[part.block]);
  }
  for (size_t b = 0; b < assembly->blocks.size(); ++b) {
    Block& block = assembly->blocks[b];
    if (!first_part[b]) throw InputError(fmt::format("block {}: has no parts", b));
    const SolidProperties solid = moments[b].about_centroid(first_vertex(*assembly, *first_part[b]));
    if (!(solid.volume > 0.0))
      throw InputError(fmt::format(
          "block {}: volume {} m3, must be > 0; the block is degenerate or its faces point inwards", b,
          solid.volume));
    block.volume = solid.volume;
    block.centroid = solid.centroid;
    block.mass = block.density * solid.volume;
    block.inertia = block.density * solid.inertia;
    CUPOLA_ASSERT(block.centroid.allFinite() && block.inertia.allFinite());
  }
}

double free_weight(const Assembly& assembly, double gravity) {
  double mass = 0.0;
  for (const Block& block : assembly.blocks)
    if (!block.fixed) mass += block.mass;
  return mass * gravity;
}

}  // namespace cupola

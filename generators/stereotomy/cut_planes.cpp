#include "generators/stereotomy/cut_planes.hpp"

#include <cmath>
#include <numbers>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "assembly/base/error.hpp"

namespace cupola {
namespace {

/// The point with the coordinates u and v across an axis.
Vec3 on_axis(Cut::Axis axis, double u, double v, double along) {
  switch (axis) {
    case Cut::Axis::x:
      return {along, u, v};
    case Cut::Axis::y:
      return {u, along, v};
    case Cut::Axis::z:
      break;
  }
  return {u, v, along};
}

std::vector<Eigen::Vector2d> outline_of(const Cut& cut) {
  std::vector<Eigen::Vector2d> corners;
  if (cut.kind == Cut::Kind::prism)
    for (size_t i = 0; i < cut.u.size(); ++i) corners.emplace_back(cut.u[i], cut.v[i]);
  else
    for (int i = 0; i < cut.sides; ++i) {
      const double angle = 2.0 * std::numbers::pi * (i + 0.5) / cut.sides;
      corners.emplace_back(cut.centre_u + cut.radius * std::cos(angle),
                           cut.centre_v + cut.radius * std::sin(angle));
    }
  return corners;
}

}  // namespace

std::vector<Plane> body_of(const Cut& cut) {
  if (cut.kind == Cut::Kind::plane) {
    const Vec3 lost = cut.normal.normalized();
    return {{-lost, -lost.dot(cut.point)}};
  }
  std::vector<Plane> planes;
  const std::vector<Eigen::Vector2d> corners = outline_of(cut);
  Eigen::Vector2d middle = Eigen::Vector2d::Zero();
  for (const Eigen::Vector2d& corner : corners) middle += corner / static_cast<double>(corners.size());
  for (size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d &a = corners[i], &b = corners[(i + 1) % corners.size()],
                          along = (b - a).normalized();
    Eigen::Vector2d normal(along.y(), -along.x());
    if (normal.dot(middle - a) > 0.0) normal = -normal;
    planes.push_back({on_axis(cut.axis, normal.x(), normal.y(), 0.0), normal.dot(a)});
  }
  const Vec3 axis = on_axis(cut.axis, 0.0, 0.0, 1.0);
  if (cut.from) planes.push_back({-axis, -*cut.from});
  if (cut.to) planes.push_back({axis, *cut.to});
  return planes;
}

std::vector<Plane> body_under(const Storey& barrel, Cut::Face face, const std::string& key) {
  const SurfaceMap& surface = barrel.surface;
  std::vector<Vec3> inner, outer;  // at the first end
  for (int bed = 0; bed <= surface.num_rows; ++bed) {
    inner.push_back(surface.intrados(bed, 0.0));
    outer.push_back(surface.extrados(bed, 0.0));
  }
  const std::vector<Vec3> section = face == Cut::Face::extrados ? outer : inner;
  const Vec3 end = surface.intrados(0.0, surface.extent) - inner.front(), along = end.normalized();
  const Vec3 span = section.front() - section.back(), across = along.cross(Vec3::UnitZ()).normalized();
  const double rounding = 1e-12 * span.norm(), way = across.dot(span) > 0.0 ? 1.0 : -1.0;
  const auto refuse = [&](const std::string& why) {
    throw InputError(fmt::format("{}.member = {}: {}", key, barrel.name, why));
  };
  if (std::abs(across.dot(span)) <= rounding) refuse("spans nothing, so that nothing lies under it");
  std::vector<Plane> planes;
  const auto add = [&](const Vec3& point, const Vec3& outward) {
    planes.push_back({outward, outward.dot(point)});
  };
  add(section.front(), way * across);
  add(section.back(), -way * across);
  const Vec3 inside = 0.5 * (section.front() + section.back()) - span.norm() * Vec3::UnitZ();
  for (size_t i = 0; i + 1 < section.size(); ++i) {
    Vec3 outward = along.cross(section[i + 1] - section[i]).normalized();
    if (outward.dot(inside - section[i]) > 0.0) outward = -outward;
    add(section[i], outward);
  }
  for (size_t i = 0; i < planes.size(); ++i)
    for (const Vec3& p : section) {
      if (planes[i].normal.dot(p) - planes[i].offset <= rounding) continue;
      const Vec3& at = i < 2 ? p : section[i - 2];
      refuse(fmt::format(
          "its section {} ({:.4g}, {:.4g}, {:.4g}) m, in its own coordinates, so that what lies "
          "under it is no convex body",
          i < 2 ? "reaches beyond its springings at" : "is not convex about", at.x(), at.y(), at.z()));
    }
  inner.insert(inner.end(), outer.rbegin(), outer.rend());  // a barrel may lean
  Vec3 end_normal = polygon_plane(inner).normal;
  if (end_normal.dot(along) < 0.0) end_normal = -end_normal;
  add(section.front(), -end_normal);
  add(section.front() + end, end_normal);
  return planes;
}

namespace {

/// A plane after an affine map, which keeps orientations.
Plane image_of(const Plane& plane, const Affine& affine) {
  const Vec3 u = plane.normal.unitOrthogonal(), v = plane.normal.cross(u);
  const Vec3 point = plane.offset * plane.normal, image = affine.image(point);
  const Vec3 normal =
      Vec3(affine.image(point + u) - image).cross(affine.image(point + v) - image).normalized();
  return {normal, normal.dot(image)};
}

}  // namespace

std::vector<std::vector<Plane>> bodies_over(const Storey& vault) {
  const SurfaceMap& web = vault.surface;
  std::vector<std::vector<Plane>> of_web;
  const auto add = [&](const Vec3& point, const Vec3& outward) {
    of_web.push_back({{-outward.normalized(), -outward.normalized().dot(point)}});
  };
  for (const int bed : {0, web.num_rows}) {
    const Vec3 edge = web.intrados(bed, 0.0), outward = web.extrados(bed, 0.0) - edge;
    if (web.springers == 0) {
      add(edge, outward);
    } else {
      add(edge, {outward.x(), 0.0, 0.0});
      of_web.back().push_back({Vec3::UnitZ(), edge.z()});
    }
  }
  for (int bed = 0; bed < web.num_rows; ++bed) {
    const Vec3 edge = web.intrados(bed, 0.0);
    Vec3 outward = Vec3::UnitY().cross(web.intrados(bed + 1, 0.0) - edge);
    if (outward.dot(web.extrados(bed, 0.0) - edge) < 0.0) outward = -outward;
    add(edge, outward);
  }
  std::vector<std::vector<Plane>> bodies;
  for (int i = 0; i < web.webs; ++i) {
    const Eigen::Isometry3d turn(Eigen::AngleAxisd(2.0 * std::numbers::pi * i / web.webs, Vec3::UnitZ()));
    for (std::vector<Plane> body : of_web) {
      for (const int side : {0, 1}) body.push_back({groin_cut(web.webs, side).normal, 0.0});
      body = moved(std::move(body), turn);
      if (vault.affine)
        for (Plane& plane : body) plane = image_of(plane, *vault.affine);
      bodies.push_back(std::move(body));
    }
  }
  return bodies;
}

Cut groin_cut(int webs, int side) {
  Cut cut;
  cut.kind = Cut::Kind::plane;
  cut.normal = {(side == 0 ? 1.0 : -1.0) * std::cos(std::numbers::pi / webs),
                -std::sin(std::numbers::pi / webs), 0.0};
  return cut;
}

std::vector<Plane> moved(std::vector<Plane> planes, const Eigen::Isometry3d& placement) {
  for (Plane& plane : planes) {
    const Vec3 point = placement * (plane.offset * plane.normal);
    plane.normal = placement.linear() * plane.normal;
    plane.offset = plane.normal.dot(point);
  }
  return planes;
}

}  // namespace cupola

#pragma once

#include <cmath>
#include <map>
#include <string>
#include <vector>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "generators/decomposition/triangle_mesh.hpp"
#include "generators/importer/mesh_repair.hpp"

namespace cupola {

/// Prism over a polygon in the x-z plane (counter-clockwise seen from -y), from y = 0 to `depth`.
inline RawBlock prism(const std::vector<Eigen::Vector2d>& polygon, double depth,
                      const std::string& name = "prism") {
  RawBlock block{name, {"test", 1, 0}, {}, {}, false, {}};
  const int n = static_cast<int>(polygon.size());
  for (double y : {0.0, depth})
    for (const auto& p : polygon) block.mesh.vertices.emplace_back(p.x(), y, p.y());
  std::vector<int> front, back;
  for (int i = 0; i < n; ++i) {
    front.push_back(i);
    back.push_back(2 * n - 1 - i);
    block.mesh.faces.push_back({i, i + n, (i + 1) % n + n, (i + 1) % n});
  }
  block.mesh.faces.push_back(front);
  block.mesh.faces.push_back(back);
  return block;
}

/// The blocks as objects of an OBJ file.
inline std::string obj_of(const std::vector<RawBlock>& blocks) {
  std::string text;
  size_t first = 1;
  for (const RawBlock& block : blocks) {
    text += "o " + block.name + "\n";
    for (const Vec3& p : block.mesh.vertices) text += fmt::format("v {} {} {}\n", p.x(), p.y(), p.z());
    for (const auto& face : block.mesh.faces) {
      text += "f";
      for (const int v : face) text += fmt::format(" {}", first + static_cast<size_t>(v));
      text += "\n";
    }
    first += block.mesh.vertices.size();
  }
  return text;
}

/// A block rotated by an irrational angle about an irrational axis and translated.
inline RawBlock rotated(RawBlock block) {
  const Eigen::AngleAxisd rotation(std::sqrt(2.0), Vec3(1.0, std::sqrt(3.0), -std::sqrt(5.0)).normalized());
  for (Vec3& v : block.mesh.vertices) v = rotation * v + Vec3(0.1, std::sqrt(7.0), -3.0);
  return block;
}

inline std::vector<Eigen::Vector2d> l_shape() {
  return {{0, 0}, {3, 0}, {3, 1}, {1, 1}, {1, 2.5}, {0, 2.5}};
}
inline std::vector<Eigen::Vector2d> u_shape() {
  return {{0, 0}, {4, 0}, {4, 3}, {3, 3}, {3, 1}, {1, 1}, {1, 3}, {0, 3}};
}
inline std::vector<Eigen::Vector2d> t_shape() {
  return {{1, 0}, {2, 0}, {2, 2}, {3, 2}, {3, 3}, {0, 3}, {0, 2}, {1, 2}};
}
inline std::vector<Eigen::Vector2d> cross_shape() {
  return {{1, 0}, {2, 0}, {2, 1}, {3, 1}, {3, 2}, {2, 2}, {2, 3}, {1, 3}, {1, 2}, {0, 2}, {0, 1}, {1, 1}};
}
/// Plan of a rib block: two legs at 45 deg, like an open book.
inline std::vector<Eigen::Vector2d> book_shape() {
  const double c = std::sqrt(0.5);
  return {{0, 0}, {3, 0}, {3, 1}, {1 - c, 1}, {-2 * c - 0.5, 2 * c + 1.5 - c}, {-3 * c, 3 * c}};
}

}  // namespace cupola

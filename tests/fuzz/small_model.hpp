#pragma once

#include <array>

#include "assembly/model/assembly.hpp"

namespace cupola {

/// Two unit cubes, one on top of the other; the lower one is fixed.
inline Assembly small_assembly() {
  Assembly assembly;
  for (int level = 0; level < 3; ++level)
    for (const auto& [x, y] : {std::array{0.0, 0.0}, {1.0, 0.0}, {1.0, 1.0}, {0.0, 1.0}})
      assembly.vertices.emplace_back(x, y, level);
  assembly.face_vertex_start = {0};
  for (int block = 0; block < 2; ++block) {
    const int b = 4 * block, t = b + 4;
    assembly.parts.push_back({.block = block, .ring = block - 1, .face_start = assembly.num_faces()});
    const std::array<std::array<int, 4>, 6> faces{{{b, b + 3, b + 2, b + 1},
                                                   {t, t + 1, t + 2, t + 3},
                                                   {b, b + 1, t + 1, t},
                                                   {b + 1, b + 2, t + 2, t + 1},
                                                   {b + 2, b + 3, t + 3, t + 2},
                                                   {b + 3, b, t, t + 3}}};
    for (size_t f = 0; f < faces.size(); ++f)
      assembly.add_face(faces[f], f < 2 ? FaceKind::bed : FaceKind::free);
    assembly.parts.back().num_faces = 6;
    Block solid;
    solid.density = 1000.0;
    solid.fixed = block == 0;
    solid.ring = block - 1;
    assembly.blocks.push_back(solid);
  }
  compute_mass_properties(&assembly);
  return assembly;
}

}  // namespace cupola

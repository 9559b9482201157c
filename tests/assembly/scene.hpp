#pragma once

#include <string>
#include <vector>

#include "assembly/model/assembly.hpp"
#include "tests/fresh_folder.hpp"

namespace cupola::test {

/// A fixed cube, and on it a block made of a box and a triangular prism. All numbers have long binary
/// fractions, so that a lost digit is noticed.
inline Assembly two_block_assembly() {
  Assembly a;
  a.title = "Two blocks, <awkward> & \"quoted\" – not ASCII";
  a.geometry_hash = "00112233445566778899aabbccddeeff";
  a.check_report = "volume 1 m3\nblocks 2\n";
  a.num_rings = 3;
  const double third = 1.0 / 3.0;
  for (const double z : {0.0, 1.0, 1.0 + third})
    for (const double y : {0.0, third})
      for (const double x : {0.1, 0.2, 0.2 + third}) a.vertices.emplace_back(x, y, z);
  using K = FaceKind;
  const auto box = [&a](int p, int q, K low, K high) {  // from vertex p up to p + 6, rows of three in x, y
    const int v[8] = {p, p + 1, p + 4, p + 3, q, q + 1, q + 4, q + 3};
    const int faces[6][4] = {{0, 3, 2, 1}, {4, 5, 6, 7}, {0, 1, 5, 4},
                             {1, 2, 6, 5}, {2, 3, 7, 6}, {3, 0, 4, 7}};
    for (int f = 0; f < 6; ++f) {
      int ids[4];
      for (int i = 0; i < 4; ++i) ids[i] = v[faces[f][i]];
      a.add_face(ids, f == 0 ? low : f == 1 ? high : K::head);
    }
  };
  const auto start_part = [&a](int block, int ring, int slice) {
    a.parts.push_back({block, ring, slice, a.num_faces(), 0, 0.0});
  };
  start_part(0, -1, 0);
  box(0, 6, K::free, K::bed);
  start_part(1, 0, 0);
  box(6, 12, K::bed, K::top);
  start_part(1, 0, 1);  // prism between vertices 7, 8, 13 and their twins in y
  for (const std::vector<int>& face : std::vector<std::vector<int>>{
           {7, 8, 13}, {10, 16, 11}, {7, 10, 11, 8}, {8, 11, 16, 13}, {7, 13, 16, 10}})
    a.add_face(face, face.size() == 3 ? K::intrados : K::internal);
  Block base;
  base.kind = BlockKind::support;
  base.fixed = true;
  base.ring = -1;
  base.density = 18000.0 / 9.81;
  Block upper;
  upper.kind = BlockKind::herringbone;
  upper.rib = true;
  upper.truncated = true;
  upper.num_rings = 3;
  upper.slot = 7;
  upper.sail = 2;
  upper.sail_position = -third;
  upper.spiral = 4;
  upper.density = 1800.1;
  a.blocks = {base, upper};
  compute_mass_properties(&a);
  return a;
}

}  // namespace cupola::test

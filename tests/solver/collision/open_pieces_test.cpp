// Faces of parts that other parts of their block cover.

#include <cmath>
#include <vector>

#include <gtest/gtest.h>

#include "solver/collision/contact_detector.hpp"
#include "tests/solver/scenes.hpp"

namespace cupola::open_pieces_test {
namespace {

using namespace testing;  // the scenes

// A block of a box and a wedge of 10 degrees over a half of its top, which the box has as one face. A stone on
// the wedge touches that face along the edge of the wedge; one on the other half lies on it.
TEST(OpenPieces, WhatOtherPartsOfABlockCoverMakesNoContact) {
  constexpr double kSlope = 0.17;  // rad, below the largest between two faces in contact
  const double c = std::cos(kSlope), s = std::sin(kSlope);
  Assembly scene = make_boxes({{.center = {0.0, 0.5, -0.5}, .size = {2, 1, 1}, .fixed = true}});
  const int first = static_cast<int>(scene.vertices.size());
  for (const double y : {0.0, 1.0})
    for (const Vec3& corner : {Vec3(0, y, 0), Vec3(1, y, 0), Vec3(1, y, s / c)})
      scene.vertices.push_back(corner);
  Part wedge;
  wedge.face_start = scene.num_faces();
  scene.parts.push_back(wedge);
  for (const std::vector<int>& face :
       std::vector<std::vector<int>>{{0, 1, 2}, {3, 5, 4}, {0, 3, 4, 1}, {1, 4, 5, 2}, {0, 2, 5, 3}}) {
    std::vector<int> ids;
    for (const int v : face) ids.push_back(first + v);
    scene.add_face(ids, FaceKind::free);
  }
  add_box({.center = 0.5 * Vec3(c - s, 1.0, s + c),
           .rotation = Eigen::Quaterniond(Eigen::AngleAxisd(-kSlope, Vec3::UnitY()))},
          &scene);
  add_box({.center = {-0.6, 0.5, 0.2}, .size = {0.6, 1.0, 0.4}}, &scene);
  compute_mass_properties(&scene);
  const ContactSet set = ContactDetector(scene, {}).update(initial_poses(scene));
  ASSERT_EQ(set.patches.size(), 2u);
  EXPECT_NEAR(set.patches[0].area, 1.0, 1e-12);  // rounding, also below
  EXPECT_NEAR(set.patches[1].area, 0.6, 1e-12);
}

}  // namespace
}  // namespace cupola::open_pieces_test

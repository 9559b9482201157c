#include <algorithm>
#include <string>

#include <gtest/gtest.h>

#include "generators/generate.hpp"
#include "solver/collision/contact_detector.hpp"

namespace cupola::joint_area_test {
namespace {

/// A surface and a bond.
struct Model {
  std::string name;
  Surface surface;
  Bond bond;
};

void PrintTo(const Model& model, std::ostream* stream) {
  *stream << model.name;
}

OctagonalVault vault(OctagonalVault::Construction construction) {
  OctagonalVault surface;
  surface.construction = construction;
  if (construction == OctagonalVault::Construction::planar_horizontal)
    surface.extrados = OctagonalVault::Extrados::bed;
  return surface;
}

/// Semicircular arch of centreline radius 1 m and t/R = 0.12. The length of 300 voussoirs is a twelfth of
/// their depth.
Model arch(int voussoirs) {
  ArchSurface surface;
  surface.span = 1.88;
  surface.thickness = 0.12;
  surface.voussoir_segments = 1;
  return {"arch_" + std::to_string(voussoirs), surface, StackBond{voussoirs, 1, 1, {}}};
}

std::vector<Model> models() {
  using enum OctagonalVault::Construction;
  RunningBond wall_bond{.rings = 20, .blocks_per_ring = 10, .slices_per_block = 4};
  HerringboneBond level;
  level.rings = 31;
  return {{"dome_running", DomeSurface{}, RunningBond{}},
          {"dome_stack", DomeSurface{}, StackBond{}},
          {"dome_herringbone", DomeSurface{}, HerringboneBond{}},
          {"octagon_circular_running", vault(circular), RunningBond{}},
          {"octagon_circular_herringbone", vault(circular), HerringboneBond{}},
          {"octagon_radial_running", vault(planar_radial), RunningBond{}},
          {"octagon_radial_herringbone", vault(planar_radial), HerringboneBond{}},
          {"octagon_level_herringbone", vault(planar_horizontal), level},
          {"dome_fill", DomeSurface{}, FillBond{}},
          {"wall", WallSurface{}, wall_bond},
          arch(30),
          arch(100),
          arch(300)};
}

class JointArea : public ::testing::TestWithParam<Model> {
 protected:
  Assembly assembly() const {
    Case scene;
    scene.geometry.surface = GetParam().surface;
    scene.geometry.bond = GetParam().bond;
    return cut_assembly(scene);
  }
};

/// Area of the bed and head faces of each block.
std::vector<double> joint_faces(const Assembly& assembly) {
  std::vector<double> areas(assembly.blocks.size(), 0.0);
  for (const Part& part : assembly.parts)
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f) {
      const FaceKind kind = assembly.face_kinds[f];
      if (kind == FaceKind::bed || kind == FaceKind::head)
        areas[part.block] += polygon_area(face_points(assembly, f));
    }
  return areas;
}

// The patches cover the bed and head faces of every block exactly once.
TEST_P(JointArea, CoversBedsAndHeadsOnce) {
  const Assembly model = assembly();
  const ContactSet set = ContactDetector(model, {}).update(initial_poses(model));
  std::vector<double> detected(model.blocks.size(), 0.0);
  for (const Patch& patch : set.patches) {
    detected[patch.block_a] += patch.area;
    detected[patch.block_b] += patch.area;
  }
  const std::vector<double> expected = joint_faces(model);
  for (std::size_t b = 0; b < expected.size(); ++b) {
    if (model.blocks[b].fixed) continue;
    EXPECT_NEAR(detected[b], expected[b], 1e-9 * expected[b]) << "block " << b;
  }
}

TEST_P(JointArea, HasClosedFaceContactsOnly) {
  const Assembly model = assembly();
  const ContactSet set = ContactDetector(model, {}).update(initial_poses(model));
  ASSERT_FALSE(set.points.empty());
  for (const Contact& contact : set.points) {
    EXPECT_GE(std::min(contact.id.face_a, contact.id.face_b), 0)
        << "edge contact at rest, blocks " << contact.block_a << " " << contact.block_b;
    EXPECT_NEAR(contact.gap, 0.0, 1e-11);  // rounding at 40 m from the origin
  }
}

INSTANTIATE_TEST_SUITE_P(Models, JointArea, ::testing::ValuesIn(models()),
                         [](const auto& model) { return model.param.name; });

}  // namespace
}  // namespace cupola::joint_area_test

// What the assembly says about its sheets, so that no other program asks how they were drawn.

#include <numbers>

#include <gtest/gtest.h>

#include "assembly/files/assembly_file.hpp"
#include "tests/fresh_folder.hpp"
#include "tests/generators/models.hpp"

namespace cupola::sheet_test {
namespace {

using enum Sheet::ThrustLines;

Case with_surface(const Surface& surface) {
  Case c;
  c.geometry.surface = surface;
  c.geometry.bond = StackBond{6, 16, 1, {}};
  return c;
}

Case with_drum() {
  Case c = with_surface(OctagonalVault{});
  c.geometry.members = {octagonal_drum(45.0, 5.0, 3.0, StackBond{3, 16, 1, {}})};
  c.geometry.on = "drum";
  return c;
}

Case with_window() {
  Case c = with_surface(DomeSurface{});
  c.geometry.window = Window{.height = 10.0, .course = 0.5};
  return c;
}

struct Model {
  Case scene;
  std::vector<Sheet> sheets;
};

std::vector<Model> models() {
  return {{with_surface(DomeSurface{}), {{"shell", 0, 6, true, by_azimuth, 1}}},
          {with_surface(OctagonalVault{}), {{"shell", 0, 6, true, by_azimuth, 8}}},
          {with_surface(ArchSurface{}), {{"shell", 0, 6, false, one, 1}}},
          {with_surface(WallSurface{}), {{"shell", 0, 6, false, none, 1}}},
          {with_drum(),
           {{"drum", 0, 3, true, by_azimuth, 8, false, {0.0, 0.0, -5.0}},
            {"shell", 3, 6, true, by_azimuth, 8, true}}},
          {with_window(), {{"shell", 0, 6, false, by_azimuth, 1}}}};
}

TEST(Sheets, AreWrittenIntoTheAssemblyAndReadBack) {
  const std::string path = test::fresh_folder("sheets") + "/assembly.vtu";
  for (const Model& model : models()) {
    const Assembly assembly = cut_assembly(model.scene);
    EXPECT_EQ(assembly.sheets, model.sheets);
    write_assembly(path, assembly);
    EXPECT_EQ(read_assembly(path).sheets, model.sheets);
  }
}

// Files of version 0.2 state no sheets. A window was a part of a closed ring there.
TEST(Sheets, AreAssumedForFilesThatDoNotStateThem) {
  const std::string path = test::fresh_folder("sheets") + "/assembly.vtu";
  for (const Model& model : models()) {
    Assembly assembly = cut_assembly(model.scene);
    assembly.sheets.clear();
    write_assembly(path, assembly);
    const std::vector<Sheet> sheets = read_assembly(path).sheets;
    ASSERT_EQ(sheets.size(), 1u);
    EXPECT_EQ(sheets.front().thrust_lines, model.sheets.back().thrust_lines);
    EXPECT_EQ(sheets.front().sails, model.sheets.back().sails);
    EXPECT_EQ(sheets.front().num_rings, assembly.num_rings);
  }
}

TEST(Sheets, KnowWhatIsOutwards) {
  const Vec3 point(-3.0, 4.0, 7.0);
  Sheet sheet;
  EXPECT_FALSE(sheet.outward(point));
  sheet.thrust_lines = one;
  EXPECT_EQ(sheet.outward(point), -Vec3::UnitX());
  sheet.origin = Vec3(-5.0, 0.0, 0.0);
  EXPECT_EQ(sheet.outward(point), Vec3::UnitX());
  sheet.turn = std::numbers::pi;
  EXPECT_LT((sheet.outward(point).value() - Vec3::UnitX()).norm(), 1e-15);
  sheet.thrust_lines = by_azimuth;
  EXPECT_LT((sheet.outward(point).value() - Vec3(2.0, 4.0, 0.0).normalized()).norm(), 1e-15);
  sheet.origin.setZero();
  EXPECT_LT((sheet.outward(point).value() - Vec3(-0.6, 0.8, 0.0)).norm(), 1e-15);  // rounding
}

}  // namespace
}  // namespace cupola::sheet_test

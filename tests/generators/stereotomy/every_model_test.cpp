// Properties of every model of the paper, complete and at the stages of 14.5 and 22.5 m: convex cells, no
// overlaps, no joint on a corner, one connected component, part volumes that add up to the block volumes. All
// other shapes too, whole and cut.

#include <cmath>
#include <numbers>
#include <vector>

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include "generators/generate.hpp"
#include "tests/generators/models.hpp"

namespace cupola::every_model_test {
namespace {

using std::numbers::pi;
using Construction = OctagonalVault::Construction;
using Extrados = OctagonalVault::Extrados;

struct Model {
  const char* name;
  Surface surface;
  Bond bond;
};

void PrintTo(const Model& model, std::ostream* out) {
  *out << model.name;
}

Surface vault(Construction construction, Extrados extrados) {
  OctagonalVault v;
  v.construction = construction;
  v.extrados = extrados;
  return v;
}

HerringboneBond left_herringbone() {
  HerringboneBond bond;
  bond.chirality = HerringboneBond::Chirality::left;
  return bond;
}

HerringboneBond meridian_strips() {
  HerringboneBond bond;
  bond.path = HerringboneBond::Path::meridian;
  return bond;
}

HerringboneBond wall_diagonal() {
  HerringboneBond bond;
  bond.rings = 24;
  bond.blocks_per_ring = 8;
  bond.spirals = 1;
  return bond;
}

VaultSurface drawn(Plan::Kind plan, Profile::Kind profile) {
  VaultSurface v;
  v.plan.kind = plan;
  v.plan.length = 4.0;
  v.plan.x = {8, -8, -8, 8};
  v.plan.y = {6, 6, -6, -6};
  v.profile.kind = profile;
  v.profile.span = 12.0;
  v.profile.haunch_radius = 2.5;
  if (plan != Plan::Kind::line && profile != Profile::Kind::straight) v.eye = 2.0;
  v.key_stone = plan == Plan::Kind::circle && v.eye > 0.0;
  if (plan == Plan::Kind::groin) {
    v.eye = 0.0;
    v.plan.sides = 4;
    v.thickness = 0.5;
  }
  return v;
}

VaultSurface closed_by_a_stone(VaultSurface surface) {
  surface.key_stone = true;
  return surface;
}

VaultSurface at_angles(VaultSurface surface) {
  surface.beds = VaultSurface::Beds::given;
  surface.bed_angles_deg = {30.0, 85.0};
  return surface;
}

VaultSurface by_angle(VaultSurface surface) {
  surface.courses = VaultSurface::Courses::angle;
  return surface;
}

class EveryModel : public testing::TestWithParam<std::tuple<Model, int>> {
 protected:
  static Case scene() {
    const auto& [model, stage] = GetParam();
    Case c;
    c.geometry.surface = model.surface;
    c.geometry.bond = model.bond;
    if (stage > 0) c.geometry.stage = Stage{stage};
    return c;
  }
};

/// m: size of the model times the rounding error of a few operations, 50 m x 2^-53 x 4.
constexpr double kRounding = 3e-14;

TEST_P(EveryModel, IsConvexConnectedAndFreeOfOverlaps) {
  ModelReport report;
  const Assembly assembly = check_and_report(scene(), &report);
  EXPECT_LT(report.max_convexity_error, kRounding);
  EXPECT_LT(report.max_planarity_error, kRounding);
  EXPECT_LT(report.max_overlap, 1e-9);
  EXPECT_EQ(report.islands, 1);
  EXPECT_TRUE(report.blocks_without_joint.empty());
  EXPECT_NEAR(report.parts_volume, report.volume, 1e-12 * report.volume);
  EXPECT_GT(report.shortest_edge, 0.1);  // no slivers; the shortest edge, 0.16 m, is at a split vertical
}

class EveryVaultWithCorners : public EveryModel {};

TEST_P(EveryVaultWithCorners, HasNoHeadJointOnACorner) {
  const auto* octagon = std::get_if<OctagonalVault>(&std::get<0>(GetParam()).surface);
  ASSERT_NE(octagon, nullptr);
  const Assembly assembly = cut_assembly(scene());
  int heads = 0;
  for (int f = 0; f < assembly.num_faces(); ++f) {
    if (assembly.face_kinds[f] != FaceKind::head) continue;
    ++heads;
    const Vec3 p = polygon_centroid(face_points(assembly, f));
    const double off = std::remainder(std::atan2(p.y(), p.x()), 2.0 * pi / octagon->sails);
    EXPECT_GT(std::abs(off), 1e-3) << "face " << f;  // blocks are 0.2 rad wide
  }
  EXPECT_GT(heads, 0);
}

const auto kDomes = testing::Values(Model{"dome_running", DomeSurface{}, RunningBond{}},
                                    Model{"dome_stack", DomeSurface{}, StackBond{}},
                                    Model{"dome_herringbone", DomeSurface{}, HerringboneBond{}},
                                    Model{"dome_left_herringbone", DomeSurface{}, left_herringbone()},
                                    Model{"dome_meridian_strips", DomeSurface{}, meridian_strips()});

const auto kVaultsWithCorners = testing::Values(
    Model{"octagon_circular", vault(Construction::circular, Extrados::normal), RunningBond{}},
    Model{"octagon_circular_corner", vault(Construction::circular, Extrados::corner), RunningBond{}},
    Model{"octagon_circular_midsail", vault(Construction::circular, Extrados::midsail), RunningBond{}},
    Model{"octagon_planar", vault(Construction::planar_radial, Extrados::normal), RunningBond{}},
    Model{"octagon_planar_corner", vault(Construction::planar_radial, Extrados::corner), RunningBond{}},
    Model{"octagon_level", vault(Construction::planar_horizontal, Extrados::normal), RunningBond{}},
    Model{"octagon_level_bed", vault(Construction::planar_horizontal, Extrados::bed), RunningBond{}},
    Model{"octagon_fill", vault(Construction::circular, Extrados::normal), FillBond{}},
    Model{"brunelleschi", vault(Construction::circular, Extrados::normal), HerringboneBond{}},
    Model{"brunelleschi_left", vault(Construction::circular, Extrados::normal), left_herringbone()});

const auto kStages = testing::Values(0, 16, 26);  // rings: complete model, 14.5 m, 22.5 m

std::string stage_name(const testing::TestParamInfo<std::tuple<Model, int>>& test) {
  return std::string(std::get<0>(test.param).name) + "_" + std::to_string(std::get<1>(test.param));
}

INSTANTIATE_TEST_SUITE_P(Domes, EveryModel, testing::Combine(kDomes, kStages), stage_name);
INSTANTIATE_TEST_SUITE_P(Vaults, EveryModel, testing::Combine(kVaultsWithCorners, kStages), stage_name);
INSTANTIATE_TEST_SUITE_P(Vaults, EveryVaultWithCorners, testing::Combine(kVaultsWithCorners, kStages),
                         stage_name);

INSTANTIATE_TEST_SUITE_P(
    Walls, EveryModel,
    testing::Combine(testing::Values(Model{"wall_medium", WallSurface{}, RunningBond{20, 10, 2}},
                                     Model{"wall_herringbone", WallSurface{32.0, 24.0, 2.4},
                                           wall_diagonal()}),
                     testing::Values(0)),
    [](const auto& test) { return std::string(std::get<0>(test.param).name); });

const std::vector<Model> kDrawings{
    Model{"bridge", drawn(Plan::Kind::line, Profile::Kind::segmental), RunningBond{15, 4, 2}},
    Model{"basket", drawn(Plan::Kind::line, Profile::Kind::basket), RunningBond{15, 4, 2}},
    Model{"horseshoe", drawn(Plan::Kind::line, Profile::Kind::horseshoe), RunningBond{15, 4, 2}},
    Model{"catenary", drawn(Plan::Kind::line, Profile::Kind::catenary), StackBond{15, 4, 2}},
    Model{"parabola_dome", drawn(Plan::Kind::circle, Profile::Kind::parabola), RunningBond{8, 16, 2}},
    Model{"ellipse_dome", drawn(Plan::Kind::circle, Profile::Kind::ellipse), HerringboneBond{8, 16, 4}},
    Model{"tower", drawn(Plan::Kind::circle, Profile::Kind::straight), RunningBond{8, 16, 2}},
    Model{"cloister", drawn(Plan::Kind::corners, Profile::Kind::semicircle), RunningBond{8, 28, 4}},
    Model{"hexagon", drawn(Plan::Kind::polygon, Profile::Kind::pointed), RunningBond{8, 16, 4}},
    Model{"pavilion", closed_by_a_stone(drawn(Plan::Kind::corners, Profile::Kind::semicircle)),
          RunningBond{8, 28, 4}},
    Model{"groin", drawn(Plan::Kind::groin, Profile::Kind::semicircle), StackBond{9, 1, 2}},
    Model{"pointed_groin", drawn(Plan::Kind::groin, Profile::Kind::pointed), StackBond{10, 1, 2}},
    Model{"given_beds", at_angles(drawn(Plan::Kind::line, Profile::Kind::segmental)), RunningBond{15, 4, 2}},
    Model{"by_angle", by_angle(drawn(Plan::Kind::circle, Profile::Kind::ellipse)), RunningBond{8, 16, 2}}};

INSTANTIATE_TEST_SUITE_P(Drawings, EveryModel,
                         testing::Combine(testing::ValuesIn(kDrawings), testing::Values(0)),
                         [](const auto& test) { return std::string(std::get<0>(test.param).name); });

/// All drawn shapes, cut.
class EveryCutShape : public testing::TestWithParam<Model> {
 protected:
  static Case scene(const std::vector<Cut>& cuts) {
    Case c;
    c.geometry.surface = GetParam().surface;
    c.geometry.bond = GetParam().bond;
    c.geometry.cuts = cuts;
    return c;
  }
  static double volume(const std::vector<Cut>& cuts) {
    double sum = 0.0;
    for (const Block& block : cut_assembly(scene(cuts)).blocks) sum += block.fixed ? 0.0 : block.volume;
    return sum;
  }
};

// What a plane leaves on its two sides is the whole.
TEST_P(EveryCutShape, IsPartedByPlanesWithoutLoss) {
  const double whole = volume({});
  for (const Vec3& normal : {Vec3(1.0, 0.2, 0.0), Vec3(0.3, -0.1, 1.0)}) {
    Cut cut;
    cut.point = {0.7, 1.3, 2.1};
    cut.normal = normal;
    Cut rest = cut;
    rest.normal = -normal;
    EXPECT_NEAR(volume({cut}) + volume({rest}), whole, 1e-12 * whole);
    cut.as = Cut::As::joint;
    EXPECT_NEAR(volume({cut}), whole, 1e-12 * whole);
  }
}

TEST_P(EveryCutShape, HasHolesWithoutGapsAndOverlaps) {
  Cut window;
  window.kind = Cut::Kind::cylinder;
  window.axis = Cut::Axis::x;
  window.centre_u = 2.0;
  window.centre_v = 2.5;
  const auto* drawn_shape = std::get_if<VaultSurface>(&GetParam().surface);
  const bool is_groin = drawn_shape && drawn_shape->plan.kind == Plan::Kind::groin;
  if (is_groin)  // in the web behind the side x = 6, at y = 2
    window.centre_v = drawn_shape->profile.kind == Profile::Kind::pointed ? 8.0 : 5.9;
  window.radius = 0.5;
  window.sides = 8;
  Cut door;
  door.kind = Cut::Kind::prism;
  door.axis = Cut::Axis::x;
  door.u = {1.6, 2.4, 2.4, 1.6};
  door.v = {-0.5, -0.5, 1.2, 1.2};
  door.from = 0.0;
  ModelReport report;
  check_and_report(scene(is_groin ? std::vector{window} : std::vector{window, door}), &report);
  EXPECT_LT(report.max_convexity_error, kRounding);
  EXPECT_LT(report.max_overlap, 1e-9);
  EXPECT_EQ(report.islands, 1);
  EXPECT_LT(report.volume, volume({}));
}

std::vector<Model> all_shapes() {
  std::vector<Model> shapes{{"dome", DomeSurface{12.0, 0.5, 0.5, 70.0}, RunningBond{8, 16, 2}},
                            {"octagon", OctagonalVault{8, 12.0, 0.8, 0.5, 60.0}, RunningBond{8, 16, 4}},
                            {"wall", WallSurface{8.0, 5.0, 4.0}, RunningBond{8, 8, 2}}};
  shapes.insert(shapes.end(), kDrawings.begin(), kDrawings.end());
  return shapes;
}

INSTANTIATE_TEST_SUITE_P(Shapes, EveryCutShape, testing::ValuesIn(all_shapes()),
                         [](const auto& test) { return std::string(test.param.name); });

}  // namespace
}  // namespace cupola::every_model_test

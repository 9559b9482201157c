// Courses whose bricks keep their length: counts and volumes against closed forms, and the checks of every
// model.

#include <algorithm>
#include <cmath>
#include <map>
#include <numbers>
#include <string>
#include <vector>

#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "generators/stereotomy/separation.hpp"
#include "generators/surface/profile.hpp"
#include "tests/generators/models.hpp"

namespace cupola::constant_length_test {
namespace {

using std::numbers::pi;

constexpr double kRadius = 4.0, kThickness = 0.3, kEye = 0.8;  // m
constexpr int kRings = 16, kColumns = 4;
constexpr double kLetter = 0.25;  // m

DrawnBond bricks(int rings = kRings, double letter = kLetter) {
  DrawnBond bond;
  bond.rings = rings;
  bond.rows = {"cddc", "aabb"};
  bond.letter_length = letter;
  bond.length = DrawnBond::Length::constant;
  return bond;
}

VaultSurface vault(Plan::Kind plan, Profile::Kind profile = Profile::Kind::semicircle) {
  VaultSurface surface;
  surface.plan.kind = plan;
  surface.plan.x = {4, -4, -4, 4};
  surface.plan.y = {3, 3, -3, -3};
  surface.profile.kind = profile;
  surface.profile.span = plan == Plan::Kind::corners ? 6.0 : 2.0 * kRadius;
  surface.profile.height = 3.0;
  surface.thickness = kThickness;
  if (profile != Profile::Kind::straight) surface.eye = kEye;
  return surface;
}

Case case_of(const Surface& surface, const DrawnBond& bond) {
  Case c;
  c.geometry.surface = surface;
  c.geometry.bond = bond;
  return c;
}

std::map<int, int> blocks_per_course(const Assembly& assembly) {
  std::map<int, int> count;
  for (const Block& block : assembly.blocks)
    if (!block.fixed) ++count[block.ring];
  return count;
}

std::string error_of(const Case& c) {
  try {
    cut_assembly(c);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// Radius and height (m) of the hemisphere on bed k, at a depth behind the intrados; the beds divide the arc
/// from the springing to the eye into equal parts.
Vec2 on_bed(int k, double depth) {
  const double angle = std::acos(kEye / kRadius) * k / kRings;
  return (kRadius + depth) * Vec2(std::cos(angle), std::sin(angle));
}

// Two bricks a drawing: 2 round(2 pi r / 1 m), r of the lower bed, 25.13 m to 6.91 m round.
TEST(ConstantLength, HasTheBricksCountedByHand) {
  const std::vector<int> by_hand{50, 50, 50, 48, 48, 46, 44, 42, 38, 36, 32, 30, 26, 22, 18, 14};
  const std::map<int, int> found =
      blocks_per_course(cut_assembly(case_of(vault(Plan::Kind::circle), bricks())));
  ASSERT_EQ(found.size(), by_hand.size());
  for (int k = 0; k < kRings; ++k) {
    const double length = 2.0 * pi * on_bed(k, 0.0).x();
    EXPECT_EQ(found.at(k), 2 * std::lround(length / (kColumns * kLetter))) << "course " << k;
    EXPECT_EQ(found.at(k), by_hand[static_cast<size_t>(k)]) << "course " << k;
  }
}

// VAULTS.md, section 8: N sin(2 pi / N) times the moment of the section about the axis, N the letters of the
// first course. The section between two beds is a quadrilateral.
TEST(ConstantLength, HasTheVolumeOfTheFacetsOfItsFirstCourse) {
  double moment = 0.0;
  for (int k = 0; k < kRings; ++k) {
    const std::vector<Vec2> p{on_bed(k, 0.0), on_bed(k, kThickness), on_bed(k + 1, kThickness),
                              on_bed(k + 1, 0.0)};
    for (size_t i = 0; i < 4; ++i) {
      const Vec2 &a = p[i], &b = p[(i + 1) % 4];
      moment += (a.x() + b.x()) * (a.x() * b.y() - b.x() * a.y()) / 6.0;
    }
  }
  constexpr int kFacets = 100;  // 25.13 m of letters of 0.25 m, in whole drawings of four
  ModelReport report;
  check_and_report(case_of(vault(Plan::Kind::circle), bricks()), &report);
  const double expected = kFacets * std::sin(2.0 * pi / kFacets) * moment;
  EXPECT_NEAR(report.volume, expected, 1e-12 * expected);
}

struct Shape {
  const char* name;
  VaultSurface surface;
  bool is_stretched = false;
};

VaultSurface conical() {
  VaultSurface surface = vault(Plan::Kind::polygon, Profile::Kind::pointed);
  surface.plan.sides = 8;
  surface.beds = VaultSurface::Beds::conical;
  return surface;
}

VaultSurface with_key_stone(VaultSurface surface) {
  surface.key_stone = true;
  return surface;
}

VaultSurface in_segments(VaultSurface surface) {
  surface.voussoir_segments = 2;
  return surface;
}

const std::vector<Shape> kShapes{{"dome", vault(Plan::Kind::circle)},
                                 {"key_stone", with_key_stone(vault(Plan::Kind::circle))},
                                 {"segments", in_segments(vault(Plan::Kind::circle))},
                                 {"stretched", vault(Plan::Kind::circle), true},
                                 {"parabola", vault(Plan::Kind::circle, Profile::Kind::parabola)},
                                 {"pavilion", vault(Plan::Kind::corners)},
                                 {"octagon", vault(Plan::Kind::polygon)},
                                 {"octagon_on_cones", conical()}};

class EveryShape : public testing::TestWithParam<Shape> {};

TEST_P(EveryShape, IsConvexConnectedAndFreeOfOverlaps) {
  Case c = case_of(GetParam().surface, bricks());
  if (GetParam().is_stretched) {
    c.geometry.affine.emplace();
    c.geometry.affine->scale = {1.5, 1.0, 0.8};
  }
  ModelReport report;
  const Assembly assembly = check_and_report(c, &report);
  EXPECT_LT(report.max_convexity_error, 1e-14);  // 13 m x 2^-53 x a few operations
  EXPECT_LT(report.max_planarity_error, 1e-14);
  EXPECT_LT(report.max_overlap, 2e-11 * 13.0);
  EXPECT_LT(report.max_joint_gap, 2e-11 * 13.0);
  EXPECT_EQ(report.islands, 1);
  EXPECT_TRUE(report.blocks_without_joint.empty());
  EXPECT_NEAR(report.parts_volume, report.volume, 1e-12 * report.volume);
  const std::map<int, int> found = blocks_per_course(assembly);
  EXPECT_LT(found.at(kRings - 1), found.at(0) / 2);
}

INSTANTIATE_TEST_SUITE_P(Shapes, EveryShape, testing::ValuesIn(kShapes),
                         [](const auto& test) { return std::string(test.param.name); });

// The courses of a cylinder have one length, so that both ways of laying give the same blocks.
TEST(ConstantLength, IsTheNarrowingBondWhereCoursesDoNotShorten) {
  const VaultSurface cylinder = vault(Plan::Kind::circle, Profile::Kind::straight);
  DrawnBond narrowing = bricks(6);
  narrowing.length = DrawnBond::Length::narrowing;
  const Assembly a = cut_assembly(case_of(cylinder, bricks(6))),
                 b = cut_assembly(case_of(cylinder, narrowing));
  ASSERT_EQ(a.blocks.size(), b.blocks.size());
  for (size_t i = 0; i < a.blocks.size(); ++i) {
    EXPECT_NEAR(a.blocks[i].volume / b.blocks[i].volume, 1.0, 1e-14) << "rounding, also of 60 m3 of support";
    EXPECT_LT((a.blocks[i].centroid - b.blocks[i].centroid).norm(), 1e-14);
  }
}

// A course has a whole number of drawings, so that its letters differ from those of the case by at most half
// a drawing over their number.
TEST(ConstantLength, KeepsTheLengthOfLetters) {
  for (const auto& [ring, count] :
       blocks_per_course(cut_assembly(case_of(vault(Plan::Kind::circle), bricks(kRings, 0.1))))) {
    const int letters = 2 * count;
    const double length = 2.0 * pi * on_bed(ring, 0.0).x() / letters;
    EXPECT_LE(std::abs(length - 0.1), 0.5 * kColumns / letters * 0.1 + 1e-15) << "course " << ring;
  }
}

TEST(ConstantLength, BeginsEveryCourseAtItsPhase) {
  DrawnBond bond = bricks();
  bond.phase = 0.5;
  const Assembly assembly = cut_assembly(case_of(vault(Plan::Kind::circle), bond));
  const std::map<int, int> count = blocks_per_course(assembly);
  for (const Block& block : assembly.blocks) {
    if (block.fixed || block.slot != 0) continue;
    const double letter = pi / count.at(block.ring);
    const double start = 0.5 * letter, middle = std::atan2(block.centroid.y(), block.centroid.x());
    // The first brick of an odd course lies half a brick before the phase.
    const double expected = start + (block.ring % 2 == 0 ? letter : 2.0 * letter);
    EXPECT_NEAR(std::remainder(middle - expected, 2.0 * letter), 0.0, 0.02 * letter) << block.ring;
  }
}

/// True if a block shares a patch with a face from its other side.
bool meets_a_block(const Assembly& assembly, int block, int face) {
  const std::vector<Vec3> points = face_points(assembly, face);
  const Plane plane = polygon_plane(points);
  return std::ranges::any_of(assembly.parts, [&](const Part& part) {
    if (part.block == block) return false;
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f) {
      const std::vector<Vec3> other = face_points(assembly, f);
      if (polygon_plane(other).normal.dot(plane.normal) > -1.0 + 1e-9) continue;
      if (std::abs(plane.normal.dot(other.front()) - plane.offset) > 1e-9) continue;
      if (overlap_width(points, other, plane.normal) > 1e-9) return true;
    }
    return false;
  });
}

// Every fourth place of the even courses is empty, so that beds above and below them are free.
TEST(ConstantLength, KindsOfFacesSayWhatLiesBehindThem) {
  DrawnBond bond = bricks(5, 0.5);
  bond.rows = {"cddc", "aa.b"};
  const Assembly assembly = cut_assembly(case_of(vault(Plan::Kind::circle), bond));
  std::map<FaceKind, int> count;
  for (const Part& part : assembly.parts) {
    if (assembly.blocks[part.block].fixed) continue;
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f) {
      const FaceKind kind = assembly.face_kinds[f];
      if (kind != FaceKind::bed && kind != FaceKind::head && kind != FaceKind::free) continue;
      ++count[kind];
      EXPECT_EQ(meets_a_block(assembly, part.block, f), kind != FaceKind::free) << "face " << f;
    }
  }
  for (const FaceKind kind : {FaceKind::bed, FaceKind::head, FaceKind::free}) EXPECT_GT(count[kind], 10);
}

TEST(ConstantLength, NamesWhatDoesNotFit) {
  DrawnBond tall = bricks();
  tall.rows = {"accc", "abbb"};
  tall.shift = 1;
  EXPECT_NE(error_of(case_of(vault(Plan::Kind::circle), tall)).find("a block of letters a is 2 courses high"),
            std::string::npos);
  // 25.13 m are two drawings of 12.5 m; the last courses, of 7.1 to 5 m round, are about half of one.
  const Case long_letters = case_of(vault(Plan::Kind::circle), bricks(64, 3.125));
  EXPECT_NE(error_of(long_letters).find("is shorter than half a drawing of 12.5 m; choose a larger eye"),
            std::string::npos)
      << error_of(long_letters);
  Case gaps = case_of(vault(Plan::Kind::circle), bricks());
  gaps.geometry.imperfections.emplace();
  gaps.geometry.imperfections->gap = 1e-3;
  EXPECT_NE(error_of(gaps).find("not available for a bond with length: constant"), std::string::npos);
}

}  // namespace
}  // namespace cupola::constant_length_test

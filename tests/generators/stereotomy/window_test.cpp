// Windows: some courses at the scale of bricks over a sector of a dome or of one sail.

#include <cmath>
#include <map>
#include <numbers>
#include <tuple>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "generators/stereotomy/shell.hpp"
#include "tests/generators/models.hpp"

namespace cupola::window_test {
namespace {

using std::numbers::pi;
using Chirality = HerringboneBond::Chirality;

constexpr double R = 36.0, e = 13.5, kDepth = 0.34, kCourse = 0.06;
constexpr int kBricks = 33, kSpirals = 10, kHeight = 3, kVerticals = 6;

HerringboneBond brick_herringbone(Chirality chirality = Chirality::right, int embedment = -1) {
  HerringboneBond bond;
  bond.rings = 21;
  bond.blocks_per_ring = kBricks;
  bond.spirals = kSpirals;
  bond.verticals_per_block = kVerticals;
  bond.beside = HerringboneBond::Beside::half;
  bond.chirality = chirality;
  bond.embedment = embedment;
  return bond;
}

Case window_case(const Surface& surface, const Bond& bond, double height = 22.5) {
  Case c;
  c.geometry.surface = surface;
  c.geometry.bond = bond;
  c.geometry.window = Window{.height = height, .course = kCourse, .ends = Window::Ends::held};
  c.geometry.support_width = 0.3;
  return c;
}

Surface dome() {
  DomeSurface surface;
  surface.thickness = kDepth;
  surface.crown_angle_deg = 66.0;
  return surface;
}

Surface octagon() {
  OctagonalVault surface;
  surface.thickness = kDepth;
  surface.crown_angle_deg = 66.0;
  return surface;
}

/// Integral of rho over the section of course k of the dome, m3: the quadrilateral between two beds. The beds
/// lie kCourse / R apart, and bed 20 at z = height on the intrados.
double section_moment(int k, double height) {
  const auto point = [&](int bed, double r) {
    const double t = std::asin(height / R) + (bed - 20) * kCourse / R;
    return std::pair(r * std::cos(t) - e, r * std::sin(t));
  };
  const std::array corners{point(k, R), point(k, R + kDepth), point(k + 1, R + kDepth), point(k + 1, R)};
  double moment = 0.0;
  for (size_t i = 0; i < 4; ++i) {
    const auto [x0, z0] = corners[i];
    const auto [x1, z1] = corners[(i + 1) % 4];
    moment += (x0 * z1 - x1 * z0) * (x0 + x1) / 6.0;
  }
  return moment;
}

// Radial planes d apart cut from course k the volume sin(d) times the integral of rho over its section,
// because the horizontal sections between the chords are triangles with that sine.
TEST(Window, BricksOfTheDomeHaveTheVolumesOfTheClosedForm) {
  constexpr double kSlice = pi / 4 / (kBricks * kVerticals);
  const Assembly bricks = cut_assembly(window_case(dome(), brick_herringbone()));
  int whole = 0, cut = 0;
  for (const Block& block : bricks.blocks) {
    if (block.fixed) continue;
    double slice = 0.0;
    for (int ring = block.ring; ring < block.ring + block.num_rings; ++ring)
      slice += std::sin(kSlice) * section_moment(ring, 22.5);
    const double slices = block.volume / slice;
    // 1e-8: relative error of the height of a course, which the window finds by differences.
    EXPECT_NEAR(slices, std::round(slices), 1e-8 * slices);
    if (block.kind == BlockKind::herringbone) {
      EXPECT_NEAR(slices, 1.0, 1e-8);
      EXPECT_EQ(block.truncated, block.num_rings != kHeight);
    } else {
      EXPECT_LT(slices, kVerticals + 0.5);
      EXPECT_EQ(block.truncated, std::lround(slices) != kVerticals);
      ++(block.truncated ? cut : whole);
    }
  }
  EXPECT_GT(whole, 0);
  EXPECT_GT(cut, 0);
}

// They lay from 7.1 to 16 degrees where beds are plane, along which abscissae are shares of the sides.
TEST(Window, ReachesFromAzimuthToAzimuth) {
  using Construction = OctagonalVault::Construction;
  for (const Construction construction :
       {Construction::circular, Construction::planar_radial, Construction::planar_horizontal}) {
    OctagonalVault vault = std::get<OctagonalVault>(octagon());
    vault.sails = 4;
    vault.construction = construction;
    Case c = window_case(vault, RunningBond{5, 8, 2});
    c.geometry.window->ends = Window::Ends::free;
    c.geometry.window->from_deg = 10.0;
    c.geometry.window->to_deg = 20.0;
    const Assembly bricks = cut_assembly(c);
    double low = pi, high = -pi;
    for (const Part& part : bricks.parts) {
      if (bricks.blocks[part.block].fixed) continue;
      for (int f = part.face_start; f < part.face_start + part.num_faces; ++f)
        for (const Vec3& p : face_points(bricks, f)) {
          low = std::min(low, std::atan2(p.y(), p.x()));
          high = std::max(high, std::atan2(p.y(), p.x()));
        }
    }
    EXPECT_NEAR(low, pi / 18.0, 1e-12);  // rounding
    EXPECT_NEAR(high, pi / 9.0, 1e-12);
  }
}

std::map<BlockKind, int> count_kinds(const Assembly& assembly) {
  std::map<BlockKind, int> count;
  for (const Block& block : assembly.blocks) ++count[block.kind];
  return count;
}

// Every spiral begins one upright per course, and H - 1 more reach into the window from below.
TEST(Window, LaysOneNewUprightOfEverySpiralPerCourse) {
  for (const Chirality chirality : {Chirality::right, Chirality::left}) {
    const Assembly bricks = cut_assembly(window_case(dome(), brick_herringbone(chirality)));
    EXPECT_EQ(count_kinds(bricks)[BlockKind::herringbone], kSpirals * (21 + kHeight - 1));
    EXPECT_EQ(count_kinds(bricks)[BlockKind::support], 3);
  }
}

// With an embedment m the uprights of a spiral stand on each other; those in the last course begin m courses
// below it, also where the window goes on above the stage.
TEST(Window, UprightsOfTheLastCourseHaveTheEmbedmentAskedFor) {
  for (const int rings : {21, 23})
    for (int embedment = 0; embedment < kHeight; ++embedment) {
      HerringboneBond bond = brick_herringbone(Chirality::right, embedment);
      bond.rings = rings;
      Case c = window_case(dome(), bond);
      c.geometry.stage = Stage{21};
      int in_last = 0;
      for (const Block& block : cut_assembly(c).blocks) {
        if (block.kind != BlockKind::herringbone || block.ring + block.num_rings <= 20) continue;
        EXPECT_EQ(block.ring, 20 - embedment);
        EXPECT_EQ(block.num_rings, std::min(kHeight, rings - block.ring));
        ++in_last;
      }
      EXPECT_EQ(in_last, kSpirals) << rings << " " << embedment;
    }
}

class BrickModel : public testing::TestWithParam<std::tuple<bool, int, double>> {
 protected:
  static Case scene() {
    const auto [is_octagon, bond, height] = GetParam();
    const int bricks = std::max(7, static_cast<int>(45.0 - height));
    RunningBond running{21, bricks, 2};
    HerringboneBond herringbone = brick_herringbone(static_cast<Chirality>(std::max(0, bond)));
    herringbone.blocks_per_ring = bricks;
    herringbone.spirals = std::max(2, bricks / 4);
    return window_case(is_octagon ? octagon() : dome(), bond < 0 ? Bond(running) : Bond(herringbone), height);
  }
};

TEST_P(BrickModel, IsConvexConnectedAndFreeOfOverlaps) {
  ModelReport report;
  const Assembly bricks = check_and_report(scene(), &report);
  EXPECT_LT(report.max_convexity_error,
            3e-14);  // m: rounding of coordinates of 50 m, as for the macro-blocks
  EXPECT_LT(report.max_planarity_error, 3e-14);
  EXPECT_LT(report.max_overlap, 1e-9);
  EXPECT_LT(report.max_joint_gap, 1e-13);
  EXPECT_EQ(report.islands, 1);
  EXPECT_TRUE(report.blocks_without_joint.empty());
  EXPECT_NEAR(report.parts_volume, report.volume, 1e-12 * report.volume);
  ASSERT_TRUE(report.shell_volume);  // the sagitta of a slice of 0.17 m is 1e-4 of rho, 1e-3 near the crown
  EXPECT_NEAR(report.volume, *report.shell_volume, 3e-3 * report.volume);
  std::tuple previous{-2, -1};
  for (const Block& block : bricks.blocks) {
    const std::tuple place{block.ring, block.slot};
    EXPECT_LT(previous, place) << "blocks follow in the order of courses and places";
    previous = place;
  }
}

// The intrados of a sail of the octagon is the cylinder (x / c + e)^2 + z^2 = R^2 with x across the sail.
TEST_P(BrickModel, LiesOnTheIntradosOfTheSurface) {
  const bool is_octagon = std::get<0>(GetParam());
  const Assembly bricks = cut_assembly(scene());
  for (int f = 0; f < bricks.num_faces(); ++f) {
    if (bricks.face_kinds[f] != FaceKind::intrados) continue;
    for (const Vec3& p : face_points(bricks, f)) {
      const double azimuth = std::atan2(p.y(), p.x());
      if (azimuth < -1e-9 || azimuth > pi / 4 + 1e-9) continue;  // held ends, in the next sail
      const double across = p.x() * std::cos(pi / 8) + p.y() * std::sin(pi / 8);
      const double rho = is_octagon ? across / std::cos(pi / 8) : std::hypot(p.x(), p.y());
      EXPECT_NEAR(std::hypot(rho + e, p.z()), R, 1e-13 * R);
    }
  }
}

std::string brick_name(const testing::TestParamInfo<std::tuple<bool, int, double>>& param_info) {
  constexpr const char* kBonds[] = {"running", "right", "left", "both"};
  const auto [is_octagon, bond, height] = param_info.param;
  return fmt::format("{}_{}_{:.0f}_dm", is_octagon ? "octagon" : "dome", kBonds[bond + 1], 10.0 * height);
}

INSTANTIATE_TEST_SUITE_P(Heights, BrickModel,
                         testing::Combine(testing::Bool(), testing::Values(-1, 0, 1, 2),
                                          testing::Values(7.0, 22.5, 32.0)),
                         brick_name);

/// Volume, kind, label, course and azimuth of every block, in the order of azimuths.
std::map<std::tuple<int, long>, std::tuple<BlockKind, bool, int, double>> places(const Assembly& assembly,
                                                                                 bool mirrored) {
  std::map<std::tuple<int, long>, std::tuple<BlockKind, bool, int, double>> out;
  for (const Block& b : assembly.blocks) {
    if (b.fixed) continue;
    const double azimuth = std::atan2(b.centroid.y(), b.centroid.x());
    const double place = mirrored ? pi / 4 - azimuth : azimuth;
    out[{b.ring, std::lround(1e9 * place)}] = {b.kind, b.truncated, b.num_rings, 1e9 * b.volume};
  }
  return out;
}

TEST(Window, LeftIsTheMirrorImageOfRight) {
  for (const int embedment : {-1, 1})
    for (const Surface& surface : {dome(), octagon()}) {
      const Assembly right =
          cut_assembly(window_case(surface, brick_herringbone(Chirality::right, embedment)));
      const Assembly left = cut_assembly(window_case(surface, brick_herringbone(Chirality::left, embedment)));
      const auto r = places(right, false), l = places(left, true);
      ASSERT_EQ(r.size(), right.blocks.size() - 3);
      ASSERT_EQ(r.size(), l.size());
      for (auto i = r.begin(), j = l.begin(); i != r.end(); ++i, ++j) {
        EXPECT_EQ(std::get<0>(i->first), std::get<0>(j->first));
        EXPECT_NEAR(std::get<1>(i->first), std::get<1>(j->first), 1);  // 1e-9 rad, rounded
        const auto& [kind, cut, rings, volume] = i->second;
        const auto& [kind_l, cut_l, rings_l, volume_l] = j->second;
        EXPECT_TRUE(kind == kind_l && cut == cut_l && rings == rings_l);
        EXPECT_NEAR(volume, volume_l, 1e-9 * volume);
      }
    }
}

// Where spirals cross, the cells of uprights are those of the right-hand ones and those of the left-hand
// ones.
TEST(Window, CrossingPairCoversTheCellsOfBothHands) {
  const auto upright = [](Chirality chirality) {
    const BondPattern bond =
        make_storeys(window_case(octagon(), brick_herringbone(chirality)).geometry).back().bond;
    std::vector<bool> cells;
    for (int block : bond.block_of) cells.push_back(bond.blocks[block].kind == BlockKind::herringbone);
    return cells;
  };
  const auto right = upright(Chirality::right), left = upright(Chirality::left),
             both = upright(Chirality::both);
  ASSERT_EQ(right.size(), both.size());
  int crossings = 0;
  for (size_t i = 0; i < both.size(); ++i) {
    EXPECT_EQ(both[i], right[i] || left[i]) << i;
    crossings += right[i] && left[i];
  }
  EXPECT_GT(crossings, 0);
}

// The bond is that of a ring, cut where the window ends. On a sail every course has a block across the
// corner, a quarter and three quarters of which remain; on the dome odd courses have one.
TEST(Window, CutsAndMarksTheBlocksAcrossItsEnds) {
  for (const bool is_octagon : {false, true}) {
    const Assembly bricks =
        cut_assembly(window_case(is_octagon ? octagon() : dome(), RunningBond{4, kBricks, 4}));
    std::map<int, std::vector<const Block*>> courses;
    for (const Block& block : bricks.blocks)
      if (!block.fixed) courses[block.ring].push_back(&block);
    for (const auto& [ring, course] : courses) {
      const bool across = is_octagon || ring % 2 == 1;
      ASSERT_EQ(course.size(), across ? kBricks + 1u : kBricks + 0u);
      for (const Block* block : course)
        EXPECT_EQ(block->truncated, across && (block == course.front() || block == course.back()));
    }
  }
}

TEST(Window, WithoutHeldEndsHasFreeHeadsThere) {
  Case c = window_case(dome(), RunningBond{4, kBricks, 2});
  c.geometry.window->ends = Window::Ends::free;
  const Assembly bricks = cut_assembly(c);
  EXPECT_EQ(count_kinds(bricks)[BlockKind::support], 1);
  int free_heads = 0;
  for (const Part& part : bricks.parts)
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f)
      free_heads += part.ring >= 0 && bricks.face_kinds[f] == FaceKind::free;
  EXPECT_EQ(free_heads, 2 * 4);
}

void expect_error(const Case& c, const std::string& phrase) {
  try {
    make_storeys(c.geometry);
    FAIL() << "no error: " << phrase;
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find(phrase), std::string::npos) << error.what();
  }
}

TEST(Window, RefusesCoursesBeyondTheShell) {
  expect_error(window_case(dome(), RunningBond{21, kBricks, 2}, 1.0), "reach below the springing");
  expect_error(window_case(octagon(), RunningBond{21, kBricks, 2}, 33.0), "must be below the crown");
  Case c = window_case(octagon(), RunningBond{41, kBricks, 2}, 32.5);
  c.geometry.stage = Stage{21};
  expect_error(c, "reach above the crown");
  HerringboneBond crowded = brick_herringbone(Chirality::both);
  crowded.spirals = 40;
  expect_error(window_case(dome(), crowded), "do not fit");
}

}  // namespace
}  // namespace cupola::window_test

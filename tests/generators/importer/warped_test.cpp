#include <cmath>
#include <filesystem>
#include <fstream>
#include <random>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "generators/generate.hpp"
#include "generators/importer/polygon_triangles.hpp"
#include "tests/generators/shared_data.hpp"

namespace cupola::warped_test {
namespace {

/// A vault of 400 stones.
Case vault(const Surface& surface) {
  Case c;
  c.geometry.surface = surface;
  c.geometry.bond = RunningBond{10, 40, 2, {}};
  return c;
}

/// Mean size of the free stones, m.
double stone_size(const Assembly& model) {
  double volume = 0.0;
  int count = 0;
  for (const Block& block : model.blocks)
    if (!block.fixed) {
      volume += block.volume;
      ++count;
    }
  return std::cbrt(volume / count);
}

Vec3 random_vector(std::mt19937* random, double length) {
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  Vec3 v;
  do v = Vec3(uniform(*random), uniform(*random), uniform(*random));
  while (v.norm() > 1.0);
  return length * v;
}

/// How the corners of the stones are moved.
enum class Noise { shared, of_each_stone };

/// The free blocks of a model as an OBJ file. Each corner is moved by up to `noise` (m); polygons start at a
/// random corner.
std::string warped_obj(const Assembly& model, double noise, Noise kind, int decimals) {
  std::mt19937 random(5);
  std::vector<Vec3> moved = model.vertices;
  for (Vec3& v : moved) v += random_vector(&random, noise);
  std::string text;
  int count = 0;
  std::map<int, int> id;  // in the file
  for (size_t p = 0; p < model.parts.size(); ++p) {
    const Part& part = model.parts[p];
    if (model.blocks[part.block].fixed) continue;
    if (p == 0 || model.parts[p - 1].block != part.block) {
      text += fmt::format("o stone {}\n", part.block);
      id.clear();
    }
    std::string faces;
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f) {
      if (model.face_kinds[f] == FaceKind::internal) continue;
      const auto ids = model.face(f);
      const size_t first = random() % ids.size();
      faces += "f";
      for (size_t i = 0; i < ids.size(); ++i) {
        const int v = ids[(first + i) % ids.size()];
        const auto [it, is_new] = id.try_emplace(v, count + 1);
        if (is_new) {
          ++count;
          const Vec3 x =
              kind == Noise::shared ? moved[v] : Vec3(model.vertices[v] + random_vector(&random, noise));
          text +=
              fmt::format("v {:.{}f} {:.{}f} {:.{}f}\n", x.x(), decimals, x.y(), decimals, x.z(), decimals);
        }
        faces += fmt::format(" {}", it->second);
      }
      faces += "\n";
    }
    text += faces;
  }
  return text;
}

/// Blocks of a file without any option but the support.
Assembly imported(const std::string& path, double fixed_below, GenerateReport* report) {
  Case c;
  c.geometry.imported.emplace();
  c.geometry.imported->path = path;
  c.geometry.imported->fixed_below = fixed_below;
  return generate(c, report);
}

Assembly imported_text(const std::string& obj, GenerateReport* report) {
  const auto folder = std::filesystem::temp_directory_path() / ("cupola_warped_" + std::to_string(getpid()));
  std::filesystem::create_directories(folder);
  const std::string path = (folder / "vault.obj").string();
  std::ofstream(path) << obj;
  constexpr double kLowestRing = 2.0;  // m
  Assembly assembly = imported(path, kLowestRing, report);
  std::filesystem::remove_all(folder);
  return assembly;
}

/// Imports the stones of a vault as they are and with corners moved by 1e-3 of their size, and compares.
/// `plane_blocks`: each face of a stone is one polygon.
void expect_same_vault(const Surface& surface, Noise kind, int decimals, bool plane_blocks = true) {
  const Assembly model = cut_assembly(vault(surface));
  const double size = stone_size(model), noise = 1e-3 * size;
  GenerateReport exact, warped;
  const Assembly plain = imported_text(warped_obj(model, 0.0, kind, 17), &exact);
  const Assembly found = imported_text(warped_obj(model, noise, kind, decimals), &warped);
  ASSERT_EQ(found.blocks.size(), 400u);
  if (plane_blocks) {
    EXPECT_EQ(warped.model.num_joints, exact.model.num_joints);
  }
  EXPECT_EQ(warped.model.islands, 1);
  EXPECT_TRUE(warped.model.blocks_without_joint.empty());
  // Each face moves by at most the noise, or half of `snap` where it is moved to the plane of its neighbour.
  const double area = 10.0 * size * size;
  for (size_t b = 0; b < found.blocks.size(); ++b)
    EXPECT_NEAR(found.blocks[b].volume, plain.blocks[b].volume, 2.0 * noise * area) << found.blocks[b].name;
  // Two corners of one joint are at most two noises apart, and a facet of several polygons twice as much.
  if (plane_blocks) {
    EXPECT_LT(warped.model.max_overlap, 4.0 * noise);
    EXPECT_LT(warped.model.max_joint_gap, 4.0 * noise);
  }
  EXPECT_LT(warped.model.max_planarity_error, 1e-9 * size) << "parts are bounded by planes";
  // A corner of a rectangle of two by three points is up to 1.5 noises from their plane of least squares, the
  // largest row sum of identity minus hat matrix. One of two by two points is up to one noise from it.
  EXPECT_LE(warped.import->flatness.warp, 1.5 * noise);
  EXPECT_GT(warped.import->flatness.warp, 0.2 * noise);
  EXPECT_GT(warped.import->snapped_facets, 800);
  EXPECT_NE(to_text(warped).find("chosen from that"), std::string::npos) << to_text(warped);
}

OctagonalVault planar_vault() {
  OctagonalVault vault;
  vault.construction = OctagonalVault::Construction::planar_radial;
  return vault;
}

TEST(WarpedVault, ImportsWithoutEditing) {
  expect_same_vault(planar_vault(), Noise::shared, 6);
}

// Stones of the dome and the circular octagon have faces of several polygons. They import and connect, but
// with gaps of up to 8 times the noise, and the octagon loses up to 16 of its 1,120 joints, small ones: both
// are larger than they should be.
TEST(WarpedVaultSlow, OfEveryShapeAndNoiseImportsWithoutEditing) {
  for (const Surface& surface : {Surface(DomeSurface{}), Surface(OctagonalVault{}), Surface(planar_vault())})
    for (const Noise kind : {Noise::shared, Noise::of_each_stone}) {
      SCOPED_TRACE(fmt::format("surface {}, noise {}", surface.index(), static_cast<int>(kind)));
      const auto* vault = std::get_if<OctagonalVault>(&surface);
      const bool planar = vault && vault->construction == OctagonalVault::Construction::planar_radial;
      expect_same_vault(surface, kind, 6, planar);
    }
}

// Rounded to centimetres, in a model with stones of 3 m.
TEST(WarpedVaultSlow, RoundedToFewDigitsImportsWithoutEditing) {
  const Assembly model = cut_assembly(vault(planar_vault()));
  GenerateReport report;
  EXPECT_EQ(imported_text(warped_obj(model, 0.0, Noise::shared, 2), &report).blocks.size(), 400u);
  EXPECT_EQ(report.model.islands, 1);
}

TEST(ExactModel, KeepsItsTolerances) {
  GenerateReport report;
  imported_text(warped_obj(cut_assembly(vault(planar_vault())), 0.0, Noise::shared, 17), &report);
  EXPECT_EQ(report.import->facet_angle, 1e-6);
  EXPECT_LT(report.import->snap, 1e-9);
}

// Models from other projects, if available: every one imports without options.
TEST(SharedData, ImportsWithoutOptions) {
  if (shared_data().empty()) GTEST_SKIP() << "no shared data";
  for (const auto& entry : std::filesystem::recursive_directory_iterator(shared_data())) {
    const std::string ending = entry.path().extension();
    if (ending != ".obj" && ending != ".json") continue;
    GenerateReport report;
    EXPECT_NO_THROW(imported(entry.path().string(), -1e9, &report)) << entry.path();
    EXPECT_EQ(report.import->by_nef, 0) << entry.path();
  }
}

// The same triangles, whichever corner a polygon starts at and from whichever side it is seen.
TEST(PolygonTriangles, AreThoseOfTheReversedPolygon) {
  std::mt19937 random(3);
  for (int n = 4; n <= 9; ++n) {
    std::vector<Vec3> polygon;
    for (int i = 0; i < n; ++i) {
      const double a = 2.0 * M_PI * i / n, r = i % 2 ? 0.4 : 1.0;  // a star, with reflex corners
      polygon.push_back(Vec3(r * std::cos(a), r * std::sin(a), 0.0) + random_vector(&random, 1e-3));
    }
    const auto corners_of = [](const std::vector<Vec3>& p) {
      std::set<std::set<std::array<double, 3>>> triangles;
      for (const auto& t : triangulate_polygon(p)) {
        std::set<std::array<double, 3>> corners;
        for (int i : t) corners.insert({p[i].x(), p[i].y(), p[i].z()});
        triangles.insert(corners);
      }
      return triangles;
    };
    const auto triangles = corners_of(polygon);
    EXPECT_EQ(triangles.size(), static_cast<size_t>(n) - 2);
    std::rotate(polygon.begin(), polygon.begin() + 2, polygon.end());
    EXPECT_EQ(corners_of(polygon), triangles);
    std::reverse(polygon.begin(), polygon.end());
    EXPECT_EQ(corners_of(polygon), triangles);
  }
}

// A square with a square hole, as one polygon with a bridge between both, which it passes in both directions.
TEST(PolygonTriangles, LeaveAHoleOpen) {
  std::vector<Vec3> polygon{{0, 0, 0}, {3, 0, 0}, {3, 3, 0}, {0, 3, 0}, {0, 0, 0},
                            {1, 1, 0}, {1, 2, 0}, {2, 2, 0}, {2, 1, 0}, {1, 1, 0}};
  for (int side = 0; side < 2; ++side) {
    double area = 0.0;
    for (const auto& t : triangulate_polygon(polygon)) {
      const Vec3 twice = (polygon[t[1]] - polygon[t[0]]).cross(polygon[t[2]] - polygon[t[0]]);
      EXPECT_GT(twice.z() * (side == 0 ? 1.0 : -1.0), 0.0);
      area += 0.5 * twice.norm();
    }
    EXPECT_NEAR(area, 8.0, 1e-12);
    std::ranges::reverse(polygon);
  }
}

// A fan from the first corner of this warped polygon crosses itself; its Delaunay triangles do not.
TEST(PolygonTriangles, DoNotCrossWhereAFanDoes) {
  const std::vector<Vec3> polygon{{0, 0, 0}, {1, 0.001, 0}, {2, 0, 0.002}, {2, 1, 0}, {0, 1, 0.001}};
  double area = 0.0;
  const Vec3 up = polygon_plane(polygon).normal;
  for (const auto& t : triangulate_polygon(polygon)) {
    const double own = 0.5 * (polygon[t[1]] - polygon[t[0]]).cross(polygon[t[2]] - polygon[t[0]]).dot(up);
    EXPECT_GT(own, 0.0);
    area += own;
  }
  EXPECT_NEAR(area, polygon_area(polygon), 1e-12);
  EXPECT_TRUE(triangulate_polygon(std::vector<Vec3>{{0, 0, 0}, {1, 1, 0}, {1, 0, 0}, {0, 1, 0}}).empty())
      << "a polygon that crosses itself has no triangles";
}

}  // namespace
}  // namespace cupola::warped_test

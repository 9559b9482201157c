// Sections drawn as SVG paths: lines, arcs, curves and their transforms against points of the drawn curve;
// errors.

#include "assembly/files/profile_drawing.hpp"

#include <cmath>
#include <fstream>
#include <numbers>

#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "tests/fresh_folder.hpp"

namespace cupola::profile_drawing_test {
namespace {

std::string file_with(const std::string& body) {
  const std::string path = test::fresh_folder("svg") + "/section.svg";
  std::ofstream(path) << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 300 200\">\n"
                      << body << "\n</svg>\n";
  return path;
}

ProfileTable path_of(const std::string& d, double span = 10.0, const std::string& attributes = "") {
  return read_profile_drawing(file_with("<path " + attributes + " d=\"" + d + "\"/>"), span);
}

std::string message_of(const std::string& body) {
  try {
    read_profile_drawing(file_with(body), 10.0);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

/// Largest distance of the points of cubic curves from the ellipse with the half axes a and b about the
/// origin, over a.
double error_on_ellipse(const ProfileTable& t, double a, double b) {
  double most = 0.0;
  for (size_t i = 0; i + 1 < t.r.size(); ++i)
    for (int k = 0; k <= 10; ++k) {
      const double u = k / 10.0, v = 1.0 - u;
      const Eigen::Vector2d p = v * v * v * Eigen::Vector2d(t.r[i], t.z[i]) +
                                3.0 * v * v * u * t.curves[i]->first + 3.0 * v * u * u * t.curves[i]->second +
                                u * u * u * Eigen::Vector2d(t.r[i + 1], t.z[i + 1]);
      most = std::max(most, std::abs(std::hypot(p.x() / a, p.y() / b) - 1.0));
    }
  return most;
}

// A semicircle of 100 units from left to right is one of 10 m, from its right springing to the crown.
TEST(ProfileDrawing, AnArcIsAnArc) {
  const ProfileTable t = path_of("M 20,120 A 50,50 0 0 1 120,120");
  ASSERT_EQ(t.r.size(), 2u);
  EXPECT_EQ(t.r.front(), 5.0);
  EXPECT_EQ(t.r.back(), 0.0);
  EXPECT_EQ(t.z.front(), 0.0);
  EXPECT_NEAR(t.z.back(), 5.0, 1e-12);
  EXPECT_NEAR(t.radius.front(), 5.0, 1e-12);
  EXPECT_FALSE(t.curves.front());
}

// The same with relative and implicit commands, from the other end, as one half, turned, moved and mirrored.
TEST(ProfileDrawing, TheWayOfDrawingDoesNotMatter) {
  for (const ProfileTable& t :
       {path_of("m120 120a50 50 0 0 0-100 0"), path_of("M 120,120 A 50,50 0 0 0 70,70"),
        path_of("M 70,70 A 50,50 0 0 0 20,120"),
        path_of("M 0,0 A 50,50 0 0 1 100,0", 10.0, "transform=\"translate(7 3) scale(-2 2)\""),
        path_of("M 0,0 A 50,50 0 0 1 0,100", 10.0, "transform=\"rotate(-90)\"")}) {
    EXPECT_EQ(t.r.front(), 5.0);
    EXPECT_NEAR(t.z.back(), 5.0, 1e-12);
    for (size_t i = 0; i + 1 < t.r.size(); ++i) EXPECT_NEAR(t.radius[i], 5.0, 1e-12);
  }
}

TEST(ProfileDrawing, EllipsesAreCurvesThatFollowThem) {
  // pi/16 per curve: the classical bound 2/27 ((1 - cos h) / (1 + cos h))^3 sin^2 ... is below 1e-9 there.
  EXPECT_LT(error_on_ellipse(path_of("M 100,0 A 100,40 0 0 0 0,-40", 20.0), 10.0, 4.0), 1e-8);
  EXPECT_LT(error_on_ellipse(path_of("M 100,0 A 100,100 0 0 0 0,-100", 20.0, "transform=\"scale(1 0.4)\""),
                             10.0, 4.0),
            1e-8)
      << "a circle drawn in a stretched layer";
}

TEST(ProfileDrawing, LinesAndCurvesKeepTheirOrder) {
  const ProfileTable t = path_of("M 50,0 V -20 C 50,-40 20,-60 0,-70", 10.0);
  ASSERT_EQ(t.r.size(), 3u);
  EXPECT_NEAR(t.z[1], 2.0, 1e-14);
  EXPECT_EQ(t.radius[0], 0.0);
  EXPECT_FALSE(t.curves[0]);
  ASSERT_TRUE(t.curves[1]);
  EXPECT_NEAR((t.curves[1]->first - Eigen::Vector2d(5.0, 4.0)).norm(), 0.0, 1e-14);
  EXPECT_NEAR((t.curves[1]->second - Eigen::Vector2d(2.0, 6.0)).norm(), 0.0, 1e-14);
}

// A whole pointed section ends at its point, between two strokes, and a whole flat curve in the middle of
// one.
TEST(ProfileDrawing, AWholeSectionIsCutAtItsAxis) {
  const ProfileTable pointed = path_of("M 0,0 A 80,80 0 0 1 50,-62.449979984 A 80,80 0 0 1 100,0");
  ASSERT_EQ(pointed.r.size(), 2u);
  EXPECT_NEAR(pointed.z.back(), 6.2449979984, 1e-9);
  const ProfileTable flat = path_of("M 0,0 C 20,-40 80,-40 100,0");
  ASSERT_EQ(flat.r.size(), 2u);
  EXPECT_NEAR(flat.z.back(), 3.0, 1e-9);
  EXPECT_NEAR(flat.curves[0]->second.y(), 3.0, 1e-9) << "level at the crown";
}

TEST(ProfileDrawing, RefusesWhatIsNoSection) {
  EXPECT_NE(message_of("<rect/>").find("has 0 paths"), std::string::npos);
  EXPECT_NE(message_of("<path d=\"M 0,0 L 1,1\"/><path d=\"M 0,0 L 1,1\"/>").find("has 2 paths"),
            std::string::npos);
  EXPECT_NE(
      message_of("<path d=\"M 0,0 L 1,1 L 2,0 Z\"/>").find("section.svg:2:1: error: its path is closed"),
      std::string::npos);
  EXPECT_NE(message_of("<path d=\"M 0,0 L 1,1 M 2,0 L 3,3\"/>").find("several lines"), std::string::npos);
  EXPECT_NE(message_of("<path d=\"M 0,0 L 1,\"/>").find("cannot be read"), std::string::npos);
  EXPECT_NE(message_of("<path d=\"M 0,0 L 1,1\" transform=\"twist(3)\"/>").find("transform twist(3)"),
            std::string::npos);
  EXPECT_NE(message_of("<path d=\"M 0,0 L 20,-40 L 100,0\"/>").find("its halves differ"), std::string::npos);
  EXPECT_NE(message_of("<path d=\"M 0,0 L 20,-40 L 40,-10\"/>").find("springings at two heights"),
            std::string::npos);
  EXPECT_NE(message_of("<path d=\"M 0,0 L 0,-40\"/>").find("the span would be 0"), std::string::npos);
  EXPECT_NE(message_of("<path").find("no SVG drawing"), std::string::npos);
}

std::string refusal_of_heading(const std::string& heading) {
  const std::string path = test::fresh_folder("csv") + "/section.csv";
  std::ofstream(path) << heading << "\n2,0\n1.5,1.3\n0,2\n";
  try {
    EXPECT_EQ(read_profile_table(path).z, (std::vector<double>{0.0, 1.3, 2.0})) << heading;
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

// Columns are read by their place.
TEST(ProfileTable, HasItsColumnsInTheOrderOfItsHeading) {
  for (const char* heading :
       {"# r, z", "r,z", "r z radius", "r (m), z (m), radius (m)", "\"r_m\",\"z_m\"", "r\tz"})
    EXPECT_EQ(refusal_of_heading(heading), "") << heading;
  for (const char* heading : {"z,r", "z,r,radius", "r,radius,z", "x,y", "r", "r,z,radius,name"})
    EXPECT_NE(refusal_of_heading(heading).find(
                  "section.csv:1:1: error: the columns must be r, z and perhaps radius"),
              std::string::npos)
        << heading << ": " << refusal_of_heading(heading);
}

}  // namespace
}  // namespace cupola::profile_drawing_test

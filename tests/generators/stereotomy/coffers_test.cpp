// The bundled round dome with coffers inside and steps outside, against its volume in closed form.

#include <array>
#include <cmath>
#include <map>
#include <numbers>

#include <gtest/gtest.h>

#include "assembly/case/case_reader.hpp"
#include "tests/generators/models.hpp"

namespace cupola::coffers_test {
namespace {

constexpr int kCourses = 28, kSectors = 28;  // of the case
constexpr double kRadius = 43.3 / 2.0, kCrown = 78.0 * std::numbers::pi / 180.0;

/// Integral of the distance from the axis over the section of course k between two radii: a trapezium with
/// straight sides.
double section_moment(int k, double inside, double outside) {
  std::array<Eigen::Vector2d, 4> p;
  for (int i = 0; i < 4; ++i) {
    const double t = kCrown * (k + (i >= 2 ? 1 : 0)) / kCourses, r = i == 0 || i == 3 ? inside : outside;
    p[i] = r * Eigen::Vector2d(std::cos(t), std::sin(t));
  }
  double moment = 0.0;
  for (int i = 0; i < 4; ++i) {
    const Eigen::Vector2d &a = p[i], &b = p[(i + 1) % 4];
    moment += (a.x() + b.x()) * (a.x() * b.y() - a.y() * b.x()) / 6.0;
  }
  return moment;
}

/// Of the slices between given shares of a sector: a slice whose sides are an angle phi apart and whose faces
/// are plane between them sweeps the volume sin(phi) times the moment of its section.
double sweep(std::initializer_list<double> cuts) {
  double sum = 0.0, last = std::nan("");
  for (const double cut : cuts) {
    if (!std::isnan(last)) sum += std::sin((cut - last) * 2.0 * std::numbers::pi / kSectors);
    last = cut;
  }
  return kSectors * sum;
}

TEST(Coffers, AndStepsHaveTheVolumeOfTheirCells) {
  const Case scene = read_case(CUPOLA_SOURCE_DIR "/cases/pantheon.yaml");
  ModelReport report;
  const Assembly assembly = check_and_report(scene, &report);
  EXPECT_LT(report.max_overlap, 1e-9);
  EXPECT_EQ(report.islands, 1);

  const double whole = sweep({0.0, 0.15, 0.5, 0.85, 1.0}), ribs = 2.0 * sweep({0.0, 0.15});
  const double top[] = {17.0, 14.0, 11.5, 9.0, 6.5};  // m, of the steps
  double expected = 0.0;
  int between = 0;
  for (int k = 0; k < kCourses; ++k) {
    const double height = kRadius * std::sin(kCrown * (k + 0.5) / kCourses);
    const bool coffered = height >= 3.0 && height < 19.0;
    const bool band = coffered && between++ % 4 == 3;
    double outside = kRadius + 0.5;
    expected += (coffered && !band ? ribs : whole) * section_moment(k, kRadius, outside);
    expected += whole * section_moment(k, outside, outside + 0.8);
    outside += 0.8;
    for (int step = 0; step < 5 && height < top[step]; ++step, outside += 1.0)
      expected += whole * section_moment(k, outside, outside + 1.0);
  }
  EXPECT_NEAR(report.volume / expected, 1.0, 1e-12);  // rounding
}

}  // namespace
}  // namespace cupola::coffers_test

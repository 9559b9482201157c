// Joints with strength: one rectangular bed, and arches.

#include <array>
#include <cmath>
#include <numbers>

#include "tests/solver/motion_scenes.hpp"
#include "tests/verification/solve.hpp"
#include "tests/verification/verification_row.hpp"

namespace cupola::verification {
namespace {

using Parameter = LimitSearch::Parameter;
using testing::kG;

Case strong_case(Case scene, const JointStrength& strength, int subdivide) {
  scene.joints.compliance = {1e-10, 1e-10, Compliance::Per::area};
  scene.joints.strength = strength;
  scene.contact.subdivide = subdivide;
  scene.analysis.plane = true;
  return scene;
}

/// A point of the interaction surface of a bed of kWidth x kDepth under the weight N of its block: plastic
/// stress blocks of the push F over `compressed` and of the pull f over the rest,
///
///     N = F b x - f b (t - x),   M = b x (t - x) (F + f) / 2,   V = c A + mu N
///
/// M and V do not depend on each other, because every point can slide at its normal force.
struct BedLimit {
  static constexpr double kWidth = 1.0, kDepth = 0.5, kHeight = 0.2, kFriction = 0.6;  // m; t, b
  double compressed;                                                                   // x, m
  double pull_over_push;                                                               // f / F
  double cohesion_over_push = 0.4;

  double normal() const { return 1000.0 * kWidth * kDepth * kHeight * kG; }
  double push() const { return normal() / (kDepth * (compressed - pull_over_push * (kWidth - compressed))); }
  double moment() const {
    return 0.5 * kDepth * compressed * (kWidth - compressed) * (1.0 + pull_over_push) * push();
  }
  double shear() const { return cohesion_over_push * push() * kWidth * kDepth + kFriction * normal(); }
};

/// Error of the largest s for which the bed carries N, s V cos(angle) and s M sin(angle).
double error_of_bed(const BedLimit& bed, double angle, int subdivide) {
  const double push = bed.push();
  Case scene = strong_case(limit_case(Parameter::load, 0.0, 2.0, BedLimit::kFriction),
                           {bed.pull_over_push * push, bed.cohesion_over_push * push, push}, subdivide);
  const auto add = [&](const Vec3& point, const Vec3& force) {
    scene.loads.forces.push_back({BlockRef{1}, point, force, {}});
  };
  const double couple = bed.moment() * std::sin(angle) / BedLimit::kWidth;
  add(Vec3::Zero(), {bed.shear() * std::cos(angle), 0, 0});
  add({0.5 * BedLimit::kWidth, 0, 0}, {0, 0, -couple});
  add({-0.5 * BedLimit::kWidth, 0, 0}, {0, 0, couple});
  const double exact = 1.0 / std::max(std::cos(angle), std::sin(angle));
  const Assembly box = testing::box_on_floor({BedLimit::kWidth, BedLimit::kDepth, BedLimit::kHeight});
  return critical_value(scene, box) / exact - 1.0;
}

/// Largest error of the surface without tension, or with a tension of a fifth of the compressive strength.
double error_of_surface(double pull_over_push, int subdivide) {
  double largest = 0.0;
  for (const double compressed : {0.21, 0.27, 0.31, 0.37, 0.45, 0.5, 0.61})
    for (const double degrees : {0.0, 30.0, 60.0, 90.0}) {
      const double angle = degrees * std::numbers::pi / 180.0;
      const double error = error_of_bed({compressed, pull_over_push}, angle, subdivide);
      largest = std::max(largest, std::abs(error));
    }
  return largest;
}

/// Largest error of the moment over compressed zones that are narrow beside a piece, or not.
double error_of_narrow_zones(int subdivide) {
  double largest = 0.0;
  for (const double pieces : {0.08, 1.0 / 6.0, 0.25, 0.35, 0.43, 0.5, 0.6, 1.0, 1.7}) {
    const double compressed = pieces / subdivide;
    if (compressed > 0.5) continue;
    largest = std::max(largest, std::abs(error_of_bed({compressed, 0.0}, 0.5 * std::numbers::pi, subdivide)));
  }
  return largest;
}

/// Minus the slope of log(error) over log(subdivide), by least squares.
double order_of_surface(double pull_over_push) {
  constexpr std::array kSubdivide{1, 2, 4, 8};
  double x = 0.0, y = 0.0, xx = 0.0, xy = 0.0;
  for (const int n : kSubdivide) {
    const double log_n = std::log(n), log_error = std::log(error_of_surface(pull_over_push, n));
    x += log_n / kSubdivide.size();
    y += log_error / kSubdivide.size();
    xx += log_n * log_n / kSubdivide.size();
    xy += log_n * log_error / kSubdivide.size();
  }
  return -(xy - x * y) / (xx - x * x);
}

double least_thickness_with_strength(const ReferenceRow& row) {
  constexpr double kDensity = 1000.0, kRadius = 1.0;  // kg/m3, m
  const double strength = row.number("strength") * kDensity * kG * kRadius;
  const double thickness = 1.1 * row.expected();
  const Case scene = strong_case(limit_case(Parameter::thickness, 0.6, 1.4, 0.8), {.compression = strength},
                                 row.integer("subdivide"));
  return thickness * critical_value(scene, testing::make_arch({.thickness = thickness, .density = kDensity}));
}

}  // namespace

void add_strength_rows(Computations* all) {
  Computations& rows = *all;
  rows["bed_strength"] = [](const ReferenceRow& row) {
    return error_of_surface(row.number("tension"), row.integer("subdivide"));
  };
  rows["bed_strength_order"] = [](const ReferenceRow& row) {
    return order_of_surface(row.number("tension"));
  };
  rows["bed_narrow_zone"] = [](const ReferenceRow& row) {
    return error_of_narrow_zones(row.integer("subdivide"));
  };
  rows["arch_strength"] = least_thickness_with_strength;
}

}  // namespace cupola::verification

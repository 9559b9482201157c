#pragma once

#include <array>
#include <cmath>
#include <numbers>

#include "tests/solver/motion_scenes.hpp"

namespace cupola::testing {

constexpr double kGamma = 18000.0;  // N/m3, weight of brickwork
constexpr int kFirstCourse = 5;

/// Courses of bricks on a bed whose slope gravity gives (tilted_gravity): x up to down the slope, y along the
/// course, z normal to the bed. Ring 0 is one free block, a slab with, on request, an upright as high as all
/// courses at both ends of the clear length; the courses above are rings kFirstCourse, kFirstCourse + 1, ...
/// in stack bond, so that the slab has hardened. Blocks: fixed floor, slab, bricks course by course along y.
struct CourseSpec {
  int bricks = 3, courses = 1;
  double length = 0.34;  ///< of a brick, along the course, m
  double depth = 0.34;   ///< d, m
  double height = 0.05;  ///< h, m
  bool uprights = false;
};

inline Assembly make_course(const CourseSpec& spec) {
  const double density = kGamma / kG, clear = spec.bricks * spec.length, slab = 0.1;
  Assembly assembly;
  assembly.title = "course";
  add_box({.center = {0, 0.5 * clear, -1.5 * slab}, .size = {2.0, clear + 2.0, slab}, .fixed = true},
          &assembly);
  const BoxSpec base{.center = {0, 0.5 * clear, -0.5 * slab},
                     .size = {spec.depth, clear + 1.0, slab},
                     .density = density,
                     .ring = 0};
  add_block(base, &assembly);
  add_box_part(base, false, false, &assembly);
  if (spec.uprights)
    for (const double y : {-0.05, clear + 0.05}) {
      const double high = spec.courses * spec.height;
      add_box_part({.center = {0, y, 0.5 * high}, .size = {spec.depth, 0.1, high}}, false, false, &assembly);
    }
  for (int k = 0; k < spec.courses; ++k)
    for (int j = 0; j < spec.bricks; ++j)
      add_box({.center = {0, (j + 0.5) * spec.length, (k + 0.5) * spec.height},
               .size = {spec.depth, spec.length, spec.height},
               .density = density,
               .ring = kFirstCourse + k},
              &assembly);
  assembly.num_rings = kFirstCourse + spec.courses;
  compute_mass_properties(&assembly);
  return assembly;
}

/// Adds sector k of n of a body of revolution about z, with radial heads: a prism over the meridian
/// quadrilateral (r, z), whose sides 0-1, 1-2, 2-3, 3-0 are lower bed, extrados, upper bed and intrados.
inline void add_sector(const std::array<Eigen::Vector2d, 4>& meridian, int k, int n, bool fixed, int ring,
                       Assembly* assembly) {
  add_block({.density = kGamma / kG, .fixed = fixed, .ring = ring}, assembly);
  assembly->blocks.back().slot = k;
  const double half = std::numbers::pi / n, azimuth = 2.0 * half * k;
  const Vec3 radial(std::cos(azimuth), std::sin(azimuth), 0), along(-radial.y(), radial.x(), 0);
  std::array<Vec3, 4> start, end;
  for (size_t i = 0; i < 4; ++i) {
    const Vec3 middle = meridian[i].x() * radial + meridian[i].y() * Vec3::UnitZ();
    const Vec3 width = meridian[i].x() * std::tan(half) * along;
    start[i] = middle - width;
    end[i] = middle + width;
  }
  add_prism_part(start, end, FaceKind::head, assembly);
}

/// One course on a bed that falls towards the axis at theta, with radial heads. Ring 0: the n blocks of the
/// bed and, on request, every second block of the course, as an upright; ring 1: the (other) blocks of the
/// course. No block is fixed: hold ring 0 by hold_below.
struct RingSpec {
  int n = 12;
  double theta = 0.0, radius = 3.0;  ///< rad; m, of the middle of the bed
  double depth = 0.34, height = 0.05;
  bool uprights = false;

  std::array<Eigen::Vector2d, 4> meridian(double low, double high) const {
    const Eigen::Vector2d middle(radius, 0), up_slope(std::cos(theta), std::sin(theta)),
        normal(-std::sin(theta), std::cos(theta));
    const Eigen::Vector2d half = 0.5 * depth * up_slope;
    return {middle - half + low * normal, middle + half + low * normal, middle + half + high * normal,
            middle - half + high * normal};
  }
};

inline Assembly make_ring(const RingSpec& spec) {
  Assembly assembly;
  assembly.title = "ring";
  for (int k = 0; k < spec.n; ++k) add_sector(spec.meridian(-0.1, 0.0), k, spec.n, false, 0, &assembly);
  for (int k = 0; k < spec.n; ++k)
    add_sector(spec.meridian(0.0, spec.height), k, spec.n, false, spec.uprights && k % 2 == 0 ? 0 : 1,
               &assembly);
  assembly.num_rings = 2;
  compute_mass_properties(&assembly);
  return assembly;
}

/// Spherical dome with its middle surface of the radius, from the equator (z = 0) upwards: `rings` rings of n
/// blocks over equal angles of `step`, on a fixed ring.
inline Assembly make_sphere(double radius, double thickness, double step, int rings, int n) {
  Assembly assembly;
  assembly.title = "sphere";
  const auto point = [](double r, double angle) -> Eigen::Vector2d {
    return r * Eigen::Vector2d(std::cos(angle), std::sin(angle));
  };
  const double inner = radius - 0.5 * thickness, outer = radius + 0.5 * thickness;
  for (int k = 0; k < n; ++k)
    add_sector({Eigen::Vector2d(inner, -0.5), {outer, -0.5}, {outer, 0.0}, {inner, 0.0}}, k, n, true, -1,
               &assembly);
  for (int ring = 0; ring < rings; ++ring)
    for (int k = 0; k < n; ++k) {
      const double low = ring * step, high = low + step;
      add_sector({point(inner, low), point(outer, low), point(outer, high), point(inner, high)}, k, n, false,
                 ring, &assembly);
    }
  assembly.num_rings = rings;
  compute_mass_properties(&assembly);
  return assembly;
}

/// Joints without tension, with friction and, if given, cohesion (Pa).
inline JointLawChange joint_law(double friction, double cohesion = 0.0) {
  JointLawChange law;
  law.friction = friction;
  law.cohesion = cohesion;
  law.tension = 0.0;
  return law;
}

/// Staged construction of such courses, block by block with carried state, under Coulomb's law. Hardened
/// joints are glued.
inline Case course_case(double theta, double fresh_friction) {
  Case scene;
  scene.loads.gravity = tilted_gravity(std::tan(theta));
  scene.joints.compliance = {1e-10, 2.4e-10, Compliance::Per::area};
  scene.joints.friction = 0.6;
  scene.joints.strength = {.tension = 1e5, .cohesion = 1e5};
  Analysis& analysis = scene.analysis;
  analysis.type = AnalysisType::staged;
  analysis.friction_law = FrictionLaw::coulomb;
  analysis.tolerance = 1e-6;
  StagedConstruction& staged = analysis.staged;
  staged.unit = StagedConstruction::Unit::block;
  staged.carry = true;
  staged.first_ring = kFirstCourse;
  staged.fresh.friction = fresh_friction;
  return scene;
}

/// On level ground, dry joints of compliance `c` per area.
inline Case level_case(double c, bool carry) {
  Case scene = course_case(0.0, 0.4);
  scene.joints.strength = {};
  scene.joints.compliance = {c, c, Compliance::Per::area};
  scene.analysis.staged.first_ring = 0;
  scene.analysis.staged.carry = carry;
  return scene;
}

}  // namespace cupola::testing

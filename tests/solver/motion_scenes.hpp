#pragma once

#include <cmath>
#include <numbers>

#include "solver/dynamics/scene_options.hpp"
#include "solver/dynamics/simulation.hpp"
#include "tests/solver/scenes.hpp"

namespace cupola::testing {

constexpr double kG = 9.81;  // m/s2

/// A dynamic case with the given friction, compliance (m/N per point), step and damping (s).
inline Case make_case(double friction, double compliance, double h, double damping = 0.0) {
  Case scene;
  scene.joints.friction = friction;
  scene.joints.compliance = {compliance, compliance, Compliance::Per::point};
  scene.analysis.type = AnalysisType::dynamic;
  scene.analysis.time_step = h;
  scene.analysis.damping = damping;
  scene.analysis.tolerance = 1e-12;
  return scene;
}

inline Simulation simulate(const Case& scene, const Assembly& assembly) {
  return make_simulation(scene, assembly);
}

/// Gravity in the axes of an incline of slope tan(a) that rises towards -x.
inline Vec3 tilted_gravity(double tan_a) {
  const double a = std::atan(tan_a);
  return kG * Vec3(std::sin(a), 0.0, -std::cos(a));
}

/// Adds to the last block a convex part between two quadrilaterals, corner by corner; the first is
/// counter-clockwise seen from outside. The sides 0-1, 1-2, 2-3, 3-0 are bed, extrados, bed, intrados.
inline void add_prism_part(const std::array<Vec3, 4>& front, const std::array<Vec3, 4>& back, FaceKind ends,
                           Assembly* assembly) {
  const int first = static_cast<int>(assembly->vertices.size());
  for (const auto& quad : {front, back})
    assembly->vertices.insert(assembly->vertices.end(), quad.begin(), quad.end());
  Part part;
  part.block = static_cast<int>(assembly->blocks.size()) - 1;
  part.ring = assembly->blocks.back().ring;
  part.face_start = assembly->num_faces();
  assembly->parts.push_back(part);
  const std::array<FaceKind, 4> kinds{FaceKind::bed, FaceKind::extrados, FaceKind::bed, FaceKind::intrados};
  for (int i = 0; i < 4; ++i) {
    const int j = (i + 1) % 4;
    assembly->add_face(std::array{first + i, first + 4 + i, first + 4 + j, first + j}, kinds[i]);
  }
  assembly->add_face(std::array{first, first + 1, first + 2, first + 3}, ends);
  assembly->add_face(std::array{first + 7, first + 6, first + 5, first + 4}, ends);
}

/// Adds a prism along y, from 0 to `width`, over a quadrilateral in the x-z plane that is counter-clockwise
/// seen from -y (add_prism_part()).
inline void add_voussoir(const std::array<Eigen::Vector2d, 4>& quad, double width, double density, bool fixed,
                         int ring, Assembly* assembly) {
  add_block({.density = density, .fixed = fixed, .ring = ring}, assembly);
  std::array<Vec3, 4> front, back;
  for (size_t i = 0; i < 4; ++i) {
    front[i] = {quad[i].x(), 0.0, quad[i].y()};
    back[i] = {quad[i].x(), width, quad[i].y()};
  }
  add_prism_part(front, back, FaceKind::free, assembly);
}

/// Arch of voussoirs with plane faces: centreline radius 1 m, angle of embrace 2 beta about the crown, radial
/// joints, vertices at radii 1 -+ t/2, and a fixed block beyond each springing. Blocks: fixed, voussoirs from
/// x > 0, fixed.
struct ArchSpec {
  int voussoirs = 27;
  double thickness = 0.15;  ///< t/R
  double beta_deg = 90.0;
  double width = 0.3;       ///< along y, m
  double density = 1000.0;  ///< kg/m3
};

inline Assembly make_arch(const ArchSpec& arch) {
  Assembly assembly;
  assembly.title = "arch";
  assembly.num_rings = arch.voussoirs;
  const double beta = arch.beta_deg * std::numbers::pi / 180.0;
  const double step = 2.0 * beta / arch.voussoirs;
  const auto corner = [&](double angle, double radius) {  // angle from the crown, positive towards x
    return Eigen::Vector2d(radius * std::sin(angle), radius * std::cos(angle));
  };
  const double inner = 1.0 - arch.thickness / 2, outer = 1.0 + arch.thickness / 2;
  for (int k = -1; k <= arch.voussoirs; ++k) {
    const double start = beta - k * step, end = start - step;
    const bool fixed = k < 0 || k == arch.voussoirs;
    add_voussoir({corner(start, inner), corner(start, outer), corner(end, outer), corner(end, inner)},
                 arch.width, arch.density, fixed, k, &assembly);
  }
  compute_mass_properties(&assembly);
  return assembly;
}

/// Wall of Ferris and Tin-Loi (2001): running bond with 5 blocks of 0.4 x 0.175 m per course. The first
/// course has whole blocks only, or half blocks at its ends.
inline Assembly ferris_wall(int courses, bool whole_first) {
  const double length = 0.4, height = 0.175;
  std::vector<BoxSpec> boxes{{.center = {1, 0.5, -0.5}, .size = {6, 2, 1}, .fixed = true}};
  for (int c = 0; c < courses; ++c) {
    const bool whole = (c % 2 == 0) == whole_first;
    for (int j = 0; j < (whole ? 5 : 6); ++j) {
      const double low = whole ? j * length : std::max(0.0, (j - 0.5) * length);
      const double high = whole ? (j + 1) * length : std::min(5 * length, (j + 0.5) * length);
      boxes.push_back({.center = {0.5 * (low + high), 0.5, (c + 0.5) * height},
                       .size = {high - low, 1, height},
                       .ring = c});
    }
  }
  return make_boxes(boxes);
}

/// A free block of 1 m, width 1 m at its base, between two fixed ones whose joints lean outward by `lean_deg`
/// from the vertical. Blocks: left wall, right wall, wedge.
inline Assembly wedge_between_walls(double lean_deg) {
  const double slope = std::tan(lean_deg * std::numbers::pi / 180.0);
  Assembly assembly;
  const double foot = 0.5, head = 0.5 + slope;  // x of the joints at the bottom and at the top
  add_voussoir({Eigen::Vector2d{-foot - 2, 0}, {-foot, 0}, {-head, 1}, {-head - 2, 1}}, 1.0, 2000.0, true, 0,
               &assembly);
  add_voussoir({Eigen::Vector2d{foot, 0}, {foot + 2, 0}, {head + 2, 1}, {head, 1}}, 1.0, 2000.0, true, 0,
               &assembly);
  add_voussoir({Eigen::Vector2d{-foot, 0}, {foot, 0}, {head, 1}, {-head, 1}}, 1.0, 2000.0, false, 0,
               &assembly);
  compute_mass_properties(&assembly);
  return assembly;
}

/// Two prisms of 1 m along y that lean against each other at `lean` from the vertical, on a fixed floor.
/// Their feet reach from `foot` to `foot` + `width` from the axis; they touch on a vertical face. Blocks:
/// floor, card at -x, card at +x.
struct LeaningCards {
  double lean;                      ///< rad
  double foot = 0.5, width = 0.02;  ///< m

  double height(double x) const { return x / std::tan(lean); }
  Assembly assembly() const {
    Assembly cards = make_boxes({{.center = {0, 0, -0.5}, .size = {10, 10, 1}, .fixed = true}});
    const double a = foot, b = foot + width;
    const Eigen::Vector2d low(0, height(a)), high(0, height(b));
    add_voussoir({Eigen::Vector2d{-b, 0}, {-a, 0}, low, high}, 1.0, 1000.0, false, 0, &cards);
    add_voussoir({Eigen::Vector2d{a, 0}, {b, 0}, high, low}, 1.0, 1000.0, false, 0, &cards);
    compute_mass_properties(&cards);
    return cards;
  }
  /// The thrust at the top of the common face, over the weight, that keeps a card from falling inwards: by
  /// moments about the inner edge of its foot.
  double critical_friction() const {
    const double a = foot, b = foot + width;
    const double centre = (b * b * b - a * a * a) / (3.0 * (b * b - a * a));  // x of the centre of gravity
    return (a - centre) / height(b);
  }
};

}  // namespace cupola::testing

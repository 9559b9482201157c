#pragma once

// Small contact problems for the tests of solver/contact, built without the project's own problem builder.
// Mass matrices, contact frames and signs follow the conventions in contact_problem.hpp.

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <vector>

#include <Eigen/Geometry>

#include "solver/contact/problem/contact_problem.hpp"

namespace cupola::scenes {

constexpr double kGravity = 9.81;
constexpr int kGround = ContactProblem::kFixed;

/// Friction and compliance of a contact in a scene.
struct Joint {
  double mu = 0.4;
  double c_n = 1e-8;  ///< m/N
  double c_t = 1e-8;  ///< m/N
};

/// Adds blocks and contacts to a problem one by one.
class Scene {
 public:
  Scene(double h, const Vec3& gravity) : gravity_(gravity) { problem_.h = h; }

  int add_block(const Vec3& centroid, double mass, const Mat3& inertia, const Vec3& velocity = Vec3::Zero()) {
    Mat6 M = Mat6::Zero();
    M.topLeftCorner<3, 3>() = mass * Mat3::Identity();
    M.bottomRightCorner<3, 3>() = inertia;
    problem_.M.push_back(M);
    centroids_.push_back(centroid);
    v_star_.push_back(velocity + problem_.h * gravity_);
    return problem_.num_blocks() - 1;
  }

  int add_box(const Vec3& centroid, const Vec3& size, double density, const Mat3& R_WB = Mat3::Identity()) {
    const double mass = density * size.prod();
    const Vec3 s = size.cwiseAbs2();
    const Vec3 inertia = mass / 12.0 * Vec3(s[1] + s[2], s[0] + s[2], s[0] + s[1]);
    return add_block(centroid, mass, R_WB * inertia.asDiagonal() * R_WB.transpose());
  }

  /// Contact at a point with the normal from a to b; `first_tangent` fixes the frame if given. In a cyclic
  /// scene a and b may be images of their blocks, rotated by turn_a and turn_b.
  void add_contact(int a, int b, const Vec3& point, const Vec3& normal, const Joint& joint, double gap = 0.0,
                   const Vec3& first_tangent = Vec3::Zero(), const Mat3& turn_a = Mat3::Identity(),
                   const Mat3& turn_b = Mat3::Identity()) {
    Mat3 frame;
    frame.col(0) = normal.normalized();
    frame.col(1) = first_tangent.isZero() ? frame.col(0).unitOrthogonal() : first_tangent.normalized();
    frame.col(2) = frame.col(0).cross(frame.col(1));
    problem_.block_a.push_back(a);
    problem_.block_b.push_back(b);
    const auto lever = [&](int block, const Mat3& axes, const Mat3& turn) -> Lever {
      if (block == kGround) return {};
      return {turn.transpose() * axes, turn.transpose() * point - centroids_[block]};
    };
    problem_.D_a.push_back(lever(a, -frame, turn_a));
    problem_.D_b.push_back(lever(b, frame, turn_b));
    const double h = problem_.h;
    b_.push_back({gap / h, 0.0, 0.0});
    E_.push_back(Vec3(joint.c_n, joint.c_t, joint.c_t) / (h * h));
    mu_.push_back(joint.mu);
  }

  /// Four contacts at the corners of the rectangle centre +- half_u +- half_v.
  void add_patch(int a, int b, const Vec3& centre, const Vec3& half_u, const Vec3& half_v, const Vec3& normal,
                 const Joint& joint) {
    for (const auto& [s, t] : {std::pair{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}) {
      add_contact(a, b, centre + s * half_u + t * half_v, normal, joint);
    }
  }

  ContactProblem problem() const {
    ContactProblem p = problem_;
    p.v_star = VecX::Zero(6 * p.num_blocks());
    for (int k = 0; k < p.num_blocks(); ++k) p.v_star.segment<3>(6 * k) = v_star_[k];
    p.b.resize(3 * p.num_contacts());
    p.E.resize(3 * p.num_contacts());
    p.mu.resize(p.num_contacts());
    for (int i = 0; i < p.num_contacts(); ++i) {
      p.b.segment<3>(3 * i) = b_[i];
      p.E.segment<3>(3 * i) = E_[i];
      p.mu[i] = mu_[i];
    }
    return p;
  }

  const Vec3& centroid(int block) const { return centroids_[block]; }

 private:
  Vec3 gravity_;
  ContactProblem problem_;
  std::vector<Vec3> centroids_, b_, E_, v_star_;
  std::vector<double> mu_;
};

/// Unit cubes on top of each other on the ground, one density per cube.
inline ContactProblem stack(const std::vector<double>& densities, double h, const Joint& joint) {
  Scene scene(h, {0, 0, -kGravity});
  int below = kGround;
  for (std::size_t k = 0; k < densities.size(); ++k) {
    const int block = scene.add_box({0, 0, k + 0.5}, {1, 1, 1}, densities[k]);
    scene.add_patch(below, block, {0, 0, double(k)}, {0.5, 0, 0}, {0, 0.5, 0}, {0, 0, 1}, joint);
    below = block;
  }
  return scene.problem();
}

/// Block of 1 x 1 x 0.2 m on a plane inclined by tan(angle) = slope, in the axes of the plane: x down the
/// slope, z its normal.
inline ContactProblem incline(double slope, double h, const Joint& joint, double speed = 0.0,
                              double gap = 0.0) {
  const double angle = std::atan(slope);
  Scene scene(h, kGravity * Vec3(std::sin(angle), 0, -std::cos(angle)));
  const Vec3 size(1.0, 1.0, 0.2);
  const double mass = 2000.0 * size.prod();
  const Mat3 inertia = (mass / 12.0 * Vec3(1.04, 1.04, 2.0)).asDiagonal();
  const int block = scene.add_block({0, 0, 0.1 + gap}, mass, inertia, {speed, 0, 0});
  for (const auto& [s, t] : {std::pair{1, 1}, {-1, 1}, {-1, -1}, {1, -1}}) {
    scene.add_contact(kGround, block, {0.5 * s, 0.5 * t, gap}, {0, 0, 1}, joint, gap);
  }
  return scene.problem();
}

/// Rigid plate of weight W, centroid at (x, y), on four legs at (+-1, +-1). Order of the contacts: (++),
/// (+-), (-+), (--).
inline ContactProblem table(double weight, double x, double y, double h, const Joint& joint) {
  Scene scene(h, {0, 0, -kGravity});
  const double mass = weight / kGravity;
  const int plate = scene.add_block({x, y, 0.5}, mass, mass * Vec3(0.5, 0.5, 0.8).asDiagonal());
  for (const auto& [s, t] : {std::pair{1, 1}, {1, -1}, {-1, 1}, {-1, -1}}) {
    scene.add_contact(kGround, plate, {double(s), double(t), 0.0}, {0, 0, 1}, joint);
  }
  return scene.problem();
}

/// Prism in a V-shaped groove of two planes, each inclined by `phi` to the horizontal. The axis x of the
/// groove is tilted down by theta. In the axes of the groove; `velocity` in m/s.
inline ContactProblem groove(double phi, double theta, double h, const Joint& joint, const Vec3& velocity) {
  Scene scene(h, kGravity * Vec3(std::sin(theta), 0, -std::cos(theta)));
  const double mass = 1000.0;
  const int prism = scene.add_block({0, 0, 0}, mass, mass * Vec3(0.1, 0.2, 0.2).asDiagonal(), velocity);
  for (const double side : {-1.0, 1.0}) {
    const Vec3 normal(0, -side * std::sin(phi), std::cos(phi)),
        down(0, -side * std::cos(phi), -std::sin(phi));
    for (const double x : {-0.5, 0.5}) {
      for (const double d : {-0.2, 0.2}) {
        scene.add_contact(kGround, prism, Vec3(x, 0, 0) - 0.3 * normal + d * down, normal, joint, 0.0,
                          {1, 0, 0});
      }
    }
  }
  return scene.problem();
}

/// Arch of n voussoirs in the x-z plane: half embrace beta, fixed springings, depth 1 m, R = 1 m, gravity
/// tilted by `tilt` towards x. Intrados and extrados of a voussoir consist of `facets` flat faces with
/// vertices on the radii R +- t/2: one facet for polygonal voussoirs, many for sectors of a ring.
inline ContactProblem arch(int n, double thickness, double beta, double tilt, double h, const Joint& joint,
                           int facets = 1) {
  Scene scene(h, kGravity * Vec3(std::sin(tilt), 0, -std::cos(tilt)));
  const auto corner = [&](double k, double r) {  // angle from the crown, from -beta to beta
    const double angle = -beta + 2 * beta * k / n;
    return Vec3(r * std::sin(angle), 0, r * std::cos(angle));
  };
  const double inner = 1.0 - thickness / 2, outer = 1.0 + thickness / 2, density = 2000.0;
  for (int k = 0; k < n; ++k) {
    std::vector<Vec3> polygon;
    for (int j = 0; j <= facets; ++j) polygon.push_back(corner(k + 1.0 * j / facets, outer));
    for (int j = facets; j >= 0; --j) polygon.push_back(corner(k + 1.0 * j / facets, inner));
    // Area, first and second moments by signed triangles from the first corner, plane (x, z).
    double area = 0.0, xx = 0.0, zz = 0.0, xz = 0.0;
    Vec3 first = Vec3::Zero();
    for (size_t j = 1; j + 1 < polygon.size(); ++j) {
      const Vec3 a = polygon[j] - polygon[0], b = polygon[j + 1] - polygon[0];
      const double twice = a[2] * b[0] - a[0] * b[2];  // the polygon runs clockwise
      area += twice / 2;
      first += twice / 6 * (a + b);
      xx += twice / 12 * (a[0] * a[0] + a[0] * b[0] + b[0] * b[0]);
      zz += twice / 12 * (a[2] * a[2] + a[2] * b[2] + b[2] * b[2]);
      xz += twice / 24 * (2 * a[0] * a[2] + a[0] * b[2] + a[2] * b[0] + 2 * b[0] * b[2]);
    }
    const Vec3 c = first / area;
    xx -= area * c[0] * c[0];
    zz -= area * c[2] * c[2];
    xz -= area * c[0] * c[2];
    const double yy = area / 12;  // depth 1 m
    Mat3 inertia;
    inertia << yy + zz, 0, -xz, 0, xx + zz, 0, -xz, 0, xx + yy;
    scene.add_block(polygon[0] + c, density * area, density * inertia);
  }
  for (int k = 0; k <= n; ++k) {
    const double angle = -beta + 2 * beta * k / n;
    const Vec3 normal(std::cos(angle), 0, -std::sin(angle)), middle = corner(k, 1.0);
    const Vec3 half_radial = corner(k, 1.0 + thickness / 2) - middle;
    scene.add_patch(k == 0 ? kGround : k - 1, k == n ? kGround : k, middle, half_radial, {0, 0.5, 0}, normal,
                    joint);
  }
  return scene.problem();
}

/// Spherical dome of centreline radius `radius`: rings of equal angle in running bond, contacts at the
/// corners of beds and heads, base on the ground. Blocks have the mass and inertia of boxes of their mean
/// dimensions.
struct DomeShape {
  int rings = 40, blocks_per_ring = 32;
  double radius = 25.0, thickness = 2.2, top_angle = std::numbers::pi / 3;  ///< m, m, rad from the springing
  double gap = 0.0;  ///< m: largest random gap, uniform in [0, gap] per contact
  unsigned seed = 1;
  int sectors = 1;  ///< > 1: the blocks of one sector, whose neighbours are images of its own blocks
};

inline ContactProblem dome(const DomeShape& shape, double h, const Joint& joint) {
  using std::cos, std::sin;
  Scene scene(h, {0, 0, -kGravity});
  std::mt19937 random(shape.seed);
  const double dt = shape.top_angle / shape.rings, dp = 2 * std::numbers::pi / shape.blocks_per_ring;
  const auto radial = [](double t, double p) { return Vec3(cos(t) * cos(p), cos(t) * sin(p), sin(t)); };
  const auto up = [](double t, double p) { return Vec3(-sin(t) * cos(p), -sin(t) * sin(p), cos(t)); };
  const auto around = [](double p) { return Vec3(-sin(p), cos(p), 0); };
  const auto random_gap = [&] { return shape.gap * (random() / 4294967296.0); };
  const std::array radii{shape.radius - shape.thickness / 2, shape.radius + shape.thickness / 2};
  const int slots = shape.blocks_per_ring / shape.sectors;
  const auto index = [&](int ring, int slot) { return ring * slots + (slot + slots) % slots; };
  const auto turn = [&](int slot) -> Mat3 {  // of the sector that contains the slot, -1 <= slot <= slots
    const int turns = slot < 0 ? -1 : slot / slots;
    return Eigen::AngleAxisd(2 * std::numbers::pi * turns / shape.sectors, Vec3::UnitZ()).toRotationMatrix();
  };

  for (int i = 0; i < shape.rings; ++i) {
    const double t = (i + 0.5) * dt;
    for (int j = 0; j < slots; ++j) {
      const double p = (j + 0.5 + 0.5 * (i % 2)) * dp;
      Mat3 R_WB;
      R_WB << radial(t, p), around(p), up(t, p);
      scene.add_box(shape.radius * radial(t, p),
                    {shape.thickness, shape.radius * cos(t) * dp, shape.radius * dt}, 1835.0, R_WB);
    }
  }
  for (int i = 0; i < shape.rings; ++i) {
    for (int j = 0; j < slots; ++j) {
      const double p = (j + 0.5 * (i % 2)) * dp;  // first head of the block
      for (const double half : {0.0, 0.5}) {      // bed below: two half blocks
        const int slot = j + (i % 2) - (half == 0.0 ? 1 : 0);
        const int below = i == 0 ? kGround : index(i - 1, slot);
        for (const double q : {p + half * dp, p + (half + 0.5) * dp}) {
          for (const double r : radii) {
            scene.add_contact(below, index(i, j), r * radial(i * dt, q), up(i * dt, q), joint, random_gap(),
                              Vec3::Zero(), turn(slot));
          }
        }
      }
      for (const double t : {i * dt, (i + 1) * dt}) {  // head towards the next block
        for (const double r : radii) {
          const double q = p + dp;
          scene.add_contact(index(i, j), index(i, j + 1), r * radial(t, q), around(q), joint, random_gap(),
                            Vec3::Zero(), Mat3::Identity(), turn(j + 1));
        }
      }
    }
  }
  return scene.problem();
}

}  // namespace cupola::scenes

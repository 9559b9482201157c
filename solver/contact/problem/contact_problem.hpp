#pragma once

#include <limits>
#include <string>
#include <vector>

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace cupola {

using Vec6 = Eigen::Matrix<double, 6, 1>;
using Mat6 = Eigen::Matrix<double, 6, 6>;
using Mat63 = Eigen::Matrix<double, 6, 3>;
using VecX = Eigen::VectorXd;
using Vec3 = Eigen::Vector3d;
using Mat3 = Eigen::Matrix3d;

/// Strength of one contact, as impulses (N s): the stress that its area of joint carries, times the area and
/// the step. The default is a dry joint.
struct ContactStrength {
  double tension = 0.0;                                          ///< >= 0, largest pull
  double cohesion = 0.0;                                         ///< >= 0, shear carried at gamma_n = 0
  double compression = std::numeric_limits<double>::infinity();  ///< > 0, largest push
};

/// The columns of D of one of the two bodies of a contact, [frame; arm x frame].
struct Lever {
  Mat3 frame = Mat3::Zero();  ///< axes as columns, the normal first; their negatives for body a
  Vec3 arm = Vec3::Zero();    ///< m, from the centroid to the contact point

  /// D^T v: velocity of the point along the axes (m/s).
  template <class Velocity>
  Vec3 velocity(const Velocity& v) const {
    const Vec3 u(v[0] + v[4] * arm[2] - v[5] * arm[1], v[1] + v[5] * arm[0] - v[3] * arm[2],
                 v[2] + v[3] * arm[1] - v[4] * arm[0]);
    return {frame.col(0).dot(u), frame.col(1).dot(u), frame.col(2).dot(u)};
  }
  /// Adds D gamma, the impulse and its moment about the centroid (N s, N m s), to `sum`. Adding halves: a vector
  /// of six that is written by numbers and read by pairs takes three times as long.
  template <class Impulse, class Sum>
  void add_impulse(const Impulse& gamma, Sum&& sum) const {
    using Real = typename Impulse::Scalar;
    const Eigen::Matrix<Real, 3, 1> force = frame.cast<Real>() * gamma;
    sum.template head<3>() += force;
    sum.template tail<3>() += arm.cast<Real>().cross(force);
  }
  /// D
  template <class Real = double>
  Eigen::Matrix<Real, 6, 3> matrix() const {
    Eigen::Matrix<Real, 6, 3> D;
    D.template topRows<3>() = frame.cast<Real>();
    for (int axis = 0; axis < 3; ++axis)
      D.col(axis).template tail<3>() = arm.cast<Real>().cross(frame.cast<Real>().col(axis));
    return D;
  }
  /// |D|^T |v| and |D| |gamma| by components, or more where terms of a moment cancel: they bound the rounding of
  /// velocity() and add_impulse().
  template <class Velocity>
  Vec3 size_of_velocity(const Velocity& v) const {
    const Vec3 r = arm.cwiseAbs(), turn = v.template tail<3>().cwiseAbs();
    const Vec3 u = v.template head<3>().cwiseAbs() + sizes_of_cross(turn, r);
    return frame.cwiseAbs().transpose() * u;
  }
  Vec6 size_of_impulse(const Vec3& gamma) const {
    const Vec3 force = frame.cwiseAbs() * gamma.cwiseAbs();
    Vec6 size;
    size << force, sizes_of_cross(arm.cwiseAbs(), force);
    return size;
  }

 private:
  /// a x b with all terms added, of vectors >= 0.
  static Vec3 sizes_of_cross(const Vec3& a, const Vec3& b) {
    return {a[1] * b[2] + a[2] * b[1], a[2] * b[0] + a[0] * b[2], a[0] * b[1] + a[1] * b[0]};
  }
};

/// The frictional contact problem of one time step, in the form that every method takes. M is symmetric
/// positive definite, E >= 0:
///
///     M (v - v_star) = D gamma,     gamma in Y  _|_  D^T v + b + E gamma in Y*          (paper eq. 9-13)
///
/// Y is the product of the cones |gamma_t| <= mu gamma_n. Joints with strength replace the cone by the convex
/// set
///
///     |gamma_t| <= cohesion + mu gamma_n,   -tension <= gamma_n <= compression
///
/// and the second condition by: -(D^T v + b + E gamma) is an outward normal of that set at gamma. The paper
/// writes N = D^T M^-1 D - E with E = -K^-1/h^2; here E is positive and added. This is the associated law, a
/// convex problem. Under Coulomb's law De Saxce's term mu |u_t| is added to the normal component of the dual
/// variable (FrictionLaw in assembly/model/choices.hpp, outer_iterations.hpp).
///
/// Conventions: six unknowns per free block, linear then angular velocity, world axes, about the centroid.
/// Three rows per contact, the normal first, then two tangents. The normal points from block a to block b.
/// Hence u_n = (D^T v)_n > 0 opens the contact, and gamma_n > 0 pushes the blocks apart.
struct ContactProblem {
  static constexpr int kFixed = -1;  ///< block index of a body without unknowns

  std::vector<Mat6> M;                    ///< kg, kg m2: mass matrix per block (nb)
  VecX v_star;                            ///< m/s, rad/s: free velocity, i.e. without contact impulses (6 nb)
  std::vector<int> block_a;               ///< block of D_a, or kFixed (nc)
  std::vector<int> block_b;               ///< block of D_b, or kFixed (nc)
  std::vector<Lever> D_a;                 ///< rows of D for block a; unused when it is fixed (nc)
  std::vector<Lever> D_b;                 ///< rows of D for block b; unused when it is fixed (nc)
  VecX b;                                 ///< m/s: gap and elastic slip over (h + alpha) (3 nc)
  VecX E;                                 ///< 1/kg: diag c / (h (h + alpha)); both tangents equal (3 nc)
  VecX mu;                                ///< friction coefficient (nc)
  std::vector<ContactStrength> strength;  ///< (nc), or empty: all joints are dry
  double h = 0.0;                         ///< s, step; converts impulses to forces (force = gamma / h)
  /// Motion in the plane x-z: D is zero in the rows y, rot x and rot z (row y of frames and arms is zero), and
  /// M does not couple these with the others. Factors then have three unknowns per block.
  bool plane = false;

  int num_blocks() const { return static_cast<int>(M.size()); }
  int num_contacts() const { return static_cast<int>(block_a.size()); }

  /// Checks sizes, finite values, M symmetric positive definite, E >= 0, mu >= 0, equal E for both tangents,
  /// strengths >= 0, a free block per contact, h > 0. Throws std::invalid_argument that names the
  /// first violation.
  void validate() const;
  /// The message of validate(), or an empty string for a valid problem.
  std::string defect() const;
};

/// D_i^T v of one contact.
inline Vec3 relative_velocity(const ContactProblem& problem, int i, const VecX& v) {
  const int a = problem.block_a[i], b = problem.block_b[i];
  Vec3 u = Vec3::Zero();
  if (a != ContactProblem::kFixed) u += problem.D_a[i].velocity(v.segment<6>(6 * a));
  if (b != ContactProblem::kFixed) u += problem.D_b[i].velocity(v.segment<6>(6 * b));
  return u;
}
/// Adds D_i gamma_i of one contact to the impulses on its blocks.
inline void add_impulse(const ContactProblem& problem, int i, const Vec3& gamma, VecX* impulse) {
  const int a = problem.block_a[i], b = problem.block_b[i];
  if (a != ContactProblem::kFixed) problem.D_a[i].add_impulse(gamma, impulse->segment<6>(6 * a));
  if (b != ContactProblem::kFixed) problem.D_b[i].add_impulse(gamma, impulse->segment<6>(6 * b));
}

/// The columns of D of contact i for a block that it touches: of both sides if it joins the block with its own
/// image (cyclic_reduction.hpp).
inline Mat63 contact_columns(const ContactProblem& problem, int i, int block) {
  if (problem.block_a[i] != block) return problem.D_b[i].matrix();
  if (problem.block_b[i] != block) return problem.D_a[i].matrix();
  return problem.D_a[i].matrix() + problem.D_b[i].matrix();
}

/// D^T v, relative velocities in the contact frames (3 nc).
VecX relative_velocity(const ContactProblem& problem, const VecX& v);
/// D gamma, generalised impulses on the blocks (6 nb).
VecX generalized_impulse(const ContactProblem& problem, const VecX& gamma);

/// On entry the initial guess (warm start; empty vectors: cold start), on exit the solution.
struct ContactSolution {
  VecX v;      ///< (6 nb)
  VecX gamma;  ///< N s (3 nc)
};

}  // namespace cupola

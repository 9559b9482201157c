#include "solver/analysis/statics/static_certificate.hpp"

#include <algorithm>
#include <cmath>

#include "assembly/base/error.hpp"
#include "solver/analysis/record/record.hpp"
#include "solver/analysis/statics/cyclic_reduction.hpp"
#include "solver/analysis/statics/force_projection.hpp"
#include "solver/contact/problem/cone.hpp"
#include "solver/contact/problem/residuals.hpp"
#include "solver/dynamics/time_step.hpp"
#include "solver/runtime/threads.hpp"

namespace cupola {
namespace {

constexpr double kCarries = 0.01;  // of the mean joint force; joints with less are not compared

/// Loads on the blocks of one sector.
VecX restrict_loads(const VecX& loads, const CyclicSymmetry& symmetry) {
  VecX sector(6 * std::ssize(symmetry.block_of_orbit));
  for (int i = 0; i < static_cast<int>(symmetry.block_of_orbit.size()); ++i)
    sector.segment<6>(6 * i) = loads.segment<6>(6 * symmetry.block_of_orbit[i]);
  return sector;
}

/// Largest error of a joint wrench, relative to the exact wrench; infinite if that may be zero.
double largest_joint_error(const ContactSet& contacts, const ContactProblem& p, const VecX& gamma,
                           const ForceErrorBound& error) {
  const JointNumbers numbers = number_joints(contacts);
  struct Joint {
    Vec3 centroid = Vec3::Zero(), force = Vec3::Zero(), moment = Vec3::Zero();
    Vec3 force_change = Vec3::Zero(), moment_change = Vec3::Zero();
    double area = 0.0, points = 0.0, compliance_sum = 0.0;
  };
  std::vector<Joint> joints(numbers.count);
  const auto nc = static_cast<int>(contacts.points.size());
  const auto point = [&](int i) {
    return Vec3(0.5 * (contacts.points[i].point_a + contacts.points[i].point_b));
  };
  for (int i = 0; i < nc; ++i) {
    Joint& joint = joints[numbers.of_contact[i]];
    joint.centroid += point(i);
    joint.area += contacts.points[i].area;
    joint.points += 1.0;
  }
  for (Joint& joint : joints) joint.centroid /= joint.points;
  double mean = 0.0;
  for (int i = 0; i < nc; ++i) {
    Joint& joint = joints[numbers.of_contact[i]];
    const Mat3 R_WC = contact_frame(contacts.points[i].normal);
    const Vec3 force = R_WC * gamma.segment<3>(3 * i), change = R_WC * error.correction.segment<3>(3 * i);
    const double length = joint.area > 0.0 ? std::sqrt(joint.area) : 1.0;
    const Vec3 arm = (point(i) - joint.centroid) / length;
    joint.force += force;
    joint.moment += arm.cross(force);
    joint.force_change += change;
    joint.moment_change += arm.cross(change);
    const double stiffest =
        contact_law(p, i).carries_shear() ? std::min(p.E[3 * i], p.E[3 * i + 1]) : p.E[3 * i];
    joint.compliance_sum += (1.0 + arm.squaredNorm()) / stiffest;
  }
  for (const Joint& joint : joints) mean += joint.force.norm() / numbers.count;
  double largest = 0.0;
  for (const Joint& joint : joints) {
    if (!(joint.force.norm() > kCarries * mean)) continue;
    const double wrench = std::hypot(joint.force.norm(), joint.moment.norm());
    const double change = std::hypot(joint.force_change.norm(), joint.moment_change.norm());
    const double largest_change = change + error.remainder * std::sqrt(joint.compliance_sum);
    largest = std::max(largest, largest_change / std::max(0.0, wrench - largest_change));
  }
  return largest;
}

}  // namespace

StaticCertificate certify_static(const ContactSet& contacts, const VecX& loads, const ContactProblem& problem,
                                 const ContactSolution& solution, const FlowRule& law, double gravity,
                                 const CyclicSymmetry* symmetry) {
  CUPOLA_ASSERT(loads.size() == problem.v_star.size() && solution.gamma.size() == problem.b.size());
  StaticCertificate certificate;
  const bool rigid = smallest_compliance(problem) == 0.0;
  const bool coulomb = !law.is_associated();
  certificate.forces_unique = forces_unique(problem, law);
  if (problem.num_blocks() == 0 || solution.gamma.isZero(0.0)) {
    certificate.force_error.bounds = "no joint carries force";
    certificate.exact_forces = loads.isZero(0.0);
    return certificate;
  }
  const ContactProblem sector = symmetry ? reduce(problem, *symmetry) : ContactProblem{};
  const ContactProblem& p = symmetry ? sector : problem;
  const ContactSolution in_sector = symmetry ? restrict(solution, *symmetry) : ContactSolution{};
  const ContactSolution& x = symmetry ? in_sector : solution;
  release_freed_memory();  // of the solve: the factor of a large model takes most of the peak
  ForceProjection projection(p, p.h * (symmetry ? restrict_loads(loads, *symmetry) : loads));

  const bool has_ties = problem.num_contacts() > static_cast<int>(contacts.points.size());
  if (!symmetry && !has_ties && !rigid && !(coulomb && projection.slides(x)))
    certificate.balance = projection.is_stable(x, gravity) ? Balance::stable : Balance::unstable;

  const auto bound_force_error = [&] {
    if (rigid || coulomb) {
      certificate.force_error.bounds =
          rigid ? "some compliance is zero: forces are not unique" : "Coulomb's law is not a minimisation";
      return;
    }
    std::optional<ForceErrorBound> error = projection.force_error(x);
    if (!error) {
      certificate.force_error.bounds =
          "the forces in the loaded joints could not be brought into exact equilibrium inside the limits of "
          "the joints";
      return;
    }
    if (symmetry) {
      error->correction = expand({x.v, error->correction}, problem, *symmetry).gamma;
      error->remainder *= std::sqrt(symmetry->sectors);
    }
    const double largest = largest_joint_error(contacts, problem, solution.gamma, *error);
    if (!std::isfinite(largest)) {
      certificate.force_error.bounds = "the bound of the error exceeds the wrench of a joint";
      return;
    }
    certificate.force_error = {largest,
                               "relative error of the wrench on any joint that carries more than 1 % of the "
                               "mean joint force, against the exact static solution of this model"};
  };
  bound_force_error();
  certificate.exact_forces = projection.proves_equilibrium(x);
  return certificate;
}

}  // namespace cupola

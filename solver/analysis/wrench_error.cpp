#include "solver/analysis/wrench_error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <Eigen/Eigenvalues>
#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "solver/analysis/record.hpp"

namespace cupola {
namespace {

constexpr double kFirstTolerance = 0.1;        // first tolerance, relative to the wrench error
constexpr double kToleranceReduction = 0.1;    // factor from one tolerance to the next
constexpr double kSmallestTolerance = 1e-12;   // below this tolerance the momentum balance meets rounding
constexpr double kComparisonTolerance = 1e-2;  // of the finer solution, relative to the compared one

using Mat36 = Eigen::Matrix<double, 3, 6>;
using Vec6 = Eigen::Matrix<double, 6, 1>;

/// Bed and base joints.
struct BedJoints {
  std::vector<int> of_contact;  // joint of each contact, -1 for other kinds
  std::vector<Vec3> centroid;   // m, mean of the contact points of each joint
  double length = 1.0;          // m, square root of the mean joint area
};

Vec3 point_of(const Contact& contact) {
  return 0.5 * (contact.point_a + contact.point_b);
}

BedJoints bed_joints(const ContactSet& contacts) {
  BedJoints beds;
  const JointNumbers numbers = number_joints(contacts);
  beds.of_contact.assign(contacts.points.size(), -1);
  beds.centroid.assign(numbers.count, Vec3::Zero());
  std::vector<int> points(beds.centroid.size(), 0);
  double area = 0.0;
  for (size_t i = 0; i < contacts.points.size(); ++i) {
    const JointKind kind = contacts.patches[contacts.points[i].patch].kind;
    if (kind != JointKind::bed && kind != JointKind::base) continue;
    const auto j = numbers.of_contact[i];
    beds.of_contact[i] = static_cast<int>(j);
    beds.centroid[j] += point_of(contacts.points[i]);
    ++points[j];
    area += contacts.points[i].area;
  }
  int joints = 0;
  for (size_t j = 0; j < points.size(); ++j) {
    if (points[j] == 0) continue;
    beds.centroid[j] /= points[j];
    ++joints;
  }
  if (joints > 0 && area > 0.0) beds.length = std::sqrt(area / joints);
  return beds;
}

/// Transpose of d(wrench) / d(force) for one contact. Moments are divided by `length`.
Mat36 wrench_of_force(const BedJoints& beds, const Contact& contact, int joint) {
  const Vec3 r = (point_of(contact) - beds.centroid[joint]) / beds.length;
  Mat36 A_transposed;
  A_transposed.leftCols<3>().setIdentity();
  for (int k = 0; k < 3; ++k) A_transposed.row(k).tail<3>() = r.cross(Vec3::Unit(k)).transpose();
  return A_transposed;
}

std::vector<Vec6> wrenches(const ContactSet& contacts, const BedJoints& beds,
                           const std::vector<Vec3>& forces) {
  CUPOLA_ASSERT(forces.size() == contacts.points.size());
  std::vector<Vec6> w(beds.centroid.size(), Vec6::Zero());
  for (size_t i = 0; i < contacts.points.size(); ++i)
    if (const int j = beds.of_contact[i]; j >= 0)
      w[j] += wrench_of_force(beds, contacts.points[i], j).transpose() * forces[i];
  return w;
}

double norm(const std::vector<Vec6>& w) {
  double sum = 0.0;
  for (const Vec6& w_j : w) sum += w_j.squaredNorm();
  return std::sqrt(sum);
}

/// Spectral norm of A.
double largest_gain(const ContactSet& contacts, const BedJoints& beds) {
  std::vector<Mat6> AAt(beds.centroid.size(), Mat6::Zero());
  for (size_t i = 0; i < contacts.points.size(); ++i) {
    const int j = beds.of_contact[i];
    if (j < 0) continue;
    const Mat36 At = wrench_of_force(beds, contacts.points[i], j);
    AAt[j] += At.transpose() * At;
  }
  double largest = 0.0;
  for (const Mat6& M : AAt)
    largest =
        std::max(largest, Eigen::SelfAdjointEigenSolver<Mat6>(M, Eigen::EigenvaluesOnly).eigenvalues()[5]);
  return std::sqrt(largest);
}

}  // namespace

std::optional<double> certified_wrench_error(const ContactSet& contacts, const StaticSolution& solution) {
  if (!solution.residuals.certificate.value) return std::nullopt;
  const BedJoints beds = bed_joints(contacts);
  const double size = norm(wrenches(contacts, beds, solution.forces.contacts));
  if (!(size > 0.0)) return std::nullopt;
  return largest_gain(contacts, beds) * *solution.residuals.certificate.value *
         solution.step_solution.gamma.norm() / (solution.h * size);
}

double compared_wrench_error(const ContactSet& contacts, const StaticSolution& solution,
                             const StaticSolution& finer) {
  const BedJoints beds = bed_joints(contacts);
  std::vector<Vec6> difference = wrenches(contacts, beds, solution.forces.contacts);
  const std::vector<Vec6> right = wrenches(contacts, beds, finer.forces.contacts);
  for (size_t j = 0; j < difference.size(); ++j) difference[j] -= right[j];
  const double size = norm(right);
  return size > 0.0 ? norm(difference) / size : 0.0;
}

StaticSolution solve_static_to_wrench_error(const Model& model, const State& start,
                                            const ContactSet& contacts, const ContactMemories& memories,
                                            StaticOptions options, double wrench_error, double* reached) {
  CUPOLA_ASSERT(wrench_error > 0.0);
  StaticSolution solution;
  int iterations = 0;
  for (options.tolerance = kFirstTolerance * wrench_error; options.tolerance >= kSmallestTolerance;
       options.tolerance *= kToleranceReduction) {
    solution = solve_static(model, start, contacts, memories, options);
    iterations += solution.iterations;
    *reached = std::numeric_limits<double>::infinity();
    if (solution.outcome != StaticOutcome::equilibrium) break;  // a smaller tolerance would not be met either
    std::string source = "certified";
    if (const std::optional<double> bound = certified_wrench_error(contacts, solution)) {
      *reached = *bound;
    } else {
      StaticOptions finer = options;
      finer.tolerance = std::max(kComparisonTolerance * options.tolerance, kSmallestTolerance);
      const StaticSolution right = solve_static(model, start, contacts, memories, finer);
      iterations += right.iterations;
      if (right.outcome == StaticOutcome::equilibrium)
        *reached = compared_wrench_error(contacts, solution, right);
      source = fmt::format("measured against tolerance {:.0e}, no certificate exists", finer.tolerance);
    }
    if (*reached <= wrench_error) {
      solution.message =
          fmt::format("wrench error {:.1e} <= {:.1e} requested ({}); ", *reached, wrench_error, source) +
          solution.message;
      break;
    }
  }
  if (solution.outcome == StaticOutcome::equilibrium && !(*reached <= wrench_error)) {
    solution.outcome = StaticOutcome::unconverged;
    solution.message =
        fmt::format("wrench error {:.1e} > {:.1e} requested; ", *reached, wrench_error) + solution.message;
  }
  solution.iterations = iterations;
  return solution;
}

}  // namespace cupola

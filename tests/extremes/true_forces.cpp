#include "tests/extremes/true_forces.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include <Eigen/Geometry>
#include <fmt/format.h>

#include "assembly/base/error.hpp"
#include "tests/extremes/exact_statics.hpp"

namespace cupola {
namespace {

Vec3 resultant(const Frame& frame, const KnownForce& known) {
  Vec3 sum = Vec3::Zero();
  for (size_t i = 0; i < known.rows.size(); ++i) sum += known.signs[i] * frame.contacts.force[known.rows[i]];
  return known.along.isZero() ? sum : Vec3(known.along * known.along.dot(sum));
}

constexpr double kCarries = 0.01;  // of the mean; resultants with less are not compared

/// Forces of one joint: its wrench has the force, and the moment about the mean of its points over the square
/// root of its area.
struct Wrench {
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  double norm() const { return std::hypot(force.norm(), moment.norm()); }
};

/// Wrenches of all joints of the frame for the given forces on block b, one per contact point.
std::vector<Wrench> joint_wrenches(const ContactTable& contacts, const std::vector<Vec3>& forces) {
  const size_t count =
      contacts.size() == 0 ? 0 : 1 + *std::max_element(contacts.joint.begin(), contacts.joint.end());
  std::vector<Vec3> centre(count, Vec3::Zero());
  std::vector<double> points(count, 0.0), area(count, 0.0);
  for (int row = 0; row < contacts.size(); ++row) {
    centre[contacts.joint[row]] += contacts.point[row];
    area[contacts.joint[row]] += contacts.area[row];
    points[contacts.joint[row]] += 1.0;
  }
  std::vector<Wrench> wrenches(count);
  for (int row = 0; row < contacts.size(); ++row) {
    const int j = contacts.joint[row];
    const double length = area[j] > 0.0 ? std::sqrt(area[j]) : 1.0;
    wrenches[j].force += forces[row];
    wrenches[j].moment += (contacts.point[row] - centre[j] / points[j]).cross(forces[row]) / length;
  }
  return wrenches;
}

double mean_force(const std::vector<Wrench>& wrenches) {
  double mean = 0.0;
  for (const Wrench& w : wrenches) mean += w.force.norm() / static_cast<double>(wrenches.size());
  return mean;
}

/// Lower bound of the largest relative error of the wrenches of the joints that a resultant consists of:
/// |dF| <= sum of the errors <= largest relative error times the sum of the wrenches. NaN if it does not
/// consist of whole joints that all carry more than 1 % of the mean.
double least_wrench_error(const Frame& frame, const std::vector<Wrench>& wrenches, const KnownForce& known,
                          double error) {
  std::map<int, int> rows_of;  // joint: rows outside the resultant
  for (const int row : known.rows) rows_of[frame.contacts.joint[row]] = 0;
  for (int row = 0; row < frame.contacts.size(); ++row)
    if (const auto joint = rows_of.find(frame.contacts.joint[row]); joint != rows_of.end()) ++joint->second;
  for (const int row : known.rows) --rows_of[frame.contacts.joint[row]];
  const double least = kCarries * mean_force(wrenches);
  double sum = 0.0;
  for (const auto& [joint, outside] : rows_of) {
    if (outside > 0 || !(wrenches[joint].force.norm() > least))
      return std::numeric_limits<double>::quiet_NaN();
    sum += wrenches[joint].norm() + error;  // at least the exact wrench
  }
  return error / sum;
}

/// The resultants of statics alone are wrong by at most the unbalanced forces, which the summary states.
std::string refuted_balance(const Scene& scene, const Summary& summary, const KnownForce& known,
                            const Vec3& found) {
  if (known.num_blocks == 0 || summary.free_blocks == 0) return "";
  const double mean = summary.weight_N / summary.free_blocks;
  constexpr double kRounding = 1e-13;  // of the force: the sum over its contact points
  const double allowed =
      known.num_blocks * summary.equilibrium_residual.value() * mean + kRounding * known.force.norm();
  const double error = (found - known.force).norm();
  if (error <= allowed || scene.input.analysis.type != AnalysisType::static_) return "";
  return fmt::format("{:.2e} N are missing under {} blocks; the residual {:.1e} allows {:.2e} N", error,
                     known.num_blocks, summary.equilibrium_residual.value(), allowed);
}

}  // namespace

TrueError compare(const Scene& scene, const Summary& summary, const Frame& frame,
                  const std::vector<KnownForce>& known) {
  TrueError error;
  if (!stands(summary.status)) return error;
  const bool certifies_wrenches = scene.input.analysis.type == AnalysisType::static_;
  const std::vector<Wrench> wrenches = joint_wrenches(frame.contacts, frame.contacts.force);
  double mean = 0.0;
  for (const KnownForce& one : known) mean += one.force.norm() / static_cast<double>(known.size());
  error.largest = 0.0;
  for (const KnownForce& one : known) {
    const Vec3 found = resultant(frame, one);
    const double difference = (found - one.force).norm();
    if (one.force.norm() > kCarries * mean)
      error.largest = std::max(error.largest, difference / one.force.norm());
    if (certifies_wrenches && one.along.isZero())
      error.wrench = std::fmax(error.wrench, least_wrench_error(frame, wrenches, one, difference));
    if (error.refuted.empty()) error.refuted = refuted_balance(scene, summary, one, found);
  }
  return error;
}

std::vector<KnownForce> weight_above(const Scene& scene, const Frame& frame) {
  const Assembly& assembly = scene.assembly;
  int rings = 0;
  for (const Block& block : assembly.blocks) rings = std::max(rings, block.fixed ? 0 : block.ring + 1);
  std::vector<KnownForce> known(rings);
  const auto level = [&](int block) {
    return assembly.blocks[block].fixed ? -1 : assembly.blocks[block].ring;
  };
  for (size_t i = 0; i < assembly.blocks.size(); ++i)
    for (int k = 0; k <= level(static_cast<int>(i)); ++k) {
      known[k].force -= assembly.blocks[i].mass * scene.input.loads.gravity;
      ++known[k].num_blocks;
    }
  for (int row = 0; row < frame.contacts.size(); ++row) {
    const int a = level(frame.contacts.block_a[row]), b = level(frame.contacts.block_b[row]);
    if (a == b) continue;
    for (int k = std::min(a, b) + 1; k <= std::max(a, b); ++k) {  // thin plates also meet the next but one
      known[k].rows.push_back(row);
      known[k].signs.push_back(b > a ? 1 : -1);
    }
  }
  return known;
}

KnownForce between(const Frame& frame, int block_a, int block_b, const Vec3& force,
                   const std::function<bool(const Vec3&)>& counts) {
  KnownForce known{.force = force};
  for (int row = 0; row < frame.contacts.size(); ++row)
    if (frame.contacts.block_a[row] == block_a && frame.contacts.block_b[row] == block_b &&
        (!counts || counts(frame.contacts.point[row]))) {
      known.rows.push_back(row);
      known.signs.push_back(1);
    }
  return known;
}

TrueError carries_weight_above(const Scene& scene, const Summary& summary, const Frame& frame) {
  return compare(scene, summary, frame, weight_above(scene, frame));
}

TrueError equals_exact_statics(const Scene& scene, const Summary& summary, const Frame& frame) {
  const ExactStatics exact = solve_exact_statics(scene.input, scene.assembly);
  TrueError error;
  if (moves(summary.status)) {
    if (exact.found)
      error.refuted = fmt::format("moving, but forces in equilibrium exist: residual {:.1e}", exact.residual);
    return error;
  }
  if (!exact.found || exact.forces.size() != frame.contacts.force.size()) {
    error.has_reference = false;
    error.refuted = fmt::format("the reference found no equilibrium: residual {:.1e} after {} iterations",
                                exact.residual, exact.iterations);
    return error;
  }
  const std::vector<Wrench> right = joint_wrenches(frame.contacts, exact.forces);
  std::vector<Vec3> differences = frame.contacts.force;
  for (size_t row = 0; row < differences.size(); ++row) differences[row] -= exact.forces[row];
  const std::vector<Wrench> wrong = joint_wrenches(frame.contacts, differences);
  const double least = kCarries * mean_force(right);
  error.largest = 0.0;
  for (size_t j = 0; j < right.size(); ++j)
    if (right[j].force.norm() > least)
      error.largest = std::max(error.largest, wrong[j].norm() / right[j].norm());
  error.wrench = error.largest;
  return error;
}

}  // namespace cupola

#include "tests/extremes/true_forces.hpp"

#include <algorithm>
#include <cmath>
#include <map>

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

double norm_of(const std::vector<Vec3>& forces) {
  double sum = 0.0;
  for (const Vec3& f : forces) sum += f.squaredNorm();
  return std::sqrt(sum);
}

/// Largest relative error of the resultants that carry more than 1 % of their mean.
double worst_relative_error(const std::vector<Vec3>& found, const std::vector<Vec3>& exact) {
  constexpr double kLoaded = 1e-2;
  double mean = 0.0, worst = 0.0;
  for (const Vec3& force : exact) mean += force.norm() / static_cast<double>(exact.size());
  for (size_t k = 0; k < exact.size(); ++k)
    if (exact[k].norm() > kLoaded * mean)
      worst = std::max(worst, (found[k] - exact[k]).norm() / exact[k].norm());
  return worst;
}

/// The resultants of statics alone are wrong by at most the unbalanced forces, which the summary states.
std::string refuted_balance(const Scene& scene, const Summary& summary, const KnownForce& known,
                            const Vec3& found) {
  if (known.num_blocks == 0 || summary.free_blocks == 0) return "";
  const double mean = summary.weight_N / summary.free_blocks;
  constexpr double kRounding = 1e-13;  // of the force: the sum over its contact points
  const double allowed =
      known.num_blocks * summary.equilibrium_residual * mean + kRounding * known.force.norm();
  const double error = (found - known.force).norm();
  if (error <= allowed || scene.input.analysis.type != AnalysisType::static_) return "";
  return fmt::format("{:.2e} N are missing under {} blocks; the residual {:.1e} allows {:.2e} N", error,
                     known.num_blocks, summary.equilibrium_residual, allowed);
}

}  // namespace

TrueError compare(const Scene& scene, const Summary& summary, const Frame& frame,
                  const std::vector<KnownForce>& known) {
  TrueError error;
  if (summary.status != Status::stable) return error;
  std::vector<Vec3> found, exact;
  double squares = 0.0;
  for (const KnownForce& one : known) {
    found.push_back(resultant(frame, one));
    exact.push_back(one.force);
    if (!one.rows.empty())
      squares += (found.back() - one.force).squaredNorm() / static_cast<double>(one.rows.size());
    if (error.refuted.empty()) error.refuted = refuted_balance(scene, summary, one, found.back());
  }
  error.norm = std::sqrt(squares) / norm_of(frame.contacts.force);
  error.worst_joint = worst_relative_error(found, exact);
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
    CUPOLA_ASSERT(std::abs(a - b) == 1);
    known[std::max(a, b)].rows.push_back(row);
    known[std::max(a, b)].signs.push_back(b > a ? 1 : -1);
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
  if (summary.status == Status::moving) {
    if (exact.found)
      error.refuted = fmt::format("moving, but forces in equilibrium exist: residual {:.1e}", exact.residual);
    return error;
  }
  if (!exact.found || exact.forces.size() != frame.contacts.force.size()) {
    error.refuted = fmt::format("the reference found no equilibrium: residual {:.1e} after {} iterations",
                                exact.residual, exact.iterations);
    return error;
  }
  double squares = 0.0;
  std::map<std::pair<int, int>, std::pair<Vec3, Vec3>> joints;  // forces found and exact of pairs of blocks
  for (int row = 0; row < frame.contacts.size(); ++row) {
    squares += (frame.contacts.force[row] - exact.forces[row]).squaredNorm();
    auto [joint, added] = joints.try_emplace({frame.contacts.block_a[row], frame.contacts.block_b[row]},
                                             Vec3::Zero(), Vec3::Zero());
    joint->second.first += frame.contacts.force[row];
    joint->second.second += exact.forces[row];
  }
  std::vector<Vec3> found, right;
  for (const auto& [blocks, forces] : joints) {
    found.push_back(forces.first);
    right.push_back(forces.second);
  }
  error.norm = std::sqrt(squares) / norm_of(frame.contacts.force);
  error.worst_joint = worst_relative_error(found, right);
  return error;
}

}  // namespace cupola

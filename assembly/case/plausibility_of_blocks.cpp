#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "assembly/case/plausibility.hpp"
#include "assembly/case/plausible_range.hpp"
#include "assembly/model/applied_loads.hpp"
#include "assembly/model/joint_rule.hpp"

namespace cupola {
namespace {

constexpr double kFar = std::numeric_limits<double>::infinity();

/// Corners of the free blocks, or of all blocks if none is free; each of them once.
std::vector<Vec3> corners(const Assembly& assembly) {
  std::vector<Vec3> points;
  std::vector<bool> is_known(assembly.vertices.size(), false);
  for (const bool fixed_too : {false, true}) {
    for (const Part& part : assembly.parts) {
      if (!fixed_too && assembly.blocks[static_cast<size_t>(part.block)].fixed) continue;
      for (int f = part.face_start; f < part.face_start + part.num_faces; ++f)
        for (const int v : assembly.face(f)) {
          if (!is_known[static_cast<size_t>(v)]) points.push_back(assembly.vertices[static_cast<size_t>(v)]);
          is_known[static_cast<size_t>(v)] = true;
        }
    }
    if (!points.empty()) break;
  }
  return points;
}

struct Extent {
  Vec3 low = Vec3::Constant(kFar), high = Vec3::Constant(-kFar);
  double size() const { return (high - low).maxCoeff(); }
};

Extent extent_of(const std::vector<Vec3>& points) {
  Extent extent;
  for (const Vec3& x : points) {
    extent.low = extent.low.cwiseMin(x);
    extent.high = extent.high.cwiseMax(x);
  }
  return extent;
}

std::vector<std::string> cuts_beside(const Postproc& postproc, const std::vector<Vec3>& points,
                                     const Extent& extent) {
  std::vector<std::string> out;
  for (const double height : postproc.sections)
    if (height < extent.low.z() || height > extent.high.z())
      out.push_back(fmt::format(
          "postproc.sections: the height {:g} m cuts no block; the model reaches from {:.4g} to {:.4g} m "
          "above z = 0",
          height, extent.low.z(), extent.high.z()));
  for (const CutPlane& plane : postproc.planes) {
    double low = kFar, high = -kFar;
    for (const Vec3& x : points) {
      const double distance = (x - plane.point).dot(plane.normal.normalized());
      low = std::min(low, distance);
      high = std::max(high, distance);
    }
    if (low > 0.0 || high < 0.0)
      out.push_back(fmt::format(
          "postproc.planes: {} passes {:.4g} m beside the model; the model reaches from ({:.4g}, {:.4g}, "
          "{:.4g}) to ({:.4g}, {:.4g}, {:.4g}) m",
          plane.name, std::max(low, -high), extent.low.x(), extent.low.y(), extent.low.z(), extent.high.x(),
          extent.high.y(), extent.high.z()));
  }
  return out;
}

/// m: the largest distance by which a displacement opens or closes the joints of a fixed block.
double opening_of_joints(const Assembly& assembly, int block, const Vec3& displacement) {
  double largest = 0.0;
  for (const Part& part : assembly.parts) {
    if (part.block != block) continue;
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f) {
      const FaceKind kind = assembly.face_kinds[static_cast<size_t>(f)];
      if (kind != FaceKind::bed && kind != FaceKind::head) continue;
      largest = std::max(largest, std::abs(polygon_plane(face_points(assembly, f)).normal.dot(displacement)));
    }
  }
  return largest;
}

/// Supports that stand so far from their places at the start that their joints are not found. A static
/// analysis and a path find them however far they have moved.
std::vector<std::string> lost_supports(const Case& scene, const Assembly& assembly) {
  if (scene.analysis.type == AnalysisType::static_ || scene.analysis.type == AnalysisType::path) return {};
  const double margin = joint_rule(smallest_block_size(assembly), scene.contact.margin).margin;
  std::vector<std::string> out;
  for (size_t i = 0; i < scene.supports.moves.size(); ++i) {
    const SupportMove& move = scene.supports.moves[i];
    const Vec3 displacement = factor_at(move.time, 0.0) * move.displacement;
    const auto moves = [&](int block) {
      return move.region.blocks.empty() || std::ranges::any_of(move.region.blocks, [&](const BlockRef& one) {
               return one.number == block;
             });
    };
    double opening = 0.0;
    for (int b = 0; b < static_cast<int>(assembly.blocks.size()); ++b)
      if (assembly.blocks[static_cast<size_t>(b)].fixed && moves(b))
        opening = std::max(opening, opening_of_joints(assembly, b, displacement));
    if (opening > margin)
      out.push_back(fmt::format(
          "supports.moves[{}]: opens a joint by {:.3g} m at the start, and joints are found up to {:.3g} m; "
          "set contact.margin above it, or give the move a `time` that begins at 0 and use type: path",
          i, opening, margin));
  }
  return out;
}

/// Fill that hardly lies on anything. `weight`: of the free blocks, N.
std::vector<std::string> idle_fill(const Loads& loads, const Assembly& assembly, double weight) {
  constexpr double kIdle = 1e-3;  // of the weight: less changes no answer that a user sees
  std::vector<std::string> out;
  for (size_t i = 0; i < loads.faces.size(); ++i) {
    if (!loads.faces[i].fill || loads.gravity.norm() == 0.0) continue;
    Loads fill;
    fill.gravity = loads.gravity;
    fill.faces = {loads.faces[i]};
    fill.faces[0].traction.setZero();
    fill.faces[0].pressure = 0.0;
    const std::vector<PointForce> forces = applied_loads(fill, assembly);
    double down = 0.0;
    for (const PointForce& force : forces) down -= force.force.z();
    if (down >= kIdle * weight) continue;
    out.push_back(fmt::format(
        "loads.faces[{}].fill: up to z = {:g} m it weighs {:.3g} N, {:.1g} % of the blocks, on {} of their "
        "faces; is the level that of the model, whose z counts from its own origin?",
        i, loads.faces[i].fill->level, down, 100.0 * down / weight, forces.size()));
  }
  return out;
}

/// Spread forces of which a part falls beside the masonry.
std::vector<std::string> spread_beside(const Loads& loads, const Assembly& assembly) {
  constexpr double kRounding = 1e-6;
  std::vector<std::string> out;
  for (size_t i = 0; i < loads.forces.size(); ++i) {
    const BlockForce& load = loads.forces[i];
    const double beside = load.spread ? share_beside(load, assembly) : 0.0;
    if (beside > kRounding)
      out.push_back(fmt::format(
          "loads.forces[{}].spread: {:.3g} % of the force, {:.3g} N, reaches no free block and is left out; "
          "the rest keeps its intensity. If the ground carries it, nothing is to be done",
          i, 100.0 * beside, beside * load.force.norm()));
  }
  return out;
}

}  // namespace

std::vector<std::string> implausible_for_blocks(const Case& scene, const Assembly& assembly) {
  const std::vector<Vec3> points = corners(assembly);
  const Extent extent = extent_of(points);
  std::vector<PlausibleRange> checks;
  if (scene.geometry.imported)
    checks.push_back({"geometry.import (size of the model)", extent.size(), "m", 0.05, 1e3,
                      "drawn in km? Set geometry.import.metres_per_unit",
                      "drawn in millimetres? Set geometry.import.metres_per_unit: 0.001"});
  const LimitSearch& limit = scene.analysis.limit;
  const auto varies = [&](LimitSearch::Parameter parameter) {
    return scene.analysis.type == AnalysisType::limit && limit.parameter == parameter;
  };
  int free_blocks = 0;
  for (const Block& block : assembly.blocks) free_blocks += block.fixed ? 0 : 1;
  const double gravity = scene.loads.gravity.norm();
  const double weight = free_weight(assembly, gravity > 0.0 ? gravity : 9.81);
  for (size_t i = 0; i < scene.loads.forces.size() && !varies(LimitSearch::Parameter::load); ++i)
    if (const double force = scene.loads.forces[i].force.norm(); force > 0.0)
      checks.push_back({fmt::format("loads.forces[{}].force", i), force, "N",
                        1e-4 * weight / std::max(1, free_blocks), 1e3 * weight, "in kN? Forces are in N",
                        "too many digits? Forces are in N"});
  for (size_t i = 0; i < scene.supports.moves.size() && !varies(LimitSearch::Parameter::spread); ++i)
    checks.push_back({fmt::format("supports.moves[{}].displacement", i),
                      scene.supports.moves[i].displacement.norm() + std::abs(scene.supports.moves[i].outward),
                      "m", 0.0, extent.size(), "", kMillimetres});
  std::vector<std::string> out = sentences(checks);
  for (std::string& text : cuts_beside(scene.postproc, points, extent)) out.push_back(std::move(text));
  for (std::string& text : idle_fill(scene.loads, assembly, weight)) out.push_back(std::move(text));
  for (std::string& text : spread_beside(scene.loads, assembly)) out.push_back(std::move(text));
  if (!varies(LimitSearch::Parameter::spread))
    for (std::string& text : lost_supports(scene, assembly)) out.push_back(std::move(text));
  return out;
}

}  // namespace cupola

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/case/case_times.hpp"
#include "assembly/case/declare.hpp"
#include "assembly/case/plausibility.hpp"
#include "assembly/case/plausible_range.hpp"
#include "assembly/model/applied_loads.hpp"
#include "assembly/model/block_names.hpp"
#include "assembly/model/laying_course.hpp"

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

/// Supports that have moved when a motion starts whose free blocks stand as built.
std::vector<std::string> moved_supports(const Case& scene) {
  if (scene.analysis.type != AnalysisType::dynamic || starts_static(scene)) return {};
  std::vector<std::string> out;
  for (size_t i = 0; i < scene.supports.moves.size(); ++i) {
    const SupportMove& move = scene.supports.moves[i];
    const bool moves = move.displacement.norm() + move.rotation_deg.norm() + std::abs(move.outward) +
                           std::abs(move.tilt_deg) >
                       0.0;
    if (moves && factor_at(move.time, 0.0) != 0.0)
      out.push_back(fmt::format(
          "supports.moves[{}]: has moved at the start, where the other blocks stand as built; give it a "
          "`time` that begins at 0, or set analysis.start: static",
          i));
  }
  return out;
}

/// Fill that hardly lies on anything, or presses on nothing aside. `weight`: of the free blocks, N.
std::vector<std::string> idle_fill(const Loads& loads, const Assembly& assembly, double weight) {
  constexpr double kIdle = 1e-3;      // of the weight: less changes no answer that a user sees
  constexpr double kRounding = 1e-9;  // of normals of level faces
  std::vector<std::string> out;
  for (size_t i = 0; i < loads.faces.size(); ++i) {
    if (!loads.faces[i].fill || loads.gravity.norm() == 0.0) continue;
    Loads fill;
    fill.gravity = loads.gravity;
    fill.faces = {loads.faces[i]};
    fill.faces[0].traction.setZero();
    fill.faces[0].pressure = 0.0;
    const std::vector<PointForce> forces = applied_loads(fill, assembly);
    double down = 0.0, aside = 0.0;
    for (const PointForce& force : forces) {
      down -= force.force.z();
      aside += force.force.head<2>().norm();
    }
    const double horizontal = loads.faces[i].fill->horizontal;
    if (horizontal > 0.0 && aside <= kRounding * down)
      out.push_back(fmt::format(
          "loads.faces[{}].fill.horizontal = {:g}: has no effect: the fill lies on level faces and beside "
          "none "
          "that rises from them; earth against a vertical back is a `pressure` on its courses, by from_ring "
          "and to_ring",
          i, horizontal));
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

/// Loads and moves that no stage of a construction feels.
std::vector<std::string> felt_by_no_stage(const Case& scene, const Assembly& assembly) {
  const StagedConstruction& staged = scene.analysis.staged;
  if (scene.analysis.type != AnalysisType::staged) return {};
  const int top = last_course(assembly);
  const bool completed = completes(assembly, staged.last_ring);
  const bool feels_supports = std::ranges::any_of(assembly.blocks, [&](const Block& block) {
    return !block.fixed && laying_course(assembly, block) == 0 &&
           !is_held(assembly, block, top, staged.hold_below);
  });
  std::vector<std::string> out;
  const std::vector<PointForce> loads = applied_loads(scene.loads, assembly);
  std::set<int> held;
  for (const PointForce& load : loads)
    if (is_held(assembly, assembly.blocks[static_cast<size_t>(load.block)], top, staged.hold_below))
      held.insert(load.block);
  if (completed && !held.empty())
    out.push_back(
        fmt::format("loads: no joint feels those on {}, the first {}, because analysis.staged.hold_below = "
                    "{} holds these blocks",
                    counted(held.size(), "block"), block_label(assembly, *held.begin()), staged.hold_below));
  if (!completed && !loads.empty())
    out.push_back(
        fmt::format("loads: all but the weight act on the complete model only, which "
                    "analysis.staged.last_ring = {} never reaches",
                    staged.last_ring));
  if (!scene.supports.moves.empty() && !(completed && feels_supports))
    out.push_back(
        completed
            ? fmt::format("supports.moves: no joint feels them, because analysis.staged.hold_below = {} "
                          "holds the blocks on the supports",
                          staged.hold_below)
            : fmt::format("supports.moves: act on the complete model only, which "
                          "analysis.staged.last_ring = {} never reaches",
                          staged.last_ring));
  return out;
}

/// The least and the greatest density that files of blocks, or the case, give to blocks of an import; that of
/// all others is checked where it stands.
void add_densities(const Case& scene, const Assembly& assembly, std::vector<PlausibleRange>* checks) {
  constexpr double kGravity = 9.81;
  constexpr double kRounding = 1e-9;  // relative, of masses summed over parts
  const double of_all = scene.material.density();
  std::map<double, int> blocks;
  for (size_t k = 0; k < assembly.blocks.size(); ++k) {
    const Block& block = assembly.blocks[k];
    const double density = block.mass / block.volume;
    if (!block.fixed && std::abs(density - of_all) > kRounding * of_all)
      blocks.try_emplace(density, static_cast<int>(k));
  }
  if (blocks.empty()) return;
  const auto add = [&](const std::pair<const double, int>& found) {
    checks->push_back(
        {fmt::format("geometry.import (density of block {})", block_label(assembly, found.second)),
         found.first, "kg/m3", kLightest / kGravity, kHeaviest / kGravity, "in t/m3 or kN/m3? Write 1800",
         "a unit weight in N/m3? Divide by 9.81"});
  };
  add(*blocks.begin());
  if (blocks.size() > 1) add(*blocks.rbegin());
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
  if (scene.geometry.imported) add_densities(scene, assembly, &checks);
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
                        1e-2 * weight / std::max(1, free_blocks), 1e3 * weight, "in kN? Forces are in N",
                        "too many digits? Forces are in N"});
  for (size_t i = 0; i < scene.supports.moves.size() && !varies(LimitSearch::Parameter::spread); ++i)
    checks.push_back({fmt::format("supports.moves[{}].displacement", i),
                      scene.supports.moves[i].displacement.norm() + std::abs(scene.supports.moves[i].outward),
                      "m", 0.0, extent.size(), "", kMillimetres});
  std::vector<std::string> out = sentences(checks);
  for (std::string& text : cuts_beside(scene.postproc, points, extent)) out.push_back(std::move(text));
  for (std::string& text : idle_fill(scene.loads, assembly, weight)) out.push_back(std::move(text));
  for (std::string& text : spread_beside(scene.loads, assembly)) out.push_back(std::move(text));
  for (std::string& text : moved_supports(scene)) out.push_back(std::move(text));
  for (std::string& text : felt_by_no_stage(scene, assembly)) out.push_back(std::move(text));
  return out;
}

}  // namespace cupola

#include "solver/dynamics/joints_on_supports.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <set>
#include <utility>

#include <fmt/format.h>

#include "assembly/base/counted.hpp"
#include "assembly/case/limit_parameter.hpp"
#include "assembly/model/block_names.hpp"
#include "solver/dynamics/model.hpp"

namespace cupola {
namespace {

/// Number of joints that lie one above the other: the rings, or the height over the mean size of a block.
double joint_levels(const Assembly& assembly, double height) {
  if (assembly.num_rings > 0) return assembly.num_rings;
  double volume = 0.0;
  int free_blocks = 0;
  for (const Block& block : assembly.blocks) {
    if (block.fixed) continue;
    volume += block.volume;
    ++free_blocks;
  }
  return std::max(1.0, height / std::cbrt(volume / std::max(1, free_blocks)));
}

double height_of_free_blocks(const Assembly& assembly) {
  double low = std::numeric_limits<double>::infinity(), high = -low;
  for (const Part& part : assembly.parts) {
    if (assembly.blocks[part.block].fixed) continue;
    for (int f = part.face_start; f < part.face_start + part.num_faces; ++f)
      for (const int v : assembly.face(f)) {
        low = std::min(low, assembly.vertices[v].z());
        high = std::max(high, assembly.vertices[v].z());
      }
  }
  return high - low;
}

/// The joints between fixed and free blocks, together.
struct OnSupports {
  double stiffness = 0.0;    ///< N/m
  bool rigid = false;        ///< one of them is
  double area = 0.0;         ///< m2
  double capacity = 0.0;     ///< N, in compression
  Vec3 load = Vec3::Zero();  ///< N, see largest_load()
};

/// The case without loads that its limit multiplies, whose size says nothing.
Case without_multiplied(const Case& scene) {
  using enum LimitSearch::Parameter;
  const LimitSearch::Parameter parameter = scene.analysis.limit.parameter;
  const bool multiplies = parameter == load || parameter == lantern;
  return scene.analysis.type == AnalysisType::limit && multiplies ? case_at(scene, 0.0) : scene;
}

/// N, the largest sum of weight and loads within the time of the analysis.
Vec3 largest_load(const Case& scene, const Model& model) {
  const LoadSet& loads = model.loads;
  double mass = 0.0;
  for (const int block : model.free_blocks) mass += model.assembly->blocks[block].mass;
  std::map<int, Vec3> sums;  // by their time, at factor 1
  for (const PointLoad& load : loads.points)
    sums.try_emplace(load.time, Vec3::Zero()).first->second += load.force;
  const AnalysisType type = scene.analysis.type;
  const double end = type == AnalysisType::path      ? scene.analysis.path.end
                     : type == AnalysisType::dynamic ? scene.analysis.duration
                                                     : 0.0;
  Vec3 largest = Vec3::Zero();
  for (double time = 0.0, next = 0.0;; time = std::min(next, end)) {
    Vec3 sum = mass * loads.gravity_at(time);
    next = next_corner(loads.dead_load_time, time);
    for (const auto& [of_force, force] : sums) {
      sum += load_factor(of_force, loads.dead_load_time, loads.times, time) * force;
      if (of_force >= 0) next = std::min(next, next_corner(loads.times[of_force], time));
    }
    if (sum.norm() > largest.norm()) largest = sum;
    if (time >= end) return largest;  // between corners it is hardly larger than at one of them
  }
}

OnSupports joints_on_supports(const Case& scene, const Assembly& assembly, const ContactSet& contacts) {
  const Model model = make_model(without_multiplied(scene), assembly);
  OnSupports sum;
  for (const Contact& contact : contacts.points) {
    if (assembly.blocks[contact.block_a].fixed == assembly.blocks[contact.block_b].fixed) continue;
    const JointLaw law = joint_law(model, contacts, contact, 0.0);
    if (law.compliance_normal == 0.0)
      sum.rigid = true;
    else
      sum.stiffness += 1.0 / law.compliance_normal;
    sum.area += bearing_area(contact, contacts.patches[contact.patch]);
    sum.capacity += law.strength.compression;
  }
  sum.load = largest_load(scene, model);
  return sum;
}

std::string soft_text(const OnSupports& joints, const Assembly& assembly, const Compliance& compliance) {
  constexpr double kMostSinking = 0.01;  // of the height
  if (joints.rigid || joints.stiffness == 0.0) return "";
  const double height = height_of_free_blocks(assembly);
  const double sinking = joints.load.norm() / joints.stiffness * 0.5 * (joint_levels(assembly, height) + 1.0);
  if (!(sinking > kMostSinking * height)) return "";
  const std::string sinks = fmt::format("lets the model sink by about {:.2g} m, {:.2g} % of its height",
                                        sinking, 100.0 * sinking / height);
  if (compliance.relative)
    return fmt::format("joints.compliance.relative = {:g} {}; a smaller value is stiffer",
                       *compliance.relative, sinks);
  const bool area = compliance.per == Compliance::Per::area;
  return fmt::format(
      "joints.compliance.normal = {:g} {} {}; a stiffness instead of a compliance, or per {} "
      "meant? Without the key it is {:g} {}",
      compliance.normal, area ? "m3/N" : "m/N", sinks, area ? "point" : "area",
      Compliance::default_per(compliance.per).normal, area ? "m3/N" : "m/N");
}

std::string weak_text(const OnSupports& joints) {
  if (joints.area == 0.0 || joints.load.norm() <= joints.capacity) return "";
  return fmt::format(
      "the loads press on the supports with {:.3g} Pa on average, more than the compressive strength of "
      "{:.3g} Pa",
      joints.load.norm() / joints.area, joints.capacity / joints.area);
}

/// Edges and corners, whose forces no compressive strength limits where one is given or sought.
std::string unlimited_text(const Case& scene, const Assembly& assembly, const ContactSet& contacts) {
  const bool sought = scene.analysis.type == AnalysisType::limit &&
                      scene.analysis.limit.parameter == LimitSearch::Parameter::peak_stress;
  if (!sought && std::isinf(compressive_strengths(scene.joints).first)) return "";
  std::set<std::pair<int, int>> joints;
  for (const Contact& contact : contacts.points)
    if (contacts.patches[contact.patch].area == 0.0) joints.emplace(contact.block_a, contact.block_b);
  if (joints.empty()) return "";
  const auto [a, b] = *joints.begin();
  return fmt::format(
      "the blocks of {}, the first {} and {}, touch at edges or corners, which have no area: no compressive "
      "strength limits the forces there; give these blocks faces that bear, or check their forces in "
      "joints.csv",
      counted(joints.size(), "joint"), block_label(assembly, a), block_label(assembly, b));
}

/// Groups of joints with a law of their own, or whose friction varies, that no joint as built belongs to.
std::vector<std::string> idle_groups(const Case& scene, const Assembly& assembly,
                                     const ContactSet& contacts) {
  std::vector<std::pair<std::string, RingJoints>> groups;
  Joints joints = scene.joints;
  for (size_t i = 0; i < joints.rings.size(); ++i)
    groups.emplace_back(fmt::format("joints.rings[{}]", i), joints.rings[i]);
  if (const Analysis& analysis = scene.analysis;
      analysis.type == AnalysisType::limit && analysis.limit.joints) {
    groups.emplace_back("analysis.limit.joints", *analysis.limit.joints);
    joints.rings.push_back(*analysis.limit.joints);
  }
  const bool of_pieces = have_law_of_pieces(joints);
  std::vector<std::string> out;
  for (const auto& [key, group] : groups) {
    const auto is_of_group = [&](const Patch& patch) {
      return selects(group, joint_class(assembly, patch, of_pieces), patch.ring);
    };
    if (std::ranges::any_of(contacts.patches, is_of_group)) continue;
    out.push_back(fmt::format(
        "{}: no joint of kind {} belongs to rings {} to {}, so that it has no effect; a joint belongs to the "
        "ring of its upper block",
        key, to_string(group.sort), group.from, std::min(group.to, std::max(0, assembly.num_rings - 1))));
  }
  return out;
}

}  // namespace

std::vector<std::string> joint_warnings(const Case& scene, const Assembly& assembly,
                                        const ContactSet& contacts, bool rigid) {
  const OnSupports joints = joints_on_supports(scene, assembly, contacts);
  std::vector<std::string> warnings{rigid ? "" : soft_text(joints, assembly, scene.joints.compliance),
                                    unlimited_text(scene, assembly, contacts)};
  for (std::string& text : idle_groups(scene, assembly, contacts)) warnings.push_back(std::move(text));
  if (scene.joints.have_strength()) warnings.push_back(weak_text(joints));
  std::erase(warnings, "");
  return warnings;
}

}  // namespace cupola

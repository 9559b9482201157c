#include "solver/dynamics/soft_joints.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

#include <fmt/format.h>

#include "assembly/model/applied_loads.hpp"
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

}  // namespace

std::vector<std::string> soft_joints(const Case& scene, const Assembly& assembly,
                                     const ContactSet& contacts) {
  constexpr double kMostSinking = 0.01;  // of the height
  const Model model = make_model(scene, assembly);
  double stiffness = 0.0;  // N/m, of all joints on supports
  for (const Contact& contact : contacts.points) {
    if (assembly.blocks[contact.block_a].fixed == assembly.blocks[contact.block_b].fixed) continue;
    const double compliance = joint_law(model, contacts, contact, 0.0).compliance_normal;
    if (compliance == 0.0) return {};
    stiffness += 1.0 / compliance;
  }
  if (stiffness == 0.0) return {};
  Vec3 load =
      model.free_weight > 0.0 ? Vec3(model.free_weight * scene.loads.gravity.normalized()) : Vec3::Zero();
  for (const PointForce& force : applied_loads(scene.loads, assembly))
    if (!assembly.blocks[force.block].fixed) load += force.force;
  const double height = height_of_free_blocks(assembly);
  const double sinking = load.norm() / stiffness * 0.5 * (joint_levels(assembly, height) + 1.0);
  if (!(sinking > kMostSinking * height)) return {};
  const Compliance& compliance = scene.joints.compliance;
  const std::string sinks = fmt::format("lets the model sink by about {:.2g} m, {:.2g} % of its height",
                                        sinking, 100.0 * sinking / height);
  if (compliance.relative)
    return {fmt::format("joints.compliance.relative = {:g} {}; a smaller value is stiffer",
                        *compliance.relative, sinks)};
  const bool area = compliance.per == Compliance::Per::area;
  return {
      fmt::format("joints.compliance.normal = {:g} {} {}; a stiffness instead of a compliance, or per {} "
                  "meant? Without the key it is {:g} {}",
                  compliance.normal, area ? "m3/N" : "m/N", sinks, area ? "point" : "area",
                  Compliance::default_per(compliance.per).normal, area ? "m3/N" : "m/N")};
}

}  // namespace cupola

#include "solver/dynamics/weak_joints.hpp"

#include <fmt/format.h>

#include "assembly/model/applied_loads.hpp"
#include "solver/dynamics/model.hpp"

namespace cupola {

std::vector<std::string> weak_joints(const Case& scene, const Assembly& assembly,
                                     const ContactSet& contacts) {
  if (!scene.joints.have_strength()) return {};
  const Model model = make_model(scene, assembly);
  double area = 0.0, capacity = 0.0;  // m2, N
  for (const Contact& contact : contacts.points) {
    if (assembly.blocks[contact.block_a].fixed == assembly.blocks[contact.block_b].fixed) continue;
    area += contact.area;
    capacity += joint_law(model, contacts, contact, 0.0).strength.compression;
  }
  Vec3 load =
      model.free_weight > 0.0 ? Vec3(model.free_weight * scene.loads.gravity.normalized()) : Vec3::Zero();
  for (const PointForce& force : applied_loads(scene.loads, assembly))
    if (!assembly.blocks[force.block].fixed) load += force.force;
  if (area == 0.0 || load.norm() <= capacity) return {};
  return {
      fmt::format("the loads press on the supports with {:.3g} Pa on average, more than the compressive "
                  "strength of {:.3g} Pa",
                  load.norm() / area, capacity / area)};
}

}  // namespace cupola

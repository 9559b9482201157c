#include "postproc/tables/mesh_parts.hpp"

#include <algorithm>
#include <limits>

#include "assembly/base/process.hpp"
#include "postproc/tables/mesh_output.hpp"

namespace cupola {

int add_point(Mesh* mesh, const Vec3& p) {
  return mesh->add_point(p.x(), p.y(), p.z());
}

void append(const Vec3& v, MeshDoubles* values) {
  values->insert(values->end(), v.begin(), v.end());
}

std::vector<MeshArray> about(const Evaluation& e, double scale) {
  constexpr double unknown = std::numeric_limits<double>::quiet_NaN();
  return {{"title", 1, std::vector<std::string>{e.scene.title}},
          {"program_version", 1, std::vector<std::string>{program_version()}},
          {"solver_version", 1, std::vector<std::string>{e.summary.program_version}},
          {"case_hash", 1, std::vector<std::string>{e.summary.case_hash}},
          {"assembly_hash", 1, std::vector<std::string>{e.summary.assembly_hash}},
          {"threads", 1, MeshInts{e.summary.threads}},
          {"equilibrium_residual", 1, MeshDoubles{e.summary.equilibrium_residual.value_or(unknown)}},
          {"accuracy_quantity", 1, std::vector<std::string>{e.summary.accuracy.quantity}},
          {"accuracy_reached", 1, MeshDoubles{e.summary.accuracy.reached}},
          {"status", 1, std::vector<std::string>{to_string(e.summary.status)}},
          {"segment_scale_m_per_N", 1, MeshDoubles{scale}}};
}

double common_scale(const Evaluation& e) {
  double largest = 0.0;
  for (const Wrench& w : e.last.from_below) largest = std::max(largest, w.force.norm());
  for (const JointWrench& joint : e.last.joints.wrenches)
    largest = std::max(largest, joint.wrench.force.norm());
  return segment_scale(e.assembly, largest);
}

}  // namespace cupola

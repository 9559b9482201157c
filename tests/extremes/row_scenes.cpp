#include "tests/extremes/rows.hpp"

namespace cupola {

Case statics(double mu, double compliance, double tolerance) {
  Case input;
  input.joints.friction = mu;
  input.joints.compliance = {compliance, compliance, Compliance::Per::point};
  input.analysis.tolerance = tolerance;
  return input;
}

Case coulomb(Case input) {
  input.analysis.friction_law = FrictionLaw::coulomb;
  return input;
}

void set_compliances(const std::vector<double>& normal, const std::vector<double>& tangential, Case* input) {
  for (size_t k = 0; k < normal.size(); ++k) {
    RingJoints group;
    group.from = group.to = static_cast<int>(k);
    group.law.normal = normal[k];
    group.law.tangential = tangential[k];
    input->joints.rings.push_back(group);
  }
}

void label_blocks(const std::function<int(int)>& label, Assembly* assembly) {
  for (Part& part : assembly->parts)
    if (!assembly->blocks[part.block].fixed) part.ring = label(part.block);
}

const char* name_of(FrictionLaw law) {
  return law == FrictionLaw::coulomb ? "Coulomb's law" : "associated law";
}

Assembly pile(const std::vector<Vec3>& sizes) {
  Vec3 base = Vec3::Ones();
  for (const Vec3& size : sizes) base = base.cwiseMax(3.0 * size);
  std::vector<testing::BoxSpec> boxes{{.center = {0, 0, -0.5 * base.z()}, .size = base, .fixed = true}};
  double height = 0.0;
  for (const Vec3& size : sizes) {
    boxes.push_back({.center = {0, 0, height + 0.5 * size.z()},
                     .size = size,
                     .ring = static_cast<int>(boxes.size()) - 1});
    height += size.z();
  }
  return testing::make_boxes(boxes);
}

const std::vector<ExtremeScene>& extreme_scenes() {
  static const std::vector<ExtremeScene> rows = [] {
    Rows all;
    add_contrast_rows(&all);
    add_friction_rows(&all);
    add_critical_rows(&all);
    add_shape_rows(&all);
    add_scale_rows(&all);
    add_edge_rows(&all);
    add_large_rows(&all);
    add_motion_rows(&all);
    add_random_rows(&all);
    return all;
  }();
  return rows;
}

}  // namespace cupola

#include "solver/analysis/statics/static_step.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <vector>

#include "assembly/model/joint_rule.hpp"

namespace cupola {
namespace {

/// m/N, of a contact point, but for slivers: faces that do not match, or no longer, meet in points of hardly
/// any area, whose compliance per area has no bound, and which bear nothing. 0: all joints are rigid.
double largest_compliance(const Model& model, const State& start, const ContactSet& contacts) {
  constexpr double kSliver = 0.01;  // of the mean area of the points that give way
  std::vector<double> compliances;
  double area = 0.0;
  int giving_way = 0;
  for (const Contact& contact : contacts.points) {
    compliances.push_back(joint_law(model, contacts, contact, start.time).compliance_normal);
    if (compliances.back() == 0.0) continue;
    area += contact.area;
    ++giving_way;
  }
  double largest = 0.0;
  for (size_t i = 0; i < compliances.size(); ++i)
    if (giving_way * contacts.points[i].area >= kSliver * area) largest = std::max(largest, compliances[i]);
  return largest;
}

}  // namespace

double imposed_displacement(const Model& model, const State& start, const StaticOptions& options) {
  std::vector<Pose> moved = start.poses;
  place_supports(*model.assembly, model.support_motions, start.time + options.time_advance, &moved);
  double largest = 0.0;
  for (size_t i = 0; i < moved.size(); ++i)
    largest = std::max(largest, (moved[i].p_WB - start.poses[i].p_WB).norm());
  return largest;
}

StepOptions static_step_options(const StaticOptions& options, double h) {
  StepOptions step;
  step.h = h;
  step.recovery_speed = std::numeric_limits<double>::infinity();
  step.time_advance = options.time_advance;
  return step;
}

double first_static_step(const Model& model, const State& start, const ContactSet& contacts,
                         double acceleration, const StaticOptions& options) {
  constexpr double kContraction = 1e-3;
  // Shells sink further than their columns shorten. A margin of 3 lets two iterations of a large dome reach
  // 1e-6; h grows where it does not suffice.
  constexpr double kMargin = 3.0;
  int at_supports = 0;
  for (const Contact& contact : contacts.points)
    at_supports += model.free_index[contact.block_a] == ContactProblem::kFixed ||
                   model.free_index[contact.block_b] == ContactProblem::kFixed;
  double load = 0.0;
  const VecX f = applied_forces(model, start, start.time);
  for (Eigen::Index i = 0; i < f.size(); i += 6) load += f.segment<3>(i).norm();
  const double courses =
      model.assembly->num_rings > 0 ? model.assembly->num_rings : std::cbrt(model.num_free());
  double gap = 0.0;
  for (const Contact& contact : contacts.points) gap = std::max(gap, contact.gap);
  const double compliance = largest_compliance(model, start, contacts);
  const double displacement = courses * gap + courses * compliance * load / std::max(1, at_supports) +
                              imposed_displacement(model, start, options) +
                              (options.control ? options.control->displacement : 0.0);
  // Rigid joints that close but for rounding of the geometry: no step is too long, and a short one would take
  // rounding for gaps.
  constexpr double kRounding = 1e-12;  // of the smallest block
  if (displacement == 0.0 ||
      (compliance == 0.0 && displacement <= kRounding * courses * smallest_block_size(*model.assembly)))
    return 1.0;
  return kMargin * std::sqrt(displacement / (acceleration * kContraction));
}

double largest_static_step(const Model& model, const State& start, const ContactSet& contacts) {
  constexpr double kNegligible = 1e-12;
  const double compliance = largest_compliance(model, start, contacts);
  if (compliance == 0.0) return std::numeric_limits<double>::infinity();
  double mass = 0.0;
  for (const int block : model.free_blocks) mass += model.assembly->blocks[block].mass;
  return std::sqrt(compliance * mass / std::max(1, model.num_free()) / kNegligible);
}

}  // namespace cupola

#include "solver/analysis/admissible/force_functional.hpp"

#include <cmath>
#include <limits>

#include "assembly/model/block_names.hpp"
#include "solver/dynamics/time_step.hpp"

namespace cupola {

double ForceFunctional::operator()(const JointForces& forces) const {
  double value = constant;
  for (const auto& [i, coefficient] : contacts) value += coefficient.dot(forces.contacts[i]);
  for (size_t i = 0; i < ties.size(); ++i) value += ties[i] * forces.ties[i];
  return value;
}

double ForceFunctional::size(const JointForces& forces) const {
  double sum = std::abs(constant);
  for (const auto& [i, coefficient] : contacts) sum += std::abs(coefficient.dot(forces.contacts[i]));
  for (size_t i = 0; i < ties.size(); ++i) sum += std::abs(ties[i] * forces.ties[i]);
  return sum;
}

VecX ForceFunctional::coefficients(const ContactSet& set) const {
  const Eigen::Index nc = std::ssize(set.points);
  VecX c = VecX::Zero(3 * (nc + static_cast<Eigen::Index>(ties.size())));
  for (const auto& [i, coefficient] : contacts)
    c.segment<3>(3 * i) = contact_frame(set.points[i].normal).transpose() * coefficient;
  for (size_t i = 0; i < ties.size(); ++i) c[3 * (nc + static_cast<Eigen::Index>(i))] = ties[i];
  return c;
}

double RangeObjective::operator()(const JointForces& forces) const {
  if (!over) return value(forces);
  constexpr double kNothing = 1e-9;  // of forces that cancel: the accuracy of a solve
  const double denominator = (*over)(forces);
  return std::abs(denominator) > kNothing * over->size(forces) ? value(forces) / denominator
                                                               : std::numeric_limits<double>::quiet_NaN();
}

std::string ForceScene::label(int block) const {
  return block_label(assembly, block);
}

ForceFunctional ForceScene::zero() const {
  return {{}, std::vector<double>(model.ties.size()), 0.0};
}

void ForceScene::add(const BlockPair& pair, int block, const Vec3& direction, ForceFunctional* f) const {
  for (const int i : pair.contacts)
    f->add(i, contacts.points[i].block_b == block ? direction : Vec3(-direction));
}

}  // namespace cupola

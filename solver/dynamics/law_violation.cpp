#include "solver/dynamics/law_violation.hpp"

#include <algorithm>

#include "assembly/base/error.hpp"

namespace cupola {

std::vector<double> law_violations(const ContactSet& contacts, const VecX& gamma, const VecX& errors) {
  constexpr double kSmallJoint = 0.01;  // of the mean joint force
  const auto num_contacts = static_cast<Eigen::Index>(contacts.points.size());
  CUPOLA_ASSERT(errors.size() >= num_contacts && gamma.size() == 3 * errors.size());
  std::vector<double> joint_impulse(contacts.patches.size(), 0.0);
  for (Eigen::Index i = 0; i < num_contacts; ++i)
    joint_impulse[contacts.points[i].patch] += gamma.segment<3>(3 * i).norm();
  double sum = 0.0;
  int loaded = 0;
  for (const double impulse : joint_impulse) {
    sum += impulse;
    loaded += impulse > 0.0 ? 1 : 0;
  }
  const double smallest = loaded > 0 ? kSmallJoint * sum / loaded : 0.0;
  std::vector<double> violations(contacts.points.size(), 0.0);
  for (Eigen::Index i = 0; i < num_contacts; ++i) {
    const double scale = std::max(joint_impulse[contacts.points[i].patch], smallest);
    if (errors[i] != 0.0) violations[i] = scale > 0.0 ? errors[i] / scale : 1.0;
  }
  return violations;
}

}  // namespace cupola

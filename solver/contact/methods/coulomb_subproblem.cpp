#include "solver/contact/methods/coulomb_subproblem.hpp"

#include <algorithm>
#include <utility>

namespace cupola {

VecX CoulombSubproblem::velocity(const VecX& w) const {
  VecX y = relative_velocity(p, w) + p.b;
  for (int i = 0; i < p.num_contacts(); ++i) y.segment<3>(3 * i) -= R[i] * centre.segment<3>(3 * i);
  return y;
}

VecX CoulombSubproblem::impulses(const VecX& y) const {
  VecX gamma(y.size());
  for (int i = 0; i < p.num_contacts(); ++i)
    gamma.segment<3>(3 * i) = contact_impulse(contact(i), y.segment<3>(3 * i));
  return gamma;
}

std::vector<Mat3> CoulombSubproblem::stiffnesses(const VecX& y) const {
  std::vector<Mat3> G(p.num_contacts());
  for (int i = 0; i < p.num_contacts(); ++i) G[i] = contact_stiffness(contact(i), y.segment<3>(3 * i));
  return G;
}

double CoulombSubproblem::distance_to_centre(const VecX& gamma) const {
  double largest = 0.0;
  for (int i = 0; i < p.num_contacts(); ++i)
    largest = std::max(largest, R[i] * (gamma - centre).segment<3>(3 * i).norm());
  return root_mass * largest;
}

CoulombPoint point_at(const CoulombSubproblem& sub, VecX w) {
  CoulombPoint point{std::move(w), {}, {}, {}};
  point.y = sub.velocity(point.w);
  point.gamma = sub.impulses(point.y);
  point.F = point.w - sub.p.v_star - generalized_impulse(sub.p, point.gamma);
  return point;
}

StickingSystem sticking_system(const CoulombSubproblem& sub) {
  const ContactProblem& p = sub.p;
  StickingSystem system;
  const VecX y = sub.velocity(VecX::Zero(p.v_star.size()));
  VecX impulse(p.b.size());
  for (int i = 0; i < p.num_contacts(); ++i) {
    system.G.push_back(sticking_stiffness(sub.contact(i)));
    impulse.segment<3>(3 * i) = -system.G[i] * y.segment<3>(3 * i);
  }
  system.rhs = p.v_star + generalized_impulse(p, impulse);
  return system;
}

bool keeps_sticking(const CoulombSubproblem& sub, const CoulombPoint& point) {
  constexpr double kShare = 0.03, kRounding = 1e-12;
  for (Eigen::Index k = 0; k < point.F.size(); k += 6) {
    const auto free = sub.p.v_star.segment<6>(k);
    const double by_contacts = (point.w.segment<6>(k) - free).norm();
    if (!(point.F.segment<6>(k).norm() <= kShare * by_contacts + kRounding * free.norm())) return false;
  }
  return true;
}

}  // namespace cupola

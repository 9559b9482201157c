#include "solver/conic/dry_problem.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace cupola {

DryProblem::DryProblem(const ConicProblem& strong, Limits limits)
    : strong_(strong), limits_(limits), dry_(strong) {
  dry_.contacts.strength.clear();
  dry_.strength_columns.clear();
  largest_load_ = strong.load.size() > 0 ? strong.load.cwiseAbs().maxCoeff() : 0.0;
  for (int i = 0; i < strong.contacts.num_contacts(); ++i) add_limits(i);
  shift_forces();
}

OfMultipliers DryProblem::linear(int contact, double ContactStrength::*part) const {
  OfMultipliers x{
      strong_.contacts.strength.empty() ? ContactStrength{}.*part : strong_.contacts.strength[contact].*part,
      VecX::Zero(strong_.load_columns.cols())};
  for (size_t j = 0; j < strong_.strength_columns.size(); ++j)
    x.slope[static_cast<Eigen::Index>(j)] = strong_.strength_columns[j][contact].*part;
  return x;
}

OfMultipliers DryProblem::apex(int contact) const {
  const double mu = strong_.contacts.mu[contact];
  OfMultipliers cohesion = linear(contact, &ContactStrength::cohesion);
  const bool none = cohesion.constant == 0.0 && cohesion.slope.isZero(0.0);
  if (mu == 0.0 && !none)
    throw std::invalid_argument(
        fmt::format("conic problem: contact {} has cohesion but no friction", contact));
  if (mu == 0.0) return linear(contact, &ContactStrength::tension);
  return {cohesion.constant / mu, cohesion.slope / mu};
}

void DryProblem::add_limits(int contact) {
  constexpr double kFar = 1e3;  // times the largest load of a block
  const OfMultipliers sigma = apex(contact), tension = linear(contact, &ContactStrength::tension),
                      compression = linear(contact, &ContactStrength::compression);
  if (tension.constant < sigma.constant || (tension.slope.array() < sigma.slope.array()).any())
    dry_.limits.push_back({contact, -1.0, {tension.constant - sigma.constant, tension.slope - sigma.slope}});
  if (!std::isfinite(compression.constant) || !compression.slope.allFinite()) return;
  if (limits_ == Limits::near_loads && largest_load_ > 0.0 && compression.constant > kFar * largest_load_)
    left_out_.push_back(contact);
  else
    dry_.limits.push_back(
        {contact, 1.0, {compression.constant + sigma.constant, compression.slope + sigma.slope}});
}

/// Puts y - (sigma, 0, 0) for gamma.
void DryProblem::shift_forces() {
  const Eigen::Index nt = strong_.load_columns.cols(), size = strong_.cost.size();
  VecX constant = VecX::Zero(size);
  MatX slope = MatX::Zero(size, nt);
  for (int i = 0; i < strong_.contacts.num_contacts(); ++i) {
    const OfMultipliers sigma = apex(i);
    constant[3 * i] = sigma.constant;
    if (nt > 0) slope.row(3 * i) = sigma.slope.transpose();
  }
  dry_.load -= generalized_impulse(strong_.contacts, constant);
  for (Eigen::Index j = 0; j < nt; ++j)
    dry_.load_columns.col(j) -= generalized_impulse(strong_.contacts, VecX(slope.col(j)));
  dry_.multiplier_cost -= slope.transpose() * strong_.cost;
  dry_.row_values += strong_.rows.transpose() * constant;
  dry_.row_multipliers -= slope.transpose() * strong_.rows;
}

bool DryProblem::solves(const ConicSolution& original) const {
  if (left_out_.empty()) return true;
  return original.outcome != ConicOutcome::unbounded && std::ranges::all_of(left_out_, [&](int i) {
           return original.gamma[3 * i] <= strength_at(strong_, i, original.multipliers).compression;
         });
}

ConicSolution DryProblem::original(const ConicSolution& dry) const {
  ConicSolution solution = dry;
  const double constants = dry.outcome == ConicOutcome::unbounded ? 0.0 : 1.0;  // a ray has no constant part
  for (int i = 0; i < strong_.contacts.num_contacts(); ++i) {
    const OfMultipliers sigma = apex(i);
    solution.gamma[3 * i] -= constants * sigma.constant + sigma.slope.dot(dry.multipliers);
  }
  return solution;
}

}  // namespace cupola

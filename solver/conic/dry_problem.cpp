#include "solver/conic/dry_problem.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace cupola {
namespace {

constexpr int kFixed = ContactProblem::kFixed;
/// Row of an added block that carries a condition: of its rotations, that about y, which plane problems keep.
constexpr int kLimitRow = 4;

Mat63 limit_row(double entry) {
  Mat63 row = Mat63::Zero();
  row(kLimitRow, 0) = entry;
  return row;
}

}  // namespace

DryProblem::DryProblem(const ConicProblem& strong, Limits limits)
    : strong_(strong), limits_(limits), dry_(strong) {
  dry_.contacts.strength.clear();
  dry_.strength_columns.clear();
  scale_ = std::max(strong.load.size() > 0 ? strong.load.cwiseAbs().maxCoeff() : 0.0, 1e-300);
  for (int i = 0; i < strong.contacts.num_contacts(); ++i) add_limits(i);
  shift_forces();
  fill_vectors();
}

DryProblem::Linear DryProblem::linear(int contact, double ContactStrength::*part) const {
  Linear x{
      strong_.contacts.strength.empty() ? ContactStrength{}.*part : strong_.contacts.strength[contact].*part,
      VecX::Zero(strong_.load_columns.cols())};
  for (size_t j = 0; j < strong_.strength_columns.size(); ++j)
    x.slope[static_cast<Eigen::Index>(j)] = strong_.strength_columns[j][contact].*part;
  return x;
}

DryProblem::Linear DryProblem::apex(int contact) const {
  const double mu = strong_.contacts.mu[contact];
  Linear cohesion = linear(contact, &ContactStrength::cohesion);
  const bool none = cohesion.constant == 0.0 && cohesion.slope.isZero(0.0);
  if (mu == 0.0 && !none)
    throw std::invalid_argument(
        fmt::format("conic problem: contact {} has cohesion but no friction", contact));
  if (mu == 0.0) return linear(contact, &ContactStrength::tension);
  return {cohesion.constant / mu, cohesion.slope / mu};
}

void DryProblem::add_limits(int contact) {
  const Linear sigma = apex(contact), tension = linear(contact, &ContactStrength::tension),
               compression = linear(contact, &ContactStrength::compression);
  constexpr double kFar = 1e3;  // times the largest load of a block
  bool pushed = std::isfinite(compression.constant) && compression.slope.allFinite();
  if (pushed && limits_ == Limits::near_loads && compression.constant > kFar * scale_) {
    left_out_.push_back(contact);
    pushed = false;
  }
  const bool pulled =
      tension.constant < sigma.constant || (tension.slope.array() < sigma.slope.array()).any();
  if (!pushed && !pulled) return;
  const auto difference = [](const Linear& a, const Linear& b) -> Linear {
    return {a.constant - b.constant, a.slope - b.slope};
  };
  const Linear most{compression.constant + sigma.constant, compression.slope + sigma.slope},
      least = difference(sigma, tension);
  const auto entry = [this](const Linear& x) {
    return std::min(1.0, scale_ / std::max(std::abs(x.constant), scale_));
  };
  const Mat63 none = Mat63::Zero();
  if (!pushed) {
    const double k = entry(least);
    const int block = add_block({k * least.constant, k * least.slope});
    split(contact, block, limit_row(k));
    add_contact(kFixed, block, none, limit_row(-k), 0.0);
    return;
  }
  const double k = entry(most);
  const int block = add_block({k * most.constant, k * most.slope});
  split(contact, block, limit_row(k));
  if (!pulled) {
    add_contact(kFixed, block, none, limit_row(k), 0.0);
    return;
  }
  const Linear range = difference(most, least);
  const int second = add_block({k * range.constant, k * range.slope});
  add_contact(block, second, limit_row(k), limit_row(k), 0.0);
  add_contact(kFixed, second, none, limit_row(k), 0.0);
}

int DryProblem::add_block(const Linear& right_side) {
  right_sides_.push_back(right_side);
  return strong_.contacts.num_blocks() + static_cast<int>(right_sides_.size()) - 1;
}

/// Puts `block` between the sides of a contact; `row` of the contact's force enters the block's condition.
void DryProblem::split(int contact, int block, const Mat63& row) {
  ContactProblem& p = dry_.contacts;
  const int b = p.block_b[contact];
  const Mat63 D_b = p.D_b[contact];
  Mat63 forces = Mat63::Zero();  // in world axes, of which plane problems keep two
  forces.topRows<3>() = (b == kFixed ? p.D_a[contact] : D_b).topRows<3>();
  p.block_b[contact] = block;
  p.D_b[contact] = forces + row;
  add_contact(block, b, -forces, D_b, p.mu[contact]);
}

void DryProblem::add_contact(int a, int b, const Mat63& D_a, const Mat63& D_b, double mu) {
  ContactProblem& p = dry_.contacts;
  p.block_a.push_back(a);
  p.block_b.push_back(b);
  p.D_a.push_back(D_a);
  p.D_b.push_back(D_b);
  added_mu_.push_back(mu);
}

/// Puts y - (sigma, 0, 0) for gamma.
void DryProblem::shift_forces() {
  const Eigen::Index nt = strong_.load_columns.cols(), size = strong_.cost.size();
  VecX constant = VecX::Zero(size);
  MatX slope = MatX::Zero(size, nt);
  for (int i = 0; i < strong_.contacts.num_contacts(); ++i) {
    const Linear sigma = apex(i);
    constant[3 * i] = sigma.constant;
    slope.row(3 * i) = sigma.slope.transpose();
  }
  dry_.load -= generalized_impulse(strong_.contacts, constant);
  for (Eigen::Index j = 0; j < nt; ++j)
    dry_.load_columns.col(j) -= generalized_impulse(strong_.contacts, VecX(slope.col(j)));
  dry_.multiplier_cost -= slope.transpose() * strong_.cost;
  dry_.row_values += strong_.rows.transpose() * constant;
  dry_.row_multipliers -= slope.transpose() * strong_.rows;
}

void DryProblem::fill_vectors() {
  ContactProblem& p = dry_.contacts;
  double mass = 0.0;
  for (const Mat6& M : strong_.contacts.M) mass += M(0, 0) / strong_.contacts.num_blocks();
  p.M.resize(p.M.size() + right_sides_.size(), mass * Mat6::Identity());
  const Eigen::Index nb = p.num_blocks(), old_nb = strong_.contacts.num_blocks();
  const Eigen::Index old_nc = p.mu.size(), nc = old_nc + std::ssize(added_mu_);
  p.mu.conservativeResize(nc);
  std::ranges::copy(added_mu_, p.mu.begin() + old_nc);
  p.v_star = VecX::Zero(6 * nb);
  p.b = VecX::Zero(3 * nc);
  p.E = VecX::Zero(3 * nc);
  const auto lengthen = [](MatX* m, Eigen::Index rows) {
    const Eigen::Index old = m->rows();
    m->conservativeResize(rows, Eigen::NoChange);
    m->bottomRows(rows - old).setZero();
  };
  dry_.load.conservativeResize(6 * nb);
  dry_.load.tail(6 * (nb - old_nb)).setZero();
  lengthen(&dry_.load_columns, 6 * nb);
  dry_.cost.conservativeResize(3 * nc);
  dry_.cost.tail(3 * (nc - old_nc)).setZero();
  lengthen(&dry_.rows, 3 * nc);
  for (size_t k = 0; k < right_sides_.size(); ++k) {
    const Eigen::Index row = 6 * (old_nb + static_cast<Eigen::Index>(k)) + kLimitRow;
    dry_.load[row] = -right_sides_[k].constant;
    dry_.load_columns.row(row) = -right_sides_[k].slope.transpose();
  }
}

bool DryProblem::solves(const ConicSolution& original) const {
  if (left_out_.empty()) return true;
  return original.outcome != ConicOutcome::unbounded && std::ranges::all_of(left_out_, [&](int i) {
           return original.gamma[3 * i] <= strength_at(strong_, i, original.multipliers).compression;
         });
}

ConicSolution DryProblem::original(const ConicSolution& dry) const {
  ConicSolution solution = dry;
  solution.gamma.conservativeResize(strong_.cost.size());
  solution.v.conservativeResize(strong_.load.size());
  const double constants = dry.outcome == ConicOutcome::unbounded ? 0.0 : 1.0;  // a ray has no constant part
  for (int i = 0; i < strong_.contacts.num_contacts(); ++i) {
    const Linear sigma = apex(i);
    solution.gamma[3 * i] -= constants * sigma.constant + sigma.slope.dot(dry.multipliers);
  }
  return solution;
}

}  // namespace cupola

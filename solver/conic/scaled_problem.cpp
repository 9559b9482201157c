#include "solver/conic/scaled_problem.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

#include <fmt/format.h>

namespace cupola {
namespace {

double positive_or_one(double x) {
  return x > 0.0 ? x : 1.0;
}

double largest(const Eigen::Ref<const VecX>& x) {
  return x.size() > 0 ? x.cwiseAbs().maxCoeff() : 0.0;
}

}  // namespace

void check_sizes(const ConicProblem& p) {
  const auto check = [](const char* name, Eigen::Index size, Eigen::Index expected) {
    if (size != expected)
      throw std::invalid_argument(
          fmt::format("conic problem: {} has {} entries, expected {}", name, size, expected));
  };
  const Eigen::Index nb = p.contacts.num_blocks(), nc = p.contacts.num_contacts();
  const Eigen::Index nt = p.load_columns.cols(), nq = p.rows.cols();
  check("the load", p.load.size(), 6 * nb);
  check("the cost", p.cost.size(), 3 * nc);
  if (nt > 0) check("a load column", p.load_columns.rows(), 6 * nb);
  check("the cost of the multipliers", p.multiplier_cost.size(), nt);
  if (nq > 0) check("a row", p.rows.rows(), 3 * nc);
  check("the row coefficients of the multipliers", p.row_multipliers.size(), nt * nq);
  check("the row values", p.row_values.size(), nq);
  if (!p.contacts.strength.empty()) check("the strength", std::ssize(p.contacts.strength), nc);
  if (!p.strength_columns.empty()) check("the strength per multiplier", std::ssize(p.strength_columns), nt);
  for (const auto& column : p.strength_columns) check("a strength per multiplier", std::ssize(column), nc);
}

ScaledConicProblem scaled(const ConicProblem& p) {
  ScaledConicProblem s{{}, whiten(p.contacts), 1.0, 1.0, {}, {}};
  ConicProblem& q = s.problem;
  q.contacts = p.contacts;
  const int nb = p.contacts.num_blocks();
  double mass = 0.0;
  for (const Mat6& M : p.contacts.M) mass += M.topLeftCorner<3, 3>().trace() / (3.0 * nb);
  const double root_mass = std::sqrt(positive_or_one(mass));
  for (Mat6& L_inverse : s.white.L_inverse) L_inverse *= root_mass;

  q.load = s.white.whiten_impulse(p.load);
  s.force = positive_or_one(largest(q.load));
  q.load /= s.force;
  const Eigen::Index nt = p.load_columns.cols(), nq = p.rows.cols();
  q.load_columns.resize(6 * nb, nt);
  s.multiplier.resize(nt);
  for (Eigen::Index j = 0; j < nt; ++j) {
    const VecX column = s.white.whiten_impulse(p.load_columns.col(j));
    s.multiplier[j] = s.force / positive_or_one(largest(column));
    q.load_columns.col(j) = column * (s.multiplier[j] / s.force);
  }
  q.cost = s.force * p.cost;
  q.multiplier_cost = p.multiplier_cost.cwiseProduct(s.multiplier);
  s.objective = positive_or_one(std::max(largest(q.cost), largest(q.multiplier_cost)));
  q.cost /= s.objective;
  q.multiplier_cost /= s.objective;
  q.rows = s.force * p.rows;
  q.row_multipliers = s.multiplier.asDiagonal() * p.row_multipliers;
  s.row.resize(nq);
  for (Eigen::Index k = 0; k < nq; ++k) {
    s.row[k] = positive_or_one(std::max(largest(q.rows.col(k)), largest(q.row_multipliers.col(k))));
    q.rows.col(k) /= s.row[k];
    q.row_multipliers.col(k) /= s.row[k];
  }
  q.row_values = p.row_values.cwiseQuotient(s.row);
  q.limits = p.limits;
  for (NormalLimit& limit : q.limits) {
    limit.bound.constant /= s.force;
    limit.bound.slope = limit.bound.slope.cwiseProduct(s.multiplier) / s.force;
  }
  return s;
}

}  // namespace cupola

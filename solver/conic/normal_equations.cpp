#include "solver/conic/normal_equations.hpp"

#include <cmath>

#include <Eigen/LU>

namespace cupola {

NormalEquations::NormalEquations(const ScaledConicProblem& problem)
    : p_(problem.problem), white_(problem.white), graph_(contact_graph(white_.given)) {}

VecX NormalEquations::times_V(const VecX& x) const {
  VecX y(x.size());
  for (int i = 0; i < p_.contacts.num_contacts(); ++i)
    y.segment<3>(3 * i).noalias() = V_[i] * x.segment<3>(3 * i);
  return y;
}

VecX NormalEquations::times_V_transposed(const VecX& x) const {
  VecX y(x.size());
  for (int i = 0; i < p_.contacts.num_contacts(); ++i)
    y.segment<3>(3 * i).noalias() = V_[i].transpose() * x.segment<3>(3 * i);
  return y;
}

bool NormalEquations::factorize(std::vector<Mat3> V, const MatX& coupling, const MatX& corner) {
  // Relative to the diagonal of a block, of the order of its rounding: contacts without friction, or blocks
  // that nothing holds, leave motions that change no distance.
  constexpr double kRegularisation = 1e-15;
  V_ = std::move(V);
  std::vector<Mat3> G;
  G.reserve(V_.size());
  for (const Mat3& V_i : V_) G.push_back(V_i.transpose() * V_i);
  BlockMatrix H = assemble_stiffness(white_, graph_, G);
  for (Mat6& A : H.diagonal) {
    const double largest = A.diagonal().maxCoeff();
    if (!std::isfinite(largest)) return false;
    A.diagonal().array() += kRegularisation * (largest > 0.0 ? largest : 1.0);
  }
  if (!factor_.factorize(graph_.pattern, H)) return false;

  const Eigen::Index nq = p_.rows.cols(), nt = p_.load_columns.cols();
  columns_.resize(p_.load.size(), nq + nt);
  on_contacts_.resize(p_.cost.size(), nq + nt);
  on_contacts_.leftCols(nq) = p_.rows;
  on_contacts_.rightCols(nt) = coupling;
  MatX rest = MatX::Zero(nq + nt, nq + nt);
  for (Eigen::Index k = 0; k < nq + nt; ++k) {
    const VecX scaled = times_G(on_contacts_.col(k));
    columns_.col(k) = -generalized_impulse(white_, scaled);
    rest.col(k) = on_border(scaled);
  }
  columns_.rightCols(nt) -= p_.load_columns;
  rest.bottomLeftCorner(nt, nq) += p_.row_multipliers;
  rest.topRightCorner(nq, nt) += p_.row_multipliers.transpose();
  rest.bottomRightCorner(nt, nt) -= corner;
  solved_.resize(columns_.rows(), columns_.cols());
  for (Eigen::Index k = 0; k < columns_.cols(); ++k) solved_.col(k) = solve(VecX(columns_.col(k)));
  schur_ = rest - columns_.transpose() * solved_;
  return solved_.allFinite();
}

VecX NormalEquations::multiply(const VecX& w) const {
  const VecX v = white_.to_v(w);
  VecX product = VecX::Zero(v.size());
  for (int i = 0; i < white_.given.num_contacts(); ++i) {
    const Vec3 scaled = V_[i] * relative_velocity(white_.given, i, v);
    add_impulse(white_.given, i, V_[i].transpose() * scaled, &product);
  }
  return white_.whiten_impulse(product);
}

VecX NormalEquations::solve(const VecX& f) const {
  constexpr int kMaxIterations = 8;
  // At 1e2 limits of `octagon_circular` lose digits, from 3e4 on searches for the friction of tied domes stall.
  constexpr double kMostGrowth = 3e3;  // of the norm of x
  constexpr double kEnough = 1e-8;     // of the norm of f; refinement by the rows themselves does the rest
  VecX x = factor_.solve(f);
  const double most = kMostGrowth * x.norm();
  VecX r = f - multiply(x);
  const double enough = kEnough * f.norm();
  VecX best = x;
  double least = r.norm();
  if (least <= enough) return best;
  VecX z = factor_.solve(r), direction = z;
  double rz = r.dot(z);
  for (int k = 0; k < kMaxIterations; ++k) {
    const VecX product = multiply(direction);
    const double curvature = direction.dot(product);
    if (!(curvature > 0.0) || !(rz > 0.0)) break;
    x += rz / curvature * direction;
    r -= rz / curvature * product;
    if (x.norm() > most) break;
    if (r.norm() < least) {
      least = r.norm();
      best = x;
    }
    if (least <= enough || k + 1 == kMaxIterations) break;
    z = factor_.solve(r);
    const double next = r.dot(z);
    direction = z + next / rz * direction;
    rz = next;
  }
  return best;
}

NormalEquations::Unknowns NormalEquations::solve(const VecX& f, const VecX& border) const {
  VecX v = solve(f);
  if (border.size() == 0) return {v, border};
  const VecX rest = schur_.fullPivLu().solve(border - columns_.transpose() * v);
  v -= solved_ * rest;
  return {v, rest};
}

}  // namespace cupola

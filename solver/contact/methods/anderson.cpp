#include "solver/contact/methods/anderson.hpp"

#include <algorithm>

#include <Eigen/QR>

#include "assembly/base/error.hpp"

namespace cupola {

void Anderson::restart() {
  dg_.clear();
  df_.clear();
  last_f_.resize(0);
}

VecX Anderson::next(const VecX& x, const VecX& g) {
  CUPOLA_ASSERT(x.size() == g.size());
  constexpr double kGrowth = 10.0;  // kinks of the map may raise the residual temporarily, but not this much
  const VecX f = g - x;
  const double residual = f.norm();
  if (last_f_.size() == f.size()) {
    dg_.push_back(g - last_g_);
    df_.push_back(f - last_f_);
    smallest_residual_ = std::min(smallest_residual_, residual);
  } else {
    smallest_residual_ = residual;
  }
  if (residual > kGrowth * smallest_residual_) {
    restart();
    smallest_residual_ = residual;
  }
  if (static_cast<int>(df_.size()) > depth_) {
    dg_.pop_front();
    df_.pop_front();
  }
  last_g_ = g;
  last_f_ = f;
  if (df_.empty()) return g;

  Eigen::MatrixXd F(f.size(), static_cast<Eigen::Index>(df_.size()));
  for (Eigen::Index j = 0; j < F.cols(); ++j) F.col(j) = df_[j];
  Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(F);
  qr.setThreshold(1e-10);  // nearly parallel differences contain only rounding
  const VecX theta = qr.solve(f);
  VecX result = g;
  for (Eigen::Index j = 0; j < F.cols(); ++j) result -= theta[j] * dg_[j];
  return result.allFinite() ? result : g;
}

}  // namespace cupola

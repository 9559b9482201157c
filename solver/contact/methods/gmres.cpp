#include "solver/contact/methods/gmres.hpp"

#include <cmath>
#include <vector>

namespace cupola {

int gmres(const std::function<VecX(const VecX&)>& multiply,
          const std::function<VecX(const VecX&)>& precondition, const VecX& rhs, double forcing,
          int max_iterations, VecX* x) {
  const double norm = rhs.norm();
  if (!(norm > 0.0) || !std::isfinite(norm)) return 0;
  std::vector<VecX> basis{rhs / norm}, preconditioned;
  Eigen::MatrixXd R = Eigen::MatrixXd::Zero(max_iterations + 1, max_iterations);  // rotated Hessenberg matrix
  VecX g = VecX::Zero(max_iterations + 1), c(max_iterations), s(max_iterations);
  g[0] = norm;
  for (int k = 0; k < max_iterations; ++k) {
    preconditioned.push_back(precondition(basis[k]));
    VecX w = multiply(preconditioned[k]);
    for (int i = 0; i <= k; ++i) {  // modified Gram-Schmidt
      R(i, k) = basis[i].dot(w);
      w -= R(i, k) * basis[i];
    }
    const double below = w.norm();
    if (!std::isfinite(below)) return 0;
    for (int i = 0; i < k; ++i) {  // earlier rotations
      const double r = c[i] * R(i, k) + s[i] * R(i + 1, k);
      R(i + 1, k) = -s[i] * R(i, k) + c[i] * R(i + 1, k);
      R(i, k) = r;
    }
    const double length = std::hypot(R(k, k), below);
    if (!(length > 0.0)) return 0;
    c[k] = R(k, k) / length;
    s[k] = below / length;
    R(k, k) = length;
    g[k + 1] = -s[k] * g[k];
    g[k] *= c[k];
    if (std::abs(g[k + 1]) <= forcing * norm) {
      const int n = k + 1;
      const VecX weights = R.topLeftCorner(n, n).triangularView<Eigen::Upper>().solve(g.head(n));
      x->setZero(rhs.size());
      for (int i = 0; i < n; ++i) *x += weights[i] * preconditioned[i];
      return x->allFinite() ? n : 0;
    }
    basis.push_back(w / below);
  }
  return 0;
}

}  // namespace cupola

#pragma once

#include <vector>

#include "solver/conic/scaled_problem.hpp"
#include "solver/contact/blocks/block_cholesky.hpp"

namespace cupola {

/// The normal equations of one iteration of solve_conic(), in whitened unknowns:
///
///     [ D G D^T    -D G Q   -P  ] [ v ]   [ f ]
///     [ -Q^T G D^T  Q^T G Q  R^T ] [ q ] = [ g ]
///     [ -P^T        R        0   ] [ t ]   [ h ]
///
/// Limits (normal_limits.hpp) couple t with the contacts: the last column gains -D G K, Q^T G K and K^T G K -
/// C, and the last row likewise, with their coupling K and corner C.
///
/// The first block has the pattern of the contact graph and a sparse Cholesky factor. The other rows and
/// columns, a few dense ones, are eliminated by their Schur complement.
///
/// G spans many orders of magnitude near the solution, so that the factor alone loses digits. Each solution is
/// improved by a few iterations of conjugate gradients preconditioned with it. Along motions that the border
/// alone resists, as of a block that slides where the load pushes it, the first block is singular, and
/// solutions would grow until they bury the rest in rounding: improvement ends where they have grown too far.
class NormalEquations {
 public:
  struct Unknowns {
    VecX v;       ///< (6 nb)
    VecX border;  ///< q, t (nq + nt)
  };

  /// `problem` must outlive it.
  explicit NormalEquations(const ScaledConicProblem& problem);

  /// False if the matrix is not positive definite in double precision. V: per contact, G = V^T V (nc). V is
  /// applied twice instead of G, whose small eigenvalues have lost their digits.
  [[nodiscard]] bool factorize(std::vector<Mat3> V, const MatX& coupling, const MatX& corner);
  /// [Q, K] times the unknowns of the border (3 nc).
  VecX times_border(const VecX& border) const { return on_contacts_ * border; }
  /// [Q, K]^T x
  VecX on_border(const VecX& x) const { return on_contacts_.transpose() * x; }
  Unknowns solve(const VecX& f, const VecX& border) const;
  /// V x, V^T x and G x per contact (3 nc).
  VecX times_V(const VecX& x) const;
  VecX times_V_transposed(const VecX& x) const;
  VecX times_G(const VecX& x) const { return times_V_transposed(times_V(x)); }

 private:
  VecX multiply(const VecX& w) const;
  VecX solve(const VecX& f) const;

  const ConicProblem& p_;
  const WhitenedProblem& white_;
  ContactGraph graph_;
  BlockCholesky factor_;
  std::vector<Mat3> V_;
  MatX on_contacts_;       ///< [Q, K] (3 nc, nq + nt)
  MatX columns_;           ///< -[D G Q, P + D G K] (6 nb, nq + nt)
  MatX solved_;            ///< (D G D^T)^-1 columns_
  Eigen::MatrixXd schur_;  ///< corner - columns_^T solved_
};

}  // namespace cupola

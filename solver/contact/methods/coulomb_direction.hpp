#pragma once

#include <optional>
#include <vector>

#include "solver/contact/blocks/block_cholesky.hpp"
#include "solver/contact/blocks/block_lu.hpp"
#include "solver/contact/problem/solve_summary.hpp"

namespace cupola {

/// Solves J d = F, J = I + L^-1 D G D^T L^-T, for a whitened problem and a sequence of stiffnesses G that are
/// unsymmetric where contacts slide.
class CoulombDirection {
 public:
  /// How the first factor is made where a forcing is given and `lu` has none.
  enum class First { unsymmetric, symmetric };

  /// Begins with the factor of `lu`, if it has one, and leaves its last LU factor there.
  CoulombDirection(const WhitenedProblem& problem, const ContactGraph& graph, BlockLu* lu,
                   First first = First::unsymmetric)
      : problem_(problem),
        graph_(graph),
        jacobian_(problem, graph),
        unsymmetric_(*lu),
        first_(first),
        last_(lu->has_factor() ? Factor::unsymmetric : Factor::none) {}

  struct Accuracy {
    std::optional<double> forcing = std::nullopt;
    double damping = 0.0;  ///< added to the diagonal of J; without forcing only
  };

  /// d with |J d - F| <= forcing |F| by GMRES, preconditioned with the last factor. Where it fails, a new
  /// factor replaces the last: a Cholesky factor after a Cholesky factor or as the first one, if GMRES
  /// succeeds with it, otherwise an LU factor, which needs no GMRES. Without forcing always the latter. False
  /// if J is singular.
  [[nodiscard]] bool solve(const std::vector<Mat3>& G, const VecX& F, const Accuracy& accuracy, VecX* d,
                           SolveSummary* summary);

  /// The same for symmetric G, by a new Cholesky factor: half the time of an LU factor, and a third of the
  /// time per iteration of GMRES, in single precision.
  [[nodiscard]] bool solve_symmetric(const std::vector<Mat3>& G, const VecX& F, VecX* d,
                                     SolveSummary* summary);

 private:
  enum class Factor { none, symmetric, unsymmetric };
  bool solve_by_gmres(const UnsymmetricBlockMatrix& J, const VecX& F, double forcing, VecX* d,
                      SolveSummary* summary);
  bool factorize_symmetric(const std::vector<Mat3>& G, SolveSummary* summary);
  bool solve_directly(const UnsymmetricBlockMatrix& J, const VecX& F, VecX* d, SolveSummary* summary);

  const WhitenedProblem& problem_;
  const ContactGraph& graph_;
  ContactJacobian jacobian_;
  BlockCholesky symmetric_;
  BlockLu& unsymmetric_;
  const First first_;
  Factor last_;
};

}  // namespace cupola

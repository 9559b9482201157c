#pragma once

#include <vector>

#include "solver/conic/normal_equations.hpp"
#include "solver/conic/normal_limits.hpp"
#include "solver/contact/problem/conic_contact.hpp"

namespace cupola {

inline double largest_entry(const VecX& x) {
  return x.size() > 0 ? x.cwiseAbs().maxCoeff() : 0.0;
}

/// Residuals of the rows of the embedding, and the values that decide when to stop.
struct EmbeddingResiduals {
  VecX equilibrium, rows, dual, multipliers, limits;
  double gap = 0.0;           ///< of the fifth row
  double primal = 0.0;        ///< c . gamma + e . t
  double dual_value = 0.0;    ///< w . v + r . q
  double primal_error = 0.0;  ///< of the solution scaled by 1 / tau
  double dual_error = 0.0;
  double ray_error = 0.0;        ///< |D gamma + P t|, |Q^T gamma + R^T t|
  double mechanism_error = 0.0;  ///< |s - D^T v + Q q|, |P^T v - R q|
};

struct EmbeddingStep {
  VecX v, q, t, gamma;  ///< gamma: in the contacts' own coordinates
  double tau = 0.0, kappa = 0.0;
  std::vector<Vec3> cone_gamma, cone_z;
  VecX slack, lambda;  ///< of the limits
  double length = 10.0;
};

/// The homogeneous self-dual embedding of a scaled conic problem (solve_conic.hpp), at one iterate.
class Embedding {
 public:
  /// `problem` must outlive it.
  explicit Embedding(const ScaledConicProblem& problem);

  const VecX& v() const { return v_; }
  const VecX& q() const { return q_; }
  const VecX& t() const { return t_; }
  double tau() const { return tau_; }
  double kappa() const { return kappa_; }
  VecX gamma() const;
  EmbeddingResiduals residuals() const;

  /// The unknowns of an iterate.
  struct Point {
    std::vector<Vec3> gamma, z;  ///< cone coordinates
    VecX slack, lambda;
    VecX v, q, t;
    double tau = 1.0, kappa = 1.0;
  };
  Point point() const;
  void move_to(const Point& point);

  /// Updates the scaling of the contacts and the factor. False if it is lost to rounding.
  [[nodiscard]] bool factorize();
  /// Mean of gamma . s of the contacts, slack lambda of the limits and tau kappa. Requires factorize().
  double complementarity() const;
  /// Newton step to zero complementarity.
  EmbeddingStep predictor(const EmbeddingResiduals& r) const;
  /// Newton step that leaves the share sigma of the residuals and of the complementarity.
  EmbeddingStep corrector(const EmbeddingResiduals& r, double sigma, const EmbeddingStep& predicted) const;
  double complementarity_after(const EmbeddingStep& step, double length) const;
  void take(const EmbeddingStep& step, double length);
  /// Removes the rounding from the equilibrium of the forces, if they stay in their cones.
  void balance_forces();

 private:
  /// Scaled right-hand sides of the complementarity of contacts, limits, and tau and kappa.
  struct Targets {
    std::vector<Vec3> d;
    VecX limits;
    double kappa = 0.0;
  };
  EmbeddingStep direction(const EmbeddingResiduals& r, double keep, const Targets& targets) const;
  void refine(const EmbeddingResiduals& r, double remove, const Targets& targets, EmbeddingStep* step) const;
  void follow_limits(const EmbeddingResiduals& r, double remove, const Targets& targets,
                     EmbeddingStep* step) const;
  void complete(const EmbeddingResiduals& r, double remove, EmbeddingStep* step) const;
  double mean(double sum) const;

  const ConicProblem& p_;
  const WhitenedProblem& white_;
  NormalEquations equations_;
  NormalEquations::Unknowns unit_;  ///< response to d_tau = 1
  VecX unit_gamma_;
  std::vector<ConicContact> contacts_;  ///< gamma and s
  NormalLimits limits_;
  std::vector<Mat3> stiffened_;  ///< what the stiffness of the limits multiplies the scaling by
  VecX v_, q_, t_;
  double tau_ = 1.0, kappa_ = 1.0;
};

}  // namespace cupola

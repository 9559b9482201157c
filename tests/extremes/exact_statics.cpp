#include "tests/extremes/exact_statics.hpp"

#include <cmath>

#include <Eigen/Cholesky>
#include <Eigen/Dense>

#include "assembly/base/error.hpp"
#include "solver/dynamics/scene_options.hpp"
#include "solver/dynamics/time_step.hpp"

namespace cupola {

__extension__ using Quad = __float128;

}  // namespace cupola

template <>
struct Eigen::NumTraits<cupola::Quad> : Eigen::GenericNumTraits<cupola::Quad> {
  static cupola::Quad epsilon() { return 0x1p-112L; }
  static cupola::Quad dummy_precision() { return 0x1p-100L; }
};

namespace cupola {
namespace {

using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
using Long3 = Eigen::Matrix<long double, 3, 1>;
using LongMatrix3 = Eigen::Matrix<long double, 3, 3>;
template <class Real>
using VectorOf = Eigen::Matrix<Real, Eigen::Dynamic, 1>;
template <class Real>
using Triple = Eigen::Matrix<Real, 3, 1>;

long double square_root(long double x) {
  return std::sqrt(x);
}
Quad square_root(Quad x) {
  Quad root = std::sqrt(static_cast<long double>(x));
  if (root > 0) root = (root + x / root) / 2;  // one step of Newton doubles the 64 correct bits
  return root;
}

/// One contact point. Real: long double or Quad.
template <class Real>
struct Spring {
  int a = ContactProblem::kFixed, b = ContactProblem::kFixed;
  Eigen::Matrix<Real, 6, 3> D_a, D_b;
  Triple<Real> gap;       ///< m
  Real c_n = 0, c_t = 0;  ///< m/N
  Real mu = 0;

  Triple<Real> compliance() const { return {c_n, c_t, c_t}; }

  /// gamma at y, and -d gamma / dy if `slope` is given.
  Triple<Real> force(const Triple<Real>& y, LongMatrix3* slope = nullptr) const {
    const Triple<Real> trial = -y.cwiseQuotient(compliance());
    const Real t = square_root(Real(trial[1] * trial[1] + trial[2] * trial[2]));
    const Real k = c_t / c_n;
    if (slope) slope->setZero();
    if (t <= mu * trial[0]) {
      if (slope) *slope = compliance().template cast<long double>().cwiseInverse().asDiagonal();
      return trial;
    }
    if (mu * k * t <= -trial[0]) return Triple<Real>::Zero();
    const Real normal = (trial[0] + mu * k * t) / (1 + mu * mu * k);
    const Triple<Real> axis(1, mu * trial[1] / t, mu * trial[2] / t);
    if (slope) add_sliding_slope(normal, trial, t, axis, slope);
    return normal * axis;
  }

 private:
  void add_sliding_slope(Real normal, const Triple<Real>& trial, Real t, const Triple<Real>& axis,
                         LongMatrix3* slope) const {
    const Long3 along = axis.template cast<long double>();
    const Eigen::Matrix<long double, 2, 1> n = (trial.template tail<2>() / t).template cast<long double>();
    const auto turning = static_cast<long double>(mu * normal / (t * c_t));
    *slope = along * along.transpose() / static_cast<long double>(c_n + mu * mu * c_t);
    slope->bottomRightCorner<2, 2>() +=
        turning * (Eigen::Matrix<long double, 2, 2>::Identity() - n * n.transpose());
  }
};

template <class Real>
struct StaticEnergy {
  using Vector = VectorOf<Real>;
  std::vector<Spring<Real>> springs;
  Vector load;            ///< N, N m (6 nb)
  Eigen::VectorXd scale;  ///< 1 / N and 1 / (N m), of unbalanced forces and moments (6 nb)

  Triple<Real> opening(const Spring<Real>& spring, const Vector& d) const {
    Triple<Real> y = spring.gap;
    if (spring.a >= 0) y += spring.D_a.transpose() * d.template segment<6>(6 * spring.a);
    if (spring.b >= 0) y += spring.D_b.transpose() * d.template segment<6>(6 * spring.b);
    return y;
  }

  /// Minus the unbalanced forces, and their derivative if `stiffness` is given.
  Vector gradient(const Vector& d, LongMatrix* stiffness = nullptr) const {
    Vector g = -load;
    if (stiffness) stiffness->setZero(d.size(), d.size());
    for (const Spring<Real>& spring : springs) {
      LongMatrix3 slope;
      const Triple<Real> gamma = spring.force(opening(spring, d), stiffness ? &slope : nullptr);
      if (spring.a >= 0) g.template segment<6>(6 * spring.a) -= spring.D_a * gamma;
      if (spring.b >= 0) g.template segment<6>(6 * spring.b) -= spring.D_b * gamma;
      if (stiffness) add_stiffness(spring, slope, stiffness);
    }
    return g;
  }

  static void add_stiffness(const Spring<Real>& spring, const LongMatrix3& slope, LongMatrix* stiffness) {
    const int a = 6 * spring.a, b = 6 * spring.b;
    const Eigen::Matrix<long double, 6, 3> D_a = spring.D_a.template cast<long double>(),
                                           D_b = spring.D_b.template cast<long double>();
    if (spring.a >= 0) stiffness->block<6, 6>(a, a) += D_a * slope * D_a.transpose();
    if (spring.b >= 0) stiffness->block<6, 6>(b, b) += D_b * slope * D_b.transpose();
    if (spring.a < 0 || spring.b < 0) return;
    stiffness->block<6, 6>(a, b) += D_a * slope * D_b.transpose();
    stiffness->block<6, 6>(b, a) += D_b * slope * D_a.transpose();
  }

  double residual(const Vector& g) const {
    return g.template cast<double>().cwiseProduct(scale).cwiseAbs().maxCoeff();
  }

  /// The same energy with all compliances multiplied by `factor`.
  StaticEnergy softened(double factor) const {
    StaticEnergy soft = *this;
    for (Spring<Real>& spring : soft.springs) {
      spring.c_n *= factor;
      spring.c_t *= factor;
    }
    return soft;
  }
};

/// Zero of the derivative of the energy along p. 0 if the energy falls without end.
template <class Real>
Real line_search(const StaticEnergy<Real>& energy, const VectorOf<Real>& d, const VectorOf<Real>& p) {
  const auto slope = [&](Real t) { return energy.gradient(d + t * p).dot(p); };
  const Real start = slope(0), full = slope(1);
  if (full <= 0 ? full >= start / 10 : full <= -start / 10) return 1;
  Real low = 0, high = 1;
  while (slope(high) < 0) {
    if (high > 1e12L) return 0;
    low = high;
    high *= 2;
  }
  for (int k = 0; k < 30; ++k) {
    const Real middle = (low + high) / 2;
    (slope(middle) < 0 ? low : high) = middle;
  }
  return (low + high) / 2;
}

template <class Real>
StaticEnergy<Real> make_static_energy(const Model& model, const State& rest, const ContactSet& contacts) {
  StepOptions step;
  step.h = 1.0;  // b is then the gap
  step.time_advance = 0.0;
  const ContactProblem problem =
      build_step_problem(model, rest, contacts, match_memories({}, contacts.points), step).problem;
  StaticEnergy<Real> energy;
  energy.load = applied_forces(model, rest, rest.time).cast<Real>();
  energy.scale.resize(energy.load.size());
  for (int i = 0; i < model.num_free(); ++i) {
    const double size = std::cbrt(model.assembly->blocks[model.free_blocks[i]].volume);
    energy.scale.template segment<3>(6 * i).setConstant(1.0 / model.block_weight);
    energy.scale.template segment<3>(6 * i + 3).setConstant(1.0 / (model.block_weight * size));
  }
  for (int i = 0; i < problem.num_contacts(); ++i) {
    const JointLaw law = joint_law(model, contacts, contacts.points[i], 0.0);
    CUPOLA_ASSERT(law.compliance_normal > 0.0 && law.compliance_tangential > 0.0);
    Spring<Real> spring;
    spring.a = problem.block_a[i];
    spring.b = problem.block_b[i];
    spring.D_a.setZero();
    spring.D_b.setZero();
    if (spring.a >= 0) spring.D_a = problem.D_a[i].template matrix<Real>();
    if (spring.b >= 0) spring.D_b = problem.D_b[i].template matrix<Real>();
    spring.gap = problem.b.segment<3>(3 * i).cast<Real>();
    spring.c_n = law.compliance_normal;
    spring.c_t = law.compliance_tangential;
    spring.mu = law.mu;
    energy.springs.push_back(spring);
  }
  return energy;
}

/// Added to the diagonal so that blocks without contact move to their neighbours: 1e-15 of the stiffness with
/// all contacts closed.
template <class Real>
VectorOf<long double> damping_of(const StaticEnergy<Real>& energy) {
  LongMatrix closed = LongMatrix::Zero(energy.load.size(), energy.load.size());
  for (const Spring<Real>& spring : energy.springs) {
    const LongMatrix3 slope = spring.compliance().template cast<long double>().cwiseInverse().asDiagonal();
    StaticEnergy<Real>::add_stiffness(spring, slope, &closed);
  }
  const long double least = 1e-9L * closed.diagonal().maxCoeff();
  return 1e-15L * closed.diagonal().cwiseMax(least);
}

/// Newton's method from d. Returns the residual.
template <class Real>
double minimise(const StaticEnergy<Real>& energy, double tolerance, int max_iterations, VectorOf<Real>* d,
                int* iterations) {
  const VectorOf<long double> damping = damping_of(energy);
  LongMatrix stiffness;
  VectorOf<Real> g = energy.gradient(*d, &stiffness);
  for (int k = 0; k < max_iterations && energy.residual(g) > tolerance; ++k, ++*iterations) {
    stiffness.diagonal() += damping;
    const VectorOf<Real> p = (-stiffness.ldlt().solve(g.template cast<long double>())).template cast<Real>();
    const Real t = line_search(energy, *d, p);
    if (t == 0) break;
    *d += t * p;
    g = energy.gradient(*d, &stiffness);
  }
  return energy.residual(g);
}

/// A displacement near the equilibrium, in long double. Where many joints close, Newton's method needs a
/// start: the equilibrium of softer joints, which are hardened stepwise.
VectorOf<long double> near_equilibrium(const StaticEnergy<long double>& energy, int* iterations) {
  constexpr double kNear = 1e-6;
  VectorOf<long double> d = VectorOf<long double>::Zero(energy.load.size());
  if (minimise(energy, kNear, 60, &d, iterations) <= kNear) return d;
  d.setZero();
  for (double factor = 1e6; factor >= 1.0; factor /= 10.0)
    minimise(energy.softened(factor), kNear, 100, &d, iterations);
  return d;
}

}  // namespace

ExactStatics solve_exact_statics(const Case& scene, const Assembly& assembly) {
  constexpr double kRounding = 1e-16;  // forces are returned in double precision
  const Model model = make_model(scene, assembly);
  const State rest = state_at_rest(model);
  const ContactSet contacts = ContactDetector(assembly, detection_options(scene)).update(rest.poses);
  const auto energy = make_static_energy<Quad>(model, rest, contacts);
  ExactStatics result;
  VectorOf<Quad> d =
      near_equilibrium(make_static_energy<long double>(model, rest, contacts), &result.iterations)
          .cast<Quad>();
  result.residual = minimise(energy, kRounding, 60, &d, &result.iterations);
  result.found = result.residual <= kRounding;
  for (size_t i = 0; i < energy.springs.size(); ++i) {
    const Triple<Quad> gamma = energy.springs[i].force(energy.opening(energy.springs[i], d));
    result.forces.push_back(contact_frame(contacts.points[i].normal) * gamma.cast<double>());
  }
  return result;
}

}  // namespace cupola

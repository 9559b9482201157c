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

// The gradient is in Quad; the Newton direction, which need not be exact, in long double.
using QuadVector = Eigen::Matrix<Quad, Eigen::Dynamic, 1>;
using Quad3 = Eigen::Matrix<Quad, 3, 1>;
using Quad63 = Eigen::Matrix<Quad, 6, 3>;
using LongMatrix = Eigen::Matrix<long double, Eigen::Dynamic, Eigen::Dynamic>;
using Long3 = Eigen::Matrix<long double, 3, 1>;
using LongMatrix3 = Eigen::Matrix<long double, 3, 3>;

Quad square_root(Quad x) {
  Quad root = std::sqrt(static_cast<long double>(x));
  if (root > 0) root = (root + x / root) / 2;  // one step of Newton doubles the 64 correct bits
  return root;
}

struct Spring {
  int a = ContactProblem::kFixed, b = ContactProblem::kFixed;
  Quad63 D_a, D_b;
  Quad3 gap;              ///< m
  Quad c_n = 0, c_t = 0;  ///< m/N
  Quad mu = 0;

  Quad3 compliance() const { return {c_n, c_t, c_t}; }

  /// gamma at y, and -d gamma / dy if `slope` is given.
  Quad3 force(const Quad3& y, LongMatrix3* slope = nullptr) const {
    const Quad3 trial = -y.cwiseQuotient(compliance());
    const Quad t = square_root(trial[1] * trial[1] + trial[2] * trial[2]);
    const Quad k = c_t / c_n;
    if (slope) slope->setZero();
    if (t <= mu * trial[0]) {
      if (slope) *slope = compliance().cast<long double>().cwiseInverse().asDiagonal();
      return trial;
    }
    if (mu * k * t <= -trial[0]) return Quad3::Zero();
    const Quad normal = (trial[0] + mu * k * t) / (1 + mu * mu * k);
    const Quad3 axis(1, mu * trial[1] / t, mu * trial[2] / t);
    if (slope) add_sliding_slope(normal, trial, t, axis, slope);
    return normal * axis;
  }

 private:
  void add_sliding_slope(Quad normal, const Quad3& trial, Quad t, const Quad3& axis,
                         LongMatrix3* slope) const {
    const Long3 along = axis.cast<long double>();
    const Eigen::Matrix<long double, 2, 1> n = (trial.tail<2>() / t).cast<long double>();
    const auto turning = static_cast<long double>(mu * normal / (t * c_t));
    *slope = along * along.transpose() / static_cast<long double>(c_n + mu * mu * c_t);
    slope->bottomRightCorner<2, 2>() +=
        turning * (Eigen::Matrix<long double, 2, 2>::Identity() - n * n.transpose());
  }
};

struct StaticEnergy {
  std::vector<Spring> springs;
  QuadVector load;        ///< N, N m (6 nb)
  Eigen::VectorXd scale;  ///< 1 / N and 1 / (N m), of unbalanced forces and moments (6 nb)

  Quad3 opening(const Spring& spring, const QuadVector& d) const {
    Quad3 y = spring.gap;
    if (spring.a >= 0) y += spring.D_a.transpose() * d.segment<6>(6 * spring.a);
    if (spring.b >= 0) y += spring.D_b.transpose() * d.segment<6>(6 * spring.b);
    return y;
  }

  /// Minus the unbalanced forces, and their derivative if `stiffness` is given.
  QuadVector gradient(const QuadVector& d, LongMatrix* stiffness = nullptr) const {
    QuadVector g = -load;
    if (stiffness) stiffness->setZero(d.size(), d.size());
    for (const Spring& spring : springs) {
      LongMatrix3 slope;
      const Quad3 gamma = spring.force(opening(spring, d), stiffness ? &slope : nullptr);
      if (spring.a >= 0) g.segment<6>(6 * spring.a) -= spring.D_a * gamma;
      if (spring.b >= 0) g.segment<6>(6 * spring.b) -= spring.D_b * gamma;
      if (stiffness) add_stiffness(spring, slope, stiffness);
    }
    return g;
  }

  static void add_stiffness(const Spring& spring, const LongMatrix3& slope, LongMatrix* stiffness) {
    const int a = 6 * spring.a, b = 6 * spring.b;
    const auto D_a = spring.D_a.cast<long double>().eval(), D_b = spring.D_b.cast<long double>().eval();
    if (spring.a >= 0) stiffness->block<6, 6>(a, a) += D_a * slope * D_a.transpose();
    if (spring.b >= 0) stiffness->block<6, 6>(b, b) += D_b * slope * D_b.transpose();
    if (spring.a < 0 || spring.b < 0) return;
    stiffness->block<6, 6>(a, b) += D_a * slope * D_b.transpose();
    stiffness->block<6, 6>(b, a) += D_b * slope * D_a.transpose();
  }

  double residual(const QuadVector& g) const {
    return g.cast<double>().cwiseProduct(scale).cwiseAbs().maxCoeff();
  }
};

/// Zero of the derivative of the energy along p. 0 if the energy falls without end.
Quad line_search(const StaticEnergy& energy, const QuadVector& d, const QuadVector& p) {
  const auto slope = [&](Quad t) { return energy.gradient(d + t * p).dot(p); };
  const Quad start = slope(0), full = slope(1);
  if (full <= 0 ? full >= start / 10 : full <= -start / 10) return 1;
  Quad low = 0, high = 1;
  while (slope(high) < 0) {
    if (high > 1e12L) return 0;
    low = high;
    high *= 2;
  }
  for (int k = 0; k < 30; ++k) {
    const Quad middle = (low + high) / 2;
    (slope(middle) < 0 ? low : high) = middle;
  }
  return (low + high) / 2;
}

StaticEnergy make_static_energy(const Model& model, const State& rest, const ContactSet& contacts) {
  StepOptions step;
  step.h = 1.0;  // b is then the gap
  step.time_advance = 0.0;
  const ContactProblem problem =
      build_step_problem(model, rest, contacts, match_memories({}, contacts.points), step).problem;
  StaticEnergy energy;
  energy.load = applied_forces(model, rest, rest.time).cast<Quad>();
  energy.scale.resize(energy.load.size());
  for (int i = 0; i < model.num_free(); ++i) {
    const double size = std::cbrt(model.assembly->blocks[model.free_blocks[i]].volume);
    energy.scale.segment<3>(6 * i).setConstant(1.0 / model.block_weight);
    energy.scale.segment<3>(6 * i + 3).setConstant(1.0 / (model.block_weight * size));
  }
  for (int i = 0; i < problem.num_contacts(); ++i) {
    const JointLaw law = joint_law(model, contacts, contacts.points[i], 0.0);
    CUPOLA_ASSERT(law.compliance_normal > 0.0 && law.compliance_tangential > 0.0);
    Spring spring;
    spring.a = problem.block_a[i];
    spring.b = problem.block_b[i];
    spring.D_a.setZero();
    spring.D_b.setZero();
    if (spring.a >= 0) spring.D_a = problem.D_a[i].cast<Quad>();
    if (spring.b >= 0) spring.D_b = problem.D_b[i].cast<Quad>();
    spring.gap = problem.b.segment<3>(3 * i).cast<Quad>();
    spring.c_n = law.compliance_normal;
    spring.c_t = law.compliance_tangential;
    spring.mu = law.mu;
    energy.springs.push_back(spring);
  }
  return energy;
}

/// Added to the diagonal so that blocks without contact move to their neighbours: 1e-15 of the stiffness with
/// all contacts closed.
LongMatrix damping_of(const StaticEnergy& energy) {
  LongMatrix closed = LongMatrix::Zero(energy.load.size(), energy.load.size());
  for (const Spring& spring : energy.springs) {
    const LongMatrix3 slope = spring.compliance().cast<long double>().cwiseInverse().asDiagonal();
    StaticEnergy::add_stiffness(spring, slope, &closed);
  }
  const long double least = 1e-9L * closed.diagonal().maxCoeff();
  return 1e-15L * closed.diagonal().cwiseMax(least);
}

}  // namespace

ExactStatics solve_exact_statics(const Case& scene, const Assembly& assembly) {
  constexpr int kMaxIterations = 500;
  constexpr double kExact = 1e-16;  // forces are returned in double precision
  const Model model = make_model(scene, assembly);
  const State rest = state_at_rest(model);
  const ContactSet contacts = ContactDetector(assembly, detection_options(scene)).update(rest.poses);
  const StaticEnergy energy = make_static_energy(model, rest, contacts);
  const LongMatrix damping = damping_of(energy);
  ExactStatics result;
  QuadVector d = QuadVector::Zero(energy.load.size());
  LongMatrix stiffness;
  QuadVector g = energy.gradient(d, &stiffness);
  for (; result.iterations < kMaxIterations && energy.residual(g) > kExact; ++result.iterations) {
    stiffness.diagonal() += damping;
    const QuadVector p = (-stiffness.ldlt().solve(g.cast<long double>())).cast<Quad>();
    const Quad t = line_search(energy, d, p);
    if (t == 0) break;
    d += t * p;
    g = energy.gradient(d, &stiffness);
  }
  result.residual = energy.residual(g);
  result.found = result.residual <= kExact;
  for (size_t i = 0; i < energy.springs.size(); ++i) {
    const Quad3 gamma = energy.springs[i].force(energy.opening(energy.springs[i], d));
    result.forces.push_back(contact_frame(contacts.points[i].normal) * gamma.cast<double>());
  }
  return result;
}

}  // namespace cupola

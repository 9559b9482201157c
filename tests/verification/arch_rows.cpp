// Arches of plane-faced voussoirs with a centreline radius of 1 m.

#include <cmath>
#include <numbers>

#include "tests/solver/motion_scenes.hpp"
#include "tests/verification/one_step.hpp"
#include "tests/verification/solve.hpp"
#include "tests/verification/verification_row.hpp"

namespace cupola::verification {
namespace {

using Parameter = LimitSearch::Parameter;
using testing::ArchSpec;
using testing::make_arch;

/// Least t/R: the thickness of an arch somewhat thicker than expected is scaled down and up.
double least_thickness(ArchSpec arch, double friction, double expected) {
  arch.thickness = 1.1 * expected;
  return arch.thickness *
         critical_value(limit_case(Parameter::thickness, 0.6, 1.4, friction), make_arch(arch));
}

double least_friction(const ReferenceRow& row) {
  const int voussoirs = row.has("voussoirs") ? row.integer("voussoirs") : 100;
  return critical_value(limit_case(Parameter::friction, 0.2, 0.6, 0.4),
                        make_arch({.voussoirs = voussoirs, .thickness = row.number("t_R")}));
}

Assembly arch_of(const ReferenceRow& row) {
  return make_arch({.voussoirs = row.integer("voussoirs"),
                    .thickness = row.number("t_R"),
                    .beta_deg = row.has("beta_deg") ? row.number("beta_deg") : 90.0});
}

double critical_acceleration(const ReferenceRow& row) {
  return critical_value(limit_case(Parameter::acceleration, 0.01, 1.5, row.number("mu")), arch_of(row));
}

double tangent_of_critical_tilt(const ReferenceRow& row) {
  const double deg = critical_value(limit_case(Parameter::tilt, 0.1, 60.0, row.number("mu")), arch_of(row));
  return std::tan(deg * std::numbers::pi / 180.0);
}

double thrust_over_weight(const ReferenceRow& row) {
  Case scene = limit_case(Parameter::tilt, 0, 1, 0.6);
  scene.analysis.type = AnalysisType::static_;
  const Equilibrium solved = solve_equilibrium(scene, arch_of(row));
  double thrust = 0.0;
  for (int i = 0; i < solved.frame.contacts.size(); ++i)
    if (solved.frame.contacts.block_a[i] == 0) thrust -= solved.frame.contacts.force[i].x();
  return thrust / solved.summary.weight_N;
}

double arch_speed(const ReferenceRow& row) {
  constexpr double kLeast = 0.10672;
  const Assembly arch = make_arch({.thickness = row.number("thickness_over_least") * kLeast});
  return speed_after_one_step(
      arch, row.number("mu"),
      testing::tilted_gravity(std::tan(row.number("tilt_deg") * std::numbers::pi / 180.0)));
}

}  // namespace

void add_arch_rows(Computations* all) {
  Computations& rows = *all;
  rows["arch_thickness"] = [](const ReferenceRow& row) {
    return least_thickness({.voussoirs = row.integer("voussoirs")}, 0.8, row.expected());
  };
  rows["arch_thickness_by_embrace"] = [](const ReferenceRow& row) {
    return least_thickness({.beta_deg = row.number("beta_deg")}, 0.8, row.expected());
  };
  rows["arch_thickness_by_friction"] = [](const ReferenceRow& row) {
    return least_thickness({}, row.number("mu"), row.expected());
  };
  rows["continuous_arch"] = [](const ReferenceRow& row) {
    return least_thickness({.voussoirs = 100}, 0.8, row.expected());
  };
  rows["arch_friction"] = least_friction;
  rows["continuous_arch_friction"] = least_friction;
  rows["arch_acceleration"] = critical_acceleration;
  rows["arch_tilt"] = tangent_of_critical_tilt;
  rows["arch_thrust"] = thrust_over_weight;
  rows["one_step_arch"] = arch_speed;
}

}  // namespace cupola::verification

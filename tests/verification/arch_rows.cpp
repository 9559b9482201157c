// Arches of plane-faced voussoirs, with a centreline radius of 1 m unless a profile is named.

#include <cmath>
#include <numbers>
#include <stdexcept>

#include "generators/generate.hpp"
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

Profile::Kind profile_named(const std::string& name) {
  using enum Profile::Kind;
  for (const auto& [word, kind] : {std::pair{"semicircle", semicircle},
                                   {"segmental", segmental},
                                   {"pointed", pointed},
                                   {"ellipse", ellipse},
                                   {"parabola", parabola},
                                   {"catenary", catenary}})
    if (name == word) return kind;
  throw std::runtime_error("no profile " + name);
}

/// An arch that a profile draws on its middle line, 12 m wide.
Assembly drawn_arch(const std::string& profile, double rise, double radius_ratio, double thickness,
                    int voussoirs) {
  VaultSurface arch;
  arch.plan.kind = Plan::Kind::line;
  arch.profile.kind = profile_named(profile);
  arch.profile.span = 12.0;
  arch.profile.rise = rise;
  arch.profile.radius_ratio = radius_ratio;
  arch.thickness = thickness;
  arch.line = VaultSurface::Line::middle;
  Case scene;
  scene.geometry.surface = arch;
  scene.geometry.bond = StackBond{.rings = voussoirs, .blocks_per_ring = 1, .slices_per_block = 1};
  return generate(scene);
}

constexpr double kNoSliding = 2.0;  // friction

double least_thickness_of_profile(const ReferenceRow& row) {
  const double drawn = row.expected();  // the joint at a kink does not scale with the thickness
  const Assembly arch =
      drawn_arch(row.text("profile"), row.has("rise_m") ? row.number("rise_m") : 6.0,
                 row.has("radius_ratio") ? row.number("radius_ratio") : 1.0, drawn, row.integer("voussoirs"));
  return drawn * critical_value(limit_case(Parameter::thickness, 0.6, 1.4, kNoSliding), arch);
}

double thin_catenary_stands(const ReferenceRow&) {
  Case scene = limit_case(Parameter::thickness, 0.6, 1.4, kNoSliding);
  scene.analysis.type = AnalysisType::static_;
  return stands(scene, drawn_arch("catenary", 6.0, 1.0, 0.012, 32)) ? 1.0 : 0.0;
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
  rows["vault_thickness"] = least_thickness_of_profile;
  rows["thin_catenary"] = thin_catenary_stands;
  rows["arch_friction"] = least_friction;
  rows["continuous_arch_friction"] = least_friction;
  rows["arch_acceleration"] = critical_acceleration;
  rows["arch_tilt"] = tangent_of_critical_tilt;
  rows["arch_thrust"] = thrust_over_weight;
  rows["one_step_arch"] = arch_speed;
}

}  // namespace cupola::verification

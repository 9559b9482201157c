// Domes and vaults: volumes, forces and limits.

#include <cmath>
#include <filesystem>
#include <numbers>
#include <stdexcept>

#include <unistd.h>

#include "assembly/files/content_hash.hpp"
#include "generators/generate.hpp"
#include "generators/surface/make_surface.hpp"
#include "postproc/evaluation/evaluation.hpp"
#include "tests/verification/solve.hpp"
#include "tests/verification/thrust.hpp"
#include "tests/verification/verification_row.hpp"

namespace cupola::verification {
namespace {

double volume_of(const ReferenceRow& row) {
  const std::string model = row.text("model");
  Case scene;
  if (model == "arch") {
    ArchSurface arch;
    arch.span = 2.0 - 0.15;
    arch.thickness = 0.15;
    scene.geometry.surface = arch;
    scene.geometry.bond = StackBond{27, 1, 1, {}};
  } else {
    // Two cells per block, so that every lune is half a block wide.
    scene.geometry.bond = RunningBond{row.integer("rings"), row.integer("lunes") / 2, 2};
    const double to_oculus = (std::numbers::pi / 2 - 0.1) * 180.0 / std::numbers::pi;
    if (model == "hemisphere") {
      scene.geometry.surface = DomeSurface{1.9, 0.5, 0.1, to_oculus};
      scene.geometry.support_width = 0.2;
    }
  }
  GenerateReport report;
  generate(scene, &report);
  return report.model.volume;
}

OctagonalVault::Extrados extrados_named(const std::string& name) {
  using Extrados = OctagonalVault::Extrados;
  for (const Extrados e : {Extrados::normal, Extrados::corner, Extrados::midsail, Extrados::bed})
    if (name == to_string(e)) return e;
  throw std::runtime_error("no extrados " + name);
}

OctagonalVault::Construction construction_named(const std::string& name) {
  using Construction = OctagonalVault::Construction;
  for (const Construction c :
       {Construction::circular, Construction::planar_radial, Construction::planar_horizontal})
    if (name == to_string(c)) return c;
  throw std::runtime_error("no construction " + name);
}

double vault_volume(const ReferenceRow& row) {
  OctagonalVault vault;
  vault.construction = construction_named(row.text("construction"));
  vault.extrados = extrados_named(row.text("extrados"));
  Case scene;
  scene.geometry.surface = vault;
  GenerateReport report;
  generate(scene, &report);
  if (row.text("of") == "blocks") return report.model.volume;
  if (!report.model.shell_volume) throw std::runtime_error("the smooth shell has no volume");
  return *report.model.shell_volume;
}

double smooth_volume(const ReferenceRow& row) {
  if (row.text("surface") == "dome") return extrapolated_shell_volume(make_surface(DomeSurface{}, 1));
  OctagonalVault vault;
  vault.construction = OctagonalVault::Construction::planar_radial;
  vault.extrados = extrados_named(row.text("extrados"));
  return extrapolated_shell_volume(make_surface(vault, 1));
}

Case dome_with_lantern() {
  return repository_case("dome_circular", {"loads.lantern.weight_fraction=0.02", "analysis.tolerance=1e-9"});
}

/// Vertical force through the bed at theta, from 0 to 60 deg in 40 rings, over that at the base.
double ring_force_ratio(const ReferenceRow& row) {
  const Case scene = dome_with_lantern();
  const Assembly dome = generate(scene);
  const ContactTable contacts = solve_equilibrium(scene, dome).frame.contacts;
  const auto force_through = [&](int bed) {
    double sum = 0.0;
    for (int i = 0; i < contacts.size(); ++i) {
      const int a = dome.blocks[contacts.block_a[i]].ring, b = dome.blocks[contacts.block_b[i]].ring;
      if (a < bed && b >= bed) sum += contacts.force[i].z();
      if (b < bed && a >= bed) sum -= contacts.force[i].z();
    }
    return sum;
  };
  const int bed = static_cast<int>(std::lround(row.number("theta_deg") / 1.5));
  return force_through(bed) / force_through(0);
}

Evaluation evaluate_dome() {
  const Case scene = dome_with_lantern();
  const Assembly dome = generate(scene);
  Equilibrium solved = solve_equilibrium(scene, dome);
  const auto folder =
      std::filesystem::temp_directory_path() / ("cupola_verification_" + std::to_string(::getpid()));
  ResultsWriter writer(folder.string(), content_hash(dome));
  writer.write_frame(solved.frame);
  solved.summary.assembly_hash = content_hash(dome);
  writer.write_summary(solved.summary);
  Evaluation evaluated = evaluate(scene, dome, ResultsReader(folder.string(), content_hash(dome)));
  std::filesystem::remove_all(folder);
  return evaluated;
}

/// Mean meridional force of the blocks below and above a bed, kN/m. The value of a block applies at its
/// middle.
double meridional_force(const ReferenceRow& row) {
  const Evaluation e = evaluate_dome();
  const int bed = static_cast<int>(std::lround(row.number("theta_deg") / 1.5));
  double sum = 0.0;
  int count = 0;
  for (size_t b = 0; b < e.assembly.blocks.size(); ++b) {
    const int ring = e.assembly.blocks[b].ring;
    if (ring != bed && ring + 1 != bed) continue;
    sum += e.last.fields[b].meridional_force;
    ++count;
  }
  return 1e-3 * sum / count;
}

/// A limit analysis of a case of the paper.
Case paper_limit(const std::string& name, const char* parameter, double low, double high,
                 const std::vector<std::string>& settings) {
  std::vector<std::string> all{"analysis.type=limit", std::string("analysis.limit.parameter=") + parameter,
                               "analysis.limit.low=" + std::to_string(low),
                               "analysis.limit.high=" + std::to_string(high),
                               "analysis.limit.relative_width=1e-4"};
  all.insert(all.end(), settings.begin(), settings.end());
  return repository_case(name, all);
}

double least_friction_of_model(const ReferenceRow& row) {
  Case scene = paper_limit(row.text("case"), "friction", 0.05, 0.25, {});
  scene.loads.lantern.reset();
  if (row.text("bond") == "aligned")
    scene.geometry.bond = StackBond{.rings = 40, .blocks_per_ring = 32, .slices_per_block = 4};
  return critical_value(scene, generate(scene));
}

double critical_acceleration_of_model(const ReferenceRow& row) {
  Case scene = paper_limit(row.text("case"), "acceleration", 0.1, 0.9, {"joints.friction=" + row.text("mu")});
  scene.loads.lantern.reset();
  return critical_value(scene, generate(scene));
}

double critical_lantern_of_model(const ReferenceRow& row) {
  const Case scene =
      paper_limit(row.text("case"), "lantern", 0.0, 20.0, {"joints.friction=" + row.text("mu")});
  return critical_value(scene, generate(scene));
}

double thrust_of_model(const ReferenceRow& row) {
  Case scene = repository_case(row.text("case"), {"joints.friction=" + row.text("mu")});
  scene.loads.lantern.reset();
  if (const double share = row.number("lantern"); share > 0.0) scene.loads.lantern = TopLoad{share};
  const Assembly model = generate(scene);
  const Equilibrium solved = solve_equilibrium(scene, model);
  return outward_thrust(model, solved.frame.contacts) / solved.summary.weight_N;
}

/// The paper's dome, or a hemisphere of centreline radius 1 m that ends at the crown or 0.1 rad below.
DomeSurface dome_of(const std::string& name, double thickness) {
  if (name == "paper") return {};
  return {.span = 2.0 - thickness,
          .radius_ratio = 0.5,
          .thickness = thickness,
          .crown_angle_deg = name == "hemisphere" ? 84.2704220486918 : 89.5};
}

double least_friction_of_dome(const ReferenceRow& row) {
  Case scene;
  scene.geometry.surface = dome_of(row.text("dome"), row.number("t_R"));
  const int rings = row.integer("rings"), blocks = row.integer("blocks");
  if (row.text("bond") == "half")
    scene.geometry.bond = RunningBond{.rings = rings, .blocks_per_ring = blocks, .slices_per_block = 4};
  else
    scene.geometry.bond = StackBond{.rings = rings, .blocks_per_ring = blocks, .slices_per_block = 2};
  scene.analysis.type = AnalysisType::limit;
  scene.analysis.limit.low = 0.05;
  scene.analysis.limit.high = 0.3;
  scene.analysis.limit.relative_width = 2e-3;
  return critical_value(scene, generate(scene));
}

double least_thickness_of_hemisphere(const ReferenceRow& row) {
  Case scene;
  scene.geometry.surface = dome_of("hemisphere to the crown", 0.06);
  scene.geometry.bond =
      StackBond{.rings = row.integer("rings"), .blocks_per_ring = 96, .slices_per_block = 2};
  scene.joints.friction = 1.0;
  scene.analysis.type = AnalysisType::limit;
  scene.analysis.limit.parameter = LimitSearch::Parameter::thickness;
  scene.analysis.limit.low = 0.5;
  scene.analysis.limit.high = 1.2;
  scene.analysis.limit.relative_width = 2e-3;
  return 0.06 * critical_value(scene, generate(scene));
}

}  // namespace

void add_dome_rows(Computations* all) {
  Computations& rows = *all;
  rows["volume"] = volume_of;
  rows["vault_volume"] = vault_volume;
  rows["shell_volume"] = smooth_volume;
  rows["dome_ring_force"] = ring_force_ratio;
  rows["membrane"] = meridional_force;
  rows["dome_friction"] = least_friction_of_model;
  rows["dome_acceleration"] = critical_acceleration_of_model;
  rows["dome_lantern"] = critical_lantern_of_model;
  rows["dome_thrust_range"] = thrust_of_model;
  rows["dome_limit"] = least_friction_of_dome;
  rows["hemisphere_thickness"] = least_thickness_of_hemisphere;
  rows["paper_friction"] = [](const ReferenceRow&) {
    const Case scene = paper_limit("brunelleschi", "friction", 0.05, 0.25, {});
    return critical_value(scene, generate(scene));
  };
}

}  // namespace cupola::verification

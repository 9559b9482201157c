#include "generators/generate.hpp"

#include "assembly/variant.hpp"
#include "generators/bond/courses.hpp"
#include "generators/bond/fill.hpp"
#include "generators/bond/herringbone.hpp"
#include "generators/stereotomy/cut_blocks.hpp"
#include "generators/surface/make_surface.hpp"

namespace cupola {
namespace {

BondPattern make_bond(const Bond& bond, const BondGrid& grid) {
  return std::visit(Overloaded{[&](const RunningBond& b) { return running_bond(b, grid); },
                               [&](const StackBond& b) { return stack_bond(b, grid); },
                               [&](const HerringboneBond& b) { return herringbone_bond(b, grid); },
                               [&](const FillBond& b) { return fill_bond(b, grid); }},
                    bond);
}

CutOptions cut_options(const Case& input) {
  CutOptions options;
  options.density = input.material.density();
  options.support_width = input.geometry.support_width;
  options.imperfections = input.geometry.imperfections;
  if (input.geometry.stage) options.stage_rings = input.geometry.stage->rings;
  return options;
}

}  // namespace

Assembly cut_assembly(const Case& input) {
  const int rings = std::visit([](const auto& bond) { return bond.rings; }, input.geometry.bond);
  const SurfaceMap surface = make_surface(input.geometry.surface, rings);
  const BondPattern bond = make_bond(input.geometry.bond, bond_grid(surface));
  Assembly assembly = cut_blocks(surface, bond, cut_options(input));
  assembly.title = input.title;
  assembly.geometry_hash = input.geometry_hash;
  return assembly;
}

Assembly generate(const Case& input, ModelReport* report) {
  Assembly assembly = cut_assembly(input);
  ModelReport measured = check_model(assembly);
  if (!input.geometry.stage) {
    measured.shell_volume = make_surface(input.geometry.surface, 2).shell_volume;
    if (!measured.shell_volume) measured.shell_volume = extrapolated_shell_volume(input.geometry.surface);
  }
  assembly.check_report = to_text(measured);
  if (report) *report = measured;
  return assembly;
}

}  // namespace cupola

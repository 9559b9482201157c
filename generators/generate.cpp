#include "generators/generate.hpp"

#include "generators/bond/running.hpp"
#include "generators/stereotomy/cut_blocks.hpp"
#include "generators/surface/dome.hpp"
#include "generators/surface/wall.hpp"

namespace cupola {
namespace {

template <class... Ts>
struct Overloaded : Ts... {
  using Ts::operator()...;
};

int rings_of(const Bond& bond) {
  return std::visit([](const auto& b) { return b.rings; }, bond);
}

SurfaceMap make_surface(const Geometry& geometry) {
  const int rings = rings_of(geometry.bond);
  return std::visit(Overloaded{[&](const DomeSurface& dome) { return dome_surface(dome, rings); },
                               [&](const WallSurface& wall) { return wall_surface(wall, rings); }},
                    geometry.surface);
}

BondPattern make_bond(const Geometry& geometry, const BondGrid& grid) {
  return std::visit(Overloaded{[&](const RunningBond& bond) { return running_bond(bond, grid); }},
                    geometry.bond);
}

CutOptions cut_options(const Case& input) {
  CutOptions options;
  options.density = input.material.density();
  options.support_width = input.geometry.support_width;
  if (input.geometry.stage) options.stage_rings = input.geometry.stage->rings;
  return options;
}

}  // namespace

Assembly cut_assembly(const Case& input) {
  const SurfaceMap surface = make_surface(input.geometry);
  const BondPattern bond = make_bond(input.geometry, bond_grid(surface));
  Assembly assembly = cut_blocks(surface, bond, cut_options(input));
  assembly.title = input.title;
  assembly.geometry_hash = input.geometry_hash;
  return assembly;
}

Assembly generate(const Case& input, ModelReport* report) {
  Assembly assembly = cut_assembly(input);
  ModelReport measured = check_model(assembly);
  if (!input.geometry.stage) measured.shell_volume = make_surface(input.geometry).shell_volume;
  if (report) *report = measured;
  return assembly;
}

}  // namespace cupola

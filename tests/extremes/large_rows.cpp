// Models on the multigrid path: 10,000 blocks and more.

#include "assembly/case/case_reader.hpp"
#include "generators/generate.hpp"
#include "tests/extremes/rows.hpp"

namespace cupola {
namespace {

void add_large(const std::string& name, std::function<Scene()> make, Rows* rows) {
  rows->push_back({"20,000 blocks",
                   name,
                   "weight above each course",
                   {Ending::stable},
                   std::move(make),
                   carries_weight_above});
  rows->back().slow = true;
}

Scene large_dome() {
  const Case input = read_case(
      CUPOLA_SOURCE_DIR "/cases/dome_circular.yaml",
      {"geometry.bond.rings=160", "geometry.bond.blocks_per_ring=128", "geometry.bond.slices_per_block=2"});
  return Scene{input, generate(input)};
}

Assembly large_wall() {
  return testing::running_bond_wall({0.24, 1.0, 0.06}, 141, 142);
}

}  // namespace

void add_large_rows(Rows* rows) {
  add_large(
      "wall, 1e-10 m/N",
      [] {
        return Scene{statics(0.4, 1e-10, 1e-8), large_wall()};
      },
      rows);
  add_large(
      "wall, 1e-10 m/N, Coulomb's law",
      [] {
        return Scene{coulomb(statics(0.4, 1e-10, 1e-8)), large_wall()};
      },
      rows);
  add_large(
      "wall, courses of 1e-8 and 1e-13 m/N in turn",
      [] {
        Scene scene{statics(0.4, 1e-8, 1e-8), large_wall()};
        label_blocks([&](int block) { return scene.assembly.blocks[block].ring % 2; }, &scene.assembly);
        set_compliances({1e-8, 1e-13}, {1e-8, 1e-13}, &scene.input);
        return scene;
      },
      rows);
  add_large("dome of the paper's section, 20,480 blocks", large_dome, rows);
  add_large(
      "the same dome, Coulomb's law",
      [] {
        Scene scene = large_dome();
        scene.input.analysis.friction_law = FrictionLaw::coulomb;
        return scene;
      },
      rows);
}

}  // namespace cupola

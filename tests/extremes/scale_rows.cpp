// Several scales in one model: gaps against elastic depths, small against large blocks, far from the origin.

#include <fmt/format.h>

#include "assembly/case/case_reader.hpp"
#include "generators/generate.hpp"
#include "tests/extremes/rows.hpp"

namespace cupola {
namespace {

using testing::BoxSpec;

/// A stack of cubes with the given gaps below each.
Assembly open_stack(const std::vector<double>& gaps) {
  std::vector<BoxSpec> boxes{{.center = {0, 0, -0.5}, .size = {3, 3, 1}, .fixed = true}};
  double height = 0.0;
  for (size_t k = 0; k < gaps.size(); ++k) {
    boxes.push_back({.center = {0, 0, height + gaps[k] + 0.5}, .ring = static_cast<int>(k)});
    height += gaps[k] + 1.0;
  }
  return testing::make_boxes(boxes);
}

void add_gaps(Rows* rows) {
  rows->push_back({"scales",
                   "stack, beds open by 0.01 to 3 mm, elastic depth 1e-10 m",
                   "weight above each cube",
                   {Ending::stable},
                   [] {
                     return Scene{statics(0.4, 1e-14), open_stack({1e-3, 1e-5, 3e-3, 5e-4, 2e-3})};
                   },
                   carries_weight_above});
  rows->push_back({"scales", "a block half inside another", "refused", {Ending::refused}, [] {
                     return Scene{statics(0.4, 1e-9), open_stack({0.0, -0.5})};
                   }});
}

/// A dome with the section of the paper and few blocks, whose joints are open at random.
Scene open_dome(double gap, double compliance) {
  const std::vector<std::string> settings{"geometry.bond.rings=6",
                                          "geometry.bond.blocks_per_ring=12",
                                          "geometry.bond.slices_per_block=4",
                                          fmt::format("imperfections.gap={:g}", gap),
                                          "imperfections.seed=7",
                                          fmt::format("joints.compliance.normal={:g}", compliance),
                                          fmt::format("joints.compliance.tangential={:g}", compliance),
                                          "analysis.tolerance=1e-9"};
  const Case input = read_case(CUPOLA_SOURCE_DIR "/cases/dome_circular.yaml", settings);
  return Scene{input, generate(input)};
}

void add_domes(Rows* rows) {
  for (const double compliance : {1e-8, 1e-10, 1e-12})
    rows->push_back({"scales",
                     fmt::format("dome of 72 blocks, joints open by up to 1 mm, {:g} m/N", compliance),
                     "forces in extended precision",
                     {Ending::stable},
                     [compliance] { return open_dome(1e-3, compliance); },
                     equals_exact_statics});
  rows->push_back({"scales",
                   "dome of 72 blocks, joints open by up to 1 mm, 1e-10 m/N, Coulomb's law",
                   "weight above each ring, if it stands",
                   {Ending::stable, Ending::moving},
                   [] {
                     Scene scene = open_dome(1e-3, 1e-10);
                     scene.input.analysis.friction_law = FrictionLaw::coulomb;
                     return scene;
                   },
                   carries_weight_above});
  // The reference takes most of the time.
  for (ExtremeScene& row : *rows)
    if (row.name.find("dome") != std::string::npos) row.slow = true;
}

/// A cube of 1 m on four cubes of 1 mm, which carries another one of 1 mm.
Assembly cube_on_legs(double leg) {
  std::vector<BoxSpec> boxes{{.center = {0, 0, -0.5}, .size = {3, 3, 1}, .fixed = true}};
  for (const double x : {-0.4, 0.4})
    for (const double y : {-0.3, 0.3})
      boxes.push_back({.center = {x, y, leg / 2}, .size = {leg, leg, leg}, .ring = 0});
  boxes.push_back({.center = {0, 0, leg + 0.5}, .ring = 1});
  boxes.push_back({.center = {0.1, 0.2, 1.5 * leg + 1.0}, .size = {leg, leg, leg}, .ring = 2});
  return testing::make_boxes(boxes);
}

void add_sizes(Rows* rows) {
  rows->push_back({"scales",
                   "cube of 1 m on four legs of 1 mm, 1e6 m from the origin",
                   "forces in extended precision",
                   {Ending::stable},
                   [] {
                     Eigen::Isometry3d motion = Eigen::Isometry3d::Identity();
                     motion.translation() = Vec3(1e6, -1e6, 1e6);
                     return Scene{statics(0.4, 1e-9), testing::transformed(cube_on_legs(1e-3), motion)};
                   },
                   equals_exact_statics});
  for (const bool large_below : {true, false})
    rows->push_back({"scales",
                     fmt::format("cubes of 1 mm to 1 km in one stack, the {} one below",
                                 large_below ? "largest" : "smallest"),
                     "weight above each cube; masses span 1e18",
                     {Ending::stable},
                     [large_below] {
                       std::vector<Vec3> sizes;
                       for (double side = 1e3; side > 0.5e-3; side /= 10.0)
                         sizes.insert(large_below ? sizes.end() : sizes.begin(), Vec3::Constant(side));
                       return Scene{statics(0.4, 1e-16), pile(sizes)};
                     },
                     carries_weight_above});
}

void add_no_support(Rows* rows) {
  rows->push_back({"scales", "a cube 1 m above a tower of 10", "falls", {Ending::moving}, [] {
                     std::vector<double> gaps(10, 0.0);
                     gaps.push_back(1.0);
                     return Scene{statics(0.4, 1e-9), open_stack(gaps)};
                   }});
  rows->push_back({"scales",
                   "a wall without gravity",
                   "stable: all forces zero",
                   {Ending::stable},
                   [] {
                     Scene scene{statics(0.4, 1e-9), testing::running_bond_wall({1.0, 0.5, 0.5}, 4, 8)};
                     scene.input.loads.gravity.setZero();
                     return scene;
                   },
                   {},
                   [](const Summary&, const Frame& frame) {
                     double largest = 0.0;
                     for (const Vec3& force : frame.contacts.force) largest = std::max(largest, force.norm());
                     return largest == 0.0 ? std::string() : fmt::format("a force of {} N", largest);
                   }});
}

}  // namespace

void add_scale_rows(Rows* rows) {
  add_gaps(rows);
  add_domes(rows);
  add_sizes(rows);
  add_no_support(rows);
}

}  // namespace cupola

// A symmetric arch some of whose stones are two courses long: its thrust line is that of its mirror image.

#include "assembly/case/case_reader.hpp"
#include "tests/pipeline/static_run.hpp"

namespace cupola::drawn_arch_test {
namespace {

// Stones that reach from course 8 to the far springing: at bed 9, inside them, the line forgot the force of
// the support, 42.3 kN instead of 107.2. Tolerance: the solver's is 1e-8 of a block's weight.
TEST(DrawnArch, PushesOnTheFarSpringingAsOnTheNearOne) {
  const ProgramFolder folder;
  std::ofstream(folder.file("case.yaml")) << R"(
geometry:
  surface: {type: arch, span: 6, radius_ratio: 0.5, thickness: 0.6, width: 2}
  bond: {type: drawn, rings: 10, letter_length: 1, rows: [ad, ac, bc, bd], kinds: {a: flat, b: flat, c: flat, d: flat}}
material: {unit_weight: 20000}
joints: {friction: 0.7, compliance: {per: area}}
analysis: {type: static}
)";
  const Evaluation e = solve_and_evaluate(read_case(folder.file("case.yaml")), folder);
  ASSERT_EQ(e.meridians.size(), 1u);
  const std::vector<ThrustPoint>& points = e.meridians[0].thrust.points;
  ASSERT_EQ(points.size(), 11u);
  for (size_t i = 0; i < points.size(); ++i) {
    const ThrustPoint& mirrored = points[points.size() - 1 - i];
    EXPECT_NEAR(points[i].r, mirrored.r, 1e-6 * points[i].r) << i;
    EXPECT_NEAR(points[i].position, mirrored.position, 1e-6) << i;
  }
}

}  // namespace
}  // namespace cupola::drawn_arch_test

// A model of stone in kilometres or of plastic in centimetres: where every number with a unit follows from
// the model, lengths and weights scaled by powers of two change no verdict, no iteration and no digit.

#include <cmath>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "assembly/case/case_reader.hpp"
#include "assembly/model/relative_compliance.hpp"
#include "generators/generate.hpp"
#include "solver/solve_case.hpp"
#include "tests/pipeline/static_run.hpp"

namespace cupola {
namespace {

struct ScaledModel {
  std::string name, file;
  std::vector<std::string> settings;
};

std::ostream& operator<<(std::ostream& out, const ScaledModel& model) {
  return out << model.name;
}

struct Outcome {
  Summary summary;
  Frame frame;
};

Outcome solve(Case scene, const Assembly& assembly) {
  scene.joints.compliance = {0.0, 0.0, Compliance::Per::area, 1e-4};
  resolve_compliance(assembly, scene.loads.gravity, &scene.joints.compliance);
  Outcome out;
  AnalysisSinks sinks;
  sinks.frame = [&out](const Frame& frame) { out.frame = frame; };
  switch (scene.analysis.type) {
    case AnalysisType::limit:
      out.summary = run_limit(scene, assembly, sinks).value();
      break;
    case AnalysisType::range:
      out.summary = run_range(scene, assembly, sinks).value();
      break;
    default:
      out.summary = run_static(scene, assembly, sinks);
  }
  return out;
}

/// The same model, every length times `length`, every weight times `weight`.
Assembly scaled(Assembly assembly, double length, double weight) {
  for (Vec3& x : assembly.vertices) x *= length;
  for (Block& block : assembly.blocks) block.density *= weight / std::pow(length, 3);
  compute_mass_properties(&assembly);
  return assembly;
}

/// Factors on lengths and on weights: powers of two, which change no digit.
constexpr std::pair<double, double> kScales[] = {
    {0x1p-10, 1.0}, {0x1p10, 1.0}, {1.0, 0x1p-6}, {1.0, 0x1p6}, {0x1p-10, 0x1p-6}};

class Scaling : public ::testing::TestWithParam<ScaledModel> {};

TEST_P(Scaling, ChangesNoVerdictNoIterationAndNoDigit) {
  const Case scene = read_case(CUPOLA_SOURCE_DIR "/tests/net/" + GetParam().file, GetParam().settings);
  const Assembly assembly = generate(scene);
  const Outcome one = solve(scene, assembly);
  for (const auto& [length, weight] : kScales) {
    SCOPED_TRACE(fmt::format("length x {:g}, weight x {:g}", length, weight));
    const Outcome other = solve(scene, scaled(assembly, length, weight));
    EXPECT_EQ(to_string(other.summary.status), to_string(one.summary.status)) << other.summary.message;
    EXPECT_EQ(other.summary.iterations, one.summary.iterations);
    ASSERT_EQ(other.frame.contacts.size(), one.frame.contacts.size());
    double largest = 0.0, difference = 0.0;
    for (int i = 0; i < one.frame.contacts.size(); ++i) {
      largest = std::max(largest, one.frame.contacts.force[i].norm());
      difference =
          std::max(difference, (other.frame.contacts.force[i] / weight - one.frame.contacts.force[i]).norm());
    }
    EXPECT_LE(difference, 1e-10 * largest);
    if (one.summary.critical) {
      EXPECT_NEAR(other.summary.critical->value, one.summary.critical->value, 1e-10);
    }
    for (size_t r = 0; r < one.summary.ranges.size(); ++r) {
      EXPECT_NEAR(*other.summary.ranges[r].max.value / weight, *one.summary.ranges[r].max.value,
                  1e-10 * largest);
    }
  }
}

// The critical friction of the dome is 0.1106.
const std::vector<ScaledModel> kScaled{
    {"dome", "dome.yaml", {}},
    {"dome_under_coulomb", "dome.yaml", {"analysis.friction_law=coulomb", "joints.friction=0.2"}},
    {"dome_that_moves", "dome.yaml", {"joints.friction=0.01"}},
    {"dome_below_its_critical_friction", "dome.yaml", {"joints.friction=0.1095"}},
    {"dome_above_its_critical_friction", "dome.yaml", {"joints.friction=0.1117"}},
    {"arch", "arch.yaml", {}},
    {"octagon", "octagon.yaml", {"geometry.chains=[]"}},
    {"octagon_on_planar_beds", "planar.yaml", {}},
    {"wall", "wall.yaml", {}},
    {"dome_of_two_wythes", "shells.yaml", {}},
    {"friction_limit",
     "dome.yaml",
     {"analysis.type=limit", "analysis.limit.parameter=friction", "analysis.limit.low=0.01",
      "analysis.limit.high=0.3"}},
    {"extent_limit",
     "arch.yaml",
     {"analysis.type=limit", "analysis.limit.parameter=joint_extent", "analysis.limit.low=0.1",
      "analysis.limit.high=1"}},
    {"bisection",
     "arch.yaml",
     {"analysis.type=limit", "analysis.limit.method=bisection", "analysis.limit.parameter=tilt",
      "analysis.limit.low=0", "analysis.limit.high=40", "analysis.limit.relative_width=1e-3"}},
    {"range_of_thrust", "dome.yaml", {"analysis.type=range", "analysis.range.quantities=[thrust]"}},
};
INSTANTIATE_TEST_SUITE_P(, Scaling, ::testing::ValuesIn(kScaled),
                         [](const auto& scaling) { return scaling.param.name; });

}  // namespace
}  // namespace cupola

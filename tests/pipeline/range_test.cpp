// Ranges of forces of whole models: every state that the program can choose lies inside.
#include <gtest/gtest.h>

#include "assembly/case/case_reader.hpp"
#include "generators/generate.hpp"
#include "solver/analysis/analysis.hpp"

namespace cupola::range_of_domes_test {
namespace {

const std::string kCases = CUPOLA_SOURCE_DIR "/cases/";

struct Setting {
  const char* name;
  std::vector<std::string> set;
  bool same_points = true;  ///< the same contact points as in the case, hence the same range
};

const std::vector<Setting> kSettings{
    {"as in the case", {}},
    {"soft", {"joints.compliance.normal=1e-6", "joints.compliance.tangential=1e-6"}},
    {"stiff", {"joints.compliance.normal=1e-11", "joints.compliance.tangential=1e-11"}},
    {"nearly rigid", {"joints.compliance.normal=1e-14", "joints.compliance.tangential=1e-14"}},
    {"soft in shear", {"joints.compliance.tangential=1e-6"}},
    {"Coulomb's law", {"analysis.friction_law=coulomb"}},
    {"per area", {"joints.compliance={normal: 1e-9, tangential: 1e-9, per: area}"}, false}};

/// The range of the thrust and the thrust that the setting chooses, over the weight.
void expect_states_inside(const std::string& name, const std::vector<std::string>& more) {
  std::optional<ForceRange> as_in_the_case;
  for (const Setting& setting : kSettings) {
    std::vector<std::string> all{"analysis.type=range", "analysis.range.quantities=[thrust]"};
    all.insert(all.end(), more.begin(), more.end());
    all.insert(all.end(), setting.set.begin(), setting.set.end());
    const Case scene = read_case(kCases + name + ".yaml", all);
    const Summary summary = run_range(scene, generate(scene), {}).value();
    ASSERT_EQ(summary.status, Status::stable) << setting.name << ": " << summary.message;
    const ForceRange& thrust = summary.ranges.at(0);
    const double slack = 1e-6 * summary.weight_N;  // the gap of the range and the residual of the state
    ASSERT_TRUE(thrust.chosen) << setting.name;
    EXPECT_GE(*thrust.chosen, *thrust.min.value - slack) << setting.name;
    EXPECT_LE(*thrust.chosen, *thrust.max.value + slack) << setting.name;
    if (!as_in_the_case) as_in_the_case = thrust;
    if (!setting.same_points) continue;
    EXPECT_NEAR(*thrust.min.value, *as_in_the_case->min.value, slack) << setting.name;
    EXPECT_NEAR(*thrust.max.value, *as_in_the_case->max.value, slack) << setting.name;
  }
}

TEST(RangeOfDomes, HoldsEveryStateOfASmallDome) {
  expect_states_inside("dome_circular", {"geometry.bond.rings=6", "geometry.bond.blocks_per_ring=8"});
}

TEST(RangeOfDomesSlow, HoldsEveryStateOfThePapersModels) {
  for (const char* name :
       {"dome_circular", "dome_circular_herringbone", "octagon_planar", "octagon_circular", "brunelleschi"})
    expect_states_inside(name, {});
}

}  // namespace
}  // namespace cupola::range_of_domes_test

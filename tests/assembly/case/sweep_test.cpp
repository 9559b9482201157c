// The sweep of a case: its members, their names, and that it leaves the hash of the case unchanged.
#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "assembly/case/case_reader.hpp"
#include "tests/assembly/case/case_scratch.hpp"

namespace cupola::sweep_test {
namespace {

TEST(Sweep, RunsAllCombinationsOfTheValues) {
  const auto members = members_of(
      std::vector<SweptKey>{{"joints.friction", {"0.1", "0.2"}}, {"analysis.method", {"newton", "spg"}}},
      "dome");
  ASSERT_EQ(members.size(), 4u);
  EXPECT_EQ(members[1].name, "dome_friction0.1_methodspg");
  EXPECT_EQ(members[2].settings, (std::vector<std::string>{"joints.friction=0.2", "analysis.method=newton"}));
}

TEST(Sweep, KeysWithTheSameLastWordAppearInFull) {
  const auto members = members_of(
      std::vector<SweptKey>{{"joints.bed.friction", {"0.1"}}, {"joints.head.friction", {"0.3"}}}, "w");
  EXPECT_EQ(members.front().name, "w_joints.bed.friction0.1_joints.head.friction0.3");
}

TEST(Sweep, ValuesThatCannotBePartOfAFileNameAreRefused) {
  for (const char* value : {"../a", "a b", "", "$(x)", "a=b"})
    EXPECT_THROW(members_of(std::vector<SweptKey>{{"title", {value}}}, "w"), InputError) << value;
  EXPECT_THROW(members_of(std::vector<SweptKey>(), "w"), InputError);
}

TEST(Sweep, DoesNotChangeTheHashOfTheCase) {
  const ScratchFolder scratch;
  const std::string wall =
      "geometry:\n  surface: {type: wall, length: 3}\n  bond: {type: running, rings: 2, blocks_per_ring: 2}\n"
      "joints: {compliance: {per: area}}\n";
  const Case plain = read_case(scratch.write("plain.yaml", wall));
  const Case swept =
      read_case(scratch.write("swept.yaml", wall + "sweep: [{key: joints.friction, values: [0.1, 2e-1]}]\n"));
  ASSERT_EQ(swept.sweep.size(), 1u);
  EXPECT_EQ(swept.sweep[0].values, (std::vector<std::string>{"0.1", "2e-1"}));
  EXPECT_EQ(swept.hash, plain.hash);
  for (const char* broken : {"sweep: [{key: joints.friction, values: []}]\n", "sweep: [{values: [1]}]\n"})
    EXPECT_THROW(read_case(scratch.write("broken.yaml", wall + broken)), InputError) << broken;
}

}  // namespace
}  // namespace cupola::sweep_test

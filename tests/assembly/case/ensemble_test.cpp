// Samples of an ensemble: distributions, designs, files, and that other keys leave them as they are.
#include <algorithm>
#include <cmath>
#include <random>

#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "assembly/case/case_reader.hpp"
#include "tests/assembly/case/case_scratch.hpp"

namespace cupola::ensemble_test {
namespace {

std::vector<double> column(const Samples& samples, size_t k) {
  std::vector<double> values;
  for (const auto& row : samples.rows) values.push_back(std::stod(row[k]));
  return values;
}

// Quantiles from tables and closed forms. Of the lognormal distribution with mean 1 and deviation 1 the
// median is 1/sqrt(2).
TEST(Ensemble, InvertsTheDistributionFunctions) {
  EXPECT_NEAR(std::stod(value_at(NormalValues{10.0, 2.0}, 0.975)), 10.0 + 2.0 * 1.959963984540054, 1e-12);
  EXPECT_NEAR(std::stod(value_at(LognormalValues{1.0, 1.0}, 0.5)), std::sqrt(0.5), 1e-15);
  EXPECT_DOUBLE_EQ(std::stod(value_at(UniformValues{2.0, 6.0}, 0.25)), 3.0);
  EXPECT_DOUBLE_EQ(std::stod(value_at(TriangularValues{0.0, 1.0, 4.0}, 0.25)), 1.0);
  EXPECT_DOUBLE_EQ(std::stod(value_at(TriangularValues{0.0, 1.0, 4.0}, 0.8125)),
                   4.0 - std::sqrt(0.1875 * 12.0));
  EXPECT_EQ(value_at(TableOfValues{{"a", "b", "c"}, {1.0, 2.0, 1.0}}, 0.26), "b");
  EXPECT_EQ(value_at(TableOfValues{{"a", "b"}, {}}, 0.51), "b");
  EXPECT_EQ(value_at(SeedValues{}, 0.5), "1073741824");
}

// Mean and deviation of 4000 values lie within four standard errors: deviation / sqrt(n), and deviation /
// sqrt(2 n) and more for the longer tail of the lognormal distribution.
TEST(Ensemble, DrawsTheMeanAndDeviationThatItIsGiven) {
  const Ensemble ensemble{4000,
                          1,
                          Ensemble::Design::monte_carlo,
                          KeptFiles::summary,
                          {{"a", LognormalValues{0.6, 0.15}}, {"b", NormalValues{2.0, 0.1}}}};
  const Samples samples = draw_samples(ensemble);
  for (const auto& [k, mean, deviation] : {std::tuple(size_t{0}, 0.6, 0.15), {size_t{1}, 2.0, 0.1}}) {
    const std::vector<double> values = column(samples, k);
    double sum = 0.0, squares = 0.0;
    for (const double v : values) sum += v, squares += (v - mean) * (v - mean);
    EXPECT_NEAR(sum / 4000.0, mean, 4.0 * deviation / std::sqrt(4000.0));
    EXPECT_NEAR(std::sqrt(squares / 4000.0), deviation, 6.0 * deviation / std::sqrt(8000.0));
  }
}

// The stream is that of std::mt19937_64, whose 10000th number for its default seed the C++ standard gives
// (26.6.6).
TEST(Ensemble, UsesTheEngineOfTheStandard) {
  std::mt19937_64 engine;
  engine.discard(9999);
  EXPECT_EQ(engine(), 9981545732273789042u);
}

TEST(Ensemble, OtherKeysAndMoreMembersLeaveTheValuesAsTheyAre) {
  const VariedKey friction{"joints.friction", UniformValues{0.0, 1.0}},
      weight{"material.unit_weight", UniformValues{0.0, 1.0}};
  const auto draw = [](int members, std::vector<VariedKey> vary) {
    return draw_samples({members, 7, Ensemble::Design::monte_carlo, KeptFiles::summary, std::move(vary)});
  };
  const Samples alone = draw(20, {friction}), both = draw(40, {weight, friction});
  for (size_t i = 0; i < 20; ++i) EXPECT_EQ(alone.rows[i][0], both.rows[i][1]);
  EXPECT_NE(both.rows[0][0], both.rows[0][1]);
  Ensemble other{20, 8, Ensemble::Design::monte_carlo, KeptFiles::summary, {friction}};
  EXPECT_NE(draw_samples(other).rows[0][0], alone.rows[0][0]);
}

// Each of the ten hypercubes of four members has one value in each quarter.
TEST(Ensemble, AHypercubeHasOneMemberPerInterval) {
  const Ensemble ensemble{
      40, 3, Ensemble::Design::latin_hypercube, KeptFiles::summary, {{"x", UniformValues{0.0, 4.0}}}};
  const std::vector<double> values = column(draw_samples(ensemble), 0);
  for (size_t cube = 0; cube < 10; ++cube) {
    std::vector<int> strata;
    for (size_t i = 0; i < 4; ++i) strata.push_back(static_cast<int>(values[4 * cube + i]));
    std::ranges::sort(strata);
    EXPECT_EQ(strata, (std::vector<int>{0, 1, 2, 3})) << cube;
  }
}

constexpr const char* kWall =
    "geometry:\n  surface: {type: wall, length: 3}\n  bond: {type: running, rings: 2, blocks_per_ring: 2}\n"
    "joints: {compliance: {per: area}}\n";

TEST(Ensemble, OfACaseLeavesItsHash) {
  const ScratchFolder scratch;
  const Case plain = read_case(scratch.write("plain.yaml", kWall));
  const Case drawn = read_case(scratch.write(
      "drawn.yaml", std::string(kWall) +
                        "ensemble:\n  members: 5\n  vary:\n    - {key: joints.friction, distribution: "
                        "uniform, from: 0.3, to: 0.5}\n"));
  ASSERT_TRUE(drawn.ensemble);
  EXPECT_EQ(drawn.ensemble->members, 5);
  EXPECT_EQ(drawn.hash, plain.hash);
}

// One component of a settlement varies as a number does; the others keep the value of the case.
TEST(Ensemble, ComponentsOfVectorsAreKeys) {
  const ScratchFolder scratch;
  const std::string path =
      scratch.write("settled.yaml",
                    std::string(kWall) +
                        "supports: {moves: [{displacement: [0.001, 0, -0.005]}]}\n"
                        "ensemble:\n  members: 4\n  vary:\n    - {key: 'supports.moves[0].displacement[2]', "
                        "distribution: uniform, from: -0.02, to: -0.01}\n");
  const Case scene = read_case(path);
  const auto member = members_of(draw_samples(*scene.ensemble), "m/").front();
  const Vec3 settled = read_case(path, member.settings).supports.moves[0].displacement;
  EXPECT_EQ(settled.x(), 0.001);
  EXPECT_GE(settled.z(), -0.02);
  EXPECT_LE(settled.z(), -0.01);
}

TEST(Ensemble, WhatIsWrongIsAnError) {
  const ScratchFolder scratch;
  const auto refused = [&](const std::string& ensemble, const std::string& phrase) {
    try {
      read_case(scratch.write("bad.yaml", kWall + ensemble));
      ADD_FAILURE() << ensemble;
    } catch (const InputError& error) {
      EXPECT_NE(std::string(error.what()).find(phrase), std::string::npos) << error.what();
    }
  };
  const std::string vary = "ensemble:\n  members: 30\n  vary:\n    - ";
  refused(vary + "{key: joints.frction, distribution: uniform, from: 0, to: 1}\n",
          "unknown key; did you mean friction?");
  refused(vary + "{key: joints.friction, distribution: normal, mean: 0.2, deviation: 0.3}\n", "must be >= 0");
  refused(vary + "{key: joints.friction, distribution: uniform, from: 1, to: 1}\n",
          "must be greater than from");
  refused(vary + "{key: joints.friction, distribution: lognormal, mean: 0, deviation: 1}\n", "must be > 0");
  refused(vary + "{key: joints.friction, distribution: triangular, from: 0, mode: 2, to: 1}\n",
          "between from and to");
  refused(vary + "{key: joints.friction, distribution: table, values: [0.3, 0.4], weights: [1]}\n",
          "one per value");
  refused("ensemble: {members: 30}\n", "must name at least one key");
  const std::string one = "{key: joints.friction, distribution: uniform, from: 0, to: 1}";
  refused("ensemble:\n  members: 30\n  vary: [" + one + ", " + one + "]\n", "names a key twice");
  refused("ensemble:\n  members: 25\n  design: latin_hypercube\n  vary: [" + one + "]\n", "multiple of 10");
}

TEST(Samples, OfAFileAreReadAndChecked) {
  const ScratchFolder scratch;
  const Samples samples = read_samples(
      scratch.write("s.csv", "joints.friction, joints.rings[0].from\n# two\n0.3,1\n\n4e-1 , 2\n"));
  EXPECT_EQ(samples.keys, (std::vector<std::string>{"joints.friction", "joints.rings[0].from"}));
  EXPECT_EQ(samples.rows, (std::vector<std::vector<std::string>>{{"0.3", "1"}, {"4e-1", "2"}}));
  const auto members = members_of(samples, "wall/");
  EXPECT_EQ(members[1].name, "wall/0002");
  EXPECT_EQ(members[1].settings,
            (std::vector<std::string>{"joints.friction=4e-1", "joints.rings[0].from=2"}));
  for (const char* bad : {"", "a\n", "a,b\n1\n", "a\n$(x)\n", "a b\n1\n", "a,\n1,2\n", "a,b,a\n1,2,3\n"})
    EXPECT_THROW(read_samples(scratch.write("bad.csv", bad)), InputError) << bad;
  scratch.write("low.csv", "joints.friction\n0.3\n-0.1\n0.5\n");
  const std::string wall = scratch.write("wall.yaml", std::string(kWall) + "sweep: {file: low.csv}\n");
  EXPECT_THROW(read_case(wall), InputError);
  const Case member = read_case(wall, {"joints.friction=0.3"});
  EXPECT_EQ(member.inputs, std::vector<std::string>{wall}) << "a member depends on its own values only";
}

// Each row is a valid case, and 0.1 beside the `low` of the base case is not.
TEST(Samples, AreCheckedAsWholeMembers) {
  const ScratchFolder scratch;
  const std::string wall = scratch.write(
      "wall.yaml", std::string(kWall) +
                       "analysis: {type: limit, limit: {parameter: friction, low: 0.15, high: 0.5}}\n"
                       "sweep: {file: s.csv}\n");
  const std::string keys = "analysis.limit.low,analysis.limit.high\n";
  scratch.write("s.csv", keys + "0.01,0.1\n0.2,0.6\n");
  EXPECT_NO_THROW(read_case(wall));
  scratch.write("s.csv", keys + "0.01,0.1\n0.7,0.6\n");
  try {
    read_case(wall);
    ADD_FAILURE() << "0.7 is above 0.6";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("s.csv:3:1: error: sweep: member 0002: "), std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace cupola::ensemble_test

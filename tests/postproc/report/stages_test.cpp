#include "postproc/report/stages.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "postproc/report/first_screen.hpp"
#include "tests/postproc/scene.hpp"

namespace cupola::stages_test {
namespace {

constexpr auto kFriction = StagedConstruction::Least::friction;

TEST(Stages, HaveTheHeightsOfTheirRings) {
  Evaluation e = test::column_evaluation(0.6, 0.4);
  e.rings[1] = {.ring = 1};  // the last stage holds it
  const std::string header =
      "stage,ring,laid,blocks,weight_N,verdict,speed_ratio,least_stands,least_moves,head_squeeze_m,"
      "displacement_m,note\n";
  const StageReport c =
      report_stages(e, kFriction,
                    parse_csv(header + "0,1,1,2,100,equilibrium,1e-9,0.12,0.11,0,1e-4,narrow\n"
                                       "1,2,1,3,150,moving,0.3,,,,,no bracket\n",
                              "construction.csv"),
                    {});
  ASSERT_EQ(c.table.rows.size(), 2u);
  EXPECT_NEAR(std::get<double>(c.table.rows[0][2]), 0.5, 1e-12) << "the bed of ring 1";
  EXPECT_EQ(std::get<double>(c.table.rows[0][6]), 0.12);
  EXPECT_TRUE(std::isnan(std::get<double>(c.table.rows[1][6])));
  EXPECT_EQ(c.worst, "the first that does not: stage 1, in course 2");
  ASSERT_TRUE(c.figure);
  EXPECT_NE(c.figure->commands.find("\n0 0.12 \n"), std::string::npos);
}

// A table of version 0.2.
TEST(Stages, OldTablesOfRingsAreRead) {
  const CsvFile old = parse_csv(
      "ring,blocks,weight_N,verdict,speed_ratio,critical_stands,critical_moves,note\n"
      "1,2,100,equilibrium,1e-9,0.12,0.11,narrow\n2,3,150,equilibrium,1e-9,0,,stands without any\n",
      "stages.csv");
  const StageReport c = report_stages(test::column_evaluation(0.6, 0.4), kFriction, from_stages_csv(old), {});
  EXPECT_EQ(c.standing, 2);
  EXPECT_EQ(c.worst, "the most demanding: stage 0, in course 1");
  EXPECT_EQ(std::get<int>(c.table.rows[1][0]), 1) << "stage";
  EXPECT_EQ(std::get<int>(c.table.rows[1][3]), 1) << "laid";
  EXPECT_EQ(std::get<double>(c.table.rows[1][6]), 0.0);
}

constexpr const char* kConstruction =
    "stage,ring,laid,blocks,verdict,speed_ratio,least_stands,least_moves,head_squeeze_m,displacement_m,"
    "note\n";

TEST(Stages, TheMostDemandingStageSaysWhatMovesWithLess) {
  const CsvFile stages = parse_csv(std::string(kConstruction) +
                                       "0,2,4,124,equilibrium,1e-9,5000,4900,1e-6,4e-5,\n"
                                       "1,2,4,128,equilibrium,1e-9,6000,5900,1e-6,5e-5,\n"
                                       "2,2,2,130,equilibrium,1e-9,0,,2e-6,6e-5,\n",
                                   "construction.csv");
  const CsvFile failures = parse_csv(
      "stage,ring,block,course,how,relative_speed\n0,2,801,2,slides,1\n1,2,801,2,slides,1\n"
      "1,2,802,2,slides,0.5\n1,2,790,1,tips,0.2\n",
      "failures.csv");
  const StageReport c =
      report_stages(test::column_evaluation(0.6, 0.4), StagedConstruction::Least::cohesion, stages, failures);
  EXPECT_EQ(c.standing, 3);
  EXPECT_EQ(
      c.worst,
      "the most demanding: stage 1, in course 2; if the cohesion is less, 1 block of course 1 tips, 2 blocks "
      "of course 2 slide");
  EXPECT_EQ(c.table.columns[6].key, "least_stands_Pa");
  EXPECT_EQ(std::get<double>(c.table.rows[1][6]), 6000.0);
  EXPECT_EQ(std::get<std::string>(c.table.rows[0][8]), "1 block of course 2 slides");
  ASSERT_TRUE(c.figure);
  EXPECT_NE(c.figure->commands.find("\n1 6 \n"), std::string::npos) << "in kPa";
}

TEST(Stages, HaveACurveAlsoIfNoneNeedsMortar) {
  const CsvFile stages = parse_csv(std::string(kConstruction) +
                                       "0,1,4,124,equilibrium,1e-9,0,,1e-6,4e-5,\n"
                                       "1,1,4,128,equilibrium,1e-9,0,,1e-6,4e-5,\n",
                                   "construction.csv");
  const StageReport c = report_stages(test::column_evaluation(0.6, 0.4), kFriction, stages, std::nullopt);
  ASSERT_TRUE(c.figure);
  EXPECT_TRUE(c.figure->caption.ends_with("(0: it needs none).")) << c.figure->caption;
}

TEST(Stages, TheFirstStageThatDoesNotStandSaysWhatMoves) {
  const CsvFile stages = parse_csv(std::string(kConstruction) +
                                       "0,1,4,124,equilibrium,1e-9,,,1e-6,4e-5,\n"
                                       "1,1,4,128,moving,0.3,,,,,\n",
                                   "construction.csv");
  const CsvFile failures =
      parse_csv("stage,ring,block,course,how,relative_speed\n1,1,12,1,slides,1\n", "failures.csv");
  const StageReport c =
      report_stages(test::column_evaluation(0.6, 0.4), StagedConstruction::Least::none, stages, failures);
  EXPECT_EQ(c.standing, 1);
  EXPECT_EQ(c.worst, "the first that does not: stage 1, in course 1, where 1 block of course 1 slides");
  EXPECT_FALSE(c.figure);
  for (const Table::Column& column : c.table.columns)
    EXPECT_FALSE(column.key.starts_with("least")) << column.key;
}

// An arch cracks while it is built, and closes again.
TEST(Stages, FirstScreenHasTheMostOfAllStages) {
  const Evaluation e = test::column_evaluation(0.6, 0.4);
  const CsvFile stages =
      parse_csv(std::string(kConstruction) +
                    "0,0,1,1,equilibrium,1e-9,,,0,1e-4,\n1,1,1,2,equilibrium,1e-9,,,0,1e-4,\n"
                    "2,2,1,3,equilibrium,1e-9,,,0,1e-4,\n",
                "construction.csv");
  const StageReport c = report_stages(e, StagedConstruction::Least::none, stages, std::nullopt,
                                      {{1, {1.087e6, 1.0, 1.09e-3}}, {2, {1.96e5, 0.307, 0.0}}});
  ASSERT_EQ(c.largest.size(), 2u);
  EXPECT_EQ(c.largest[0].value, "1.09 MPa");
  EXPECT_EQ(c.largest[0].detail(),
            "in stage 1; a joint uses at most 100 % of its compressive or tensile strength");
  EXPECT_EQ(c.largest[1].value, "1.09 mm");
  const size_t pressure = c.table.columns.size() - 3;
  EXPECT_TRUE(std::isnan(std::get<double>(c.table.rows[0][pressure]))) << "has no frame";
  EXPECT_EQ(std::get<double>(c.table.rows[1][pressure]), 1.087e6);
  const std::string page = first_screen(e, {}, &c, "");
  EXPECT_NE(page.find("<span>Widest crack</span><strong>1.09 mm</strong><small>in stage 1<"),
            std::string::npos)
      << page;
}

}  // namespace
}  // namespace cupola::stages_test

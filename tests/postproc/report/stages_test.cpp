#include "postproc/report/stages.hpp"

#include <cmath>

#include <gtest/gtest.h>

#include "tests/postproc/scene.hpp"

namespace cupola::stages_test {
namespace {

TEST(Stages, RingsHaveTheirHeightsAndTheMiddleOfTheBracket) {
  const Evaluation e = test::column_evaluation(0.6, 0.4);
  const std::string header = "ring,blocks,weight_N,verdict,speed_ratio,critical_stands,critical_moves,note\n";
  const StageReport c = rings_laid(e, parse_csv(header + "1,2,100,equilibrium,1e-9,0.12,0.11,narrow\n"
                                                         "2,3,150,moving,0.3,,,no bracket\n"
                                                         "0,1,50,equilibrium,1e-9,0,,stands without any\n",
                                                "stages.csv"));
  ASSERT_EQ(c.table.rows.size(), 3u);
  EXPECT_NEAR(std::get<double>(c.table.rows[0][1]), 0.5, 1e-12) << "the bed of ring 1";
  EXPECT_NEAR(std::get<double>(c.table.rows[0][4]), 0.115, 1e-15);
  EXPECT_TRUE(std::isnan(std::get<double>(c.table.rows[1][4])));
  EXPECT_EQ(std::get<double>(c.table.rows[2][4]), 0.0);
  EXPECT_EQ(c.standing, 2);
  EXPECT_EQ(c.worst, "the first that does not: ring 2");
  ASSERT_TRUE(c.figure);
  EXPECT_NE(c.figure->commands.find("0.5 0.115"), std::string::npos);
  const StageReport without = rings_laid(e, parse_csv(header + "0,1,50,equilibrium,1e-9,,,\n", "stages.csv"));
  EXPECT_FALSE(without.figure) << "no critical friction was requested";
  EXPECT_EQ(without.worst, "");
}

constexpr const char* kConstruction =
    "stage,ring,laid,blocks,verdict,speed_ratio,least_stands,least_moves,head_squeeze_m,displacement_m,"
    "note\n";

TEST(Stages, TheMostDemandingStageSaysWhatMovesWithLess) {
  const CsvFile stages = parse_csv(std::string(kConstruction) +
                                       "0,20,4,124,equilibrium,1e-9,5000,4900,1e-6,4e-5,\n"
                                       "1,20,4,128,equilibrium,1e-9,6000,5900,1e-6,5e-5,\n"
                                       "2,20,2,130,equilibrium,1e-9,0,,2e-6,6e-5,\n",
                                   "construction.csv");
  const CsvFile failures = parse_csv(
      "stage,ring,block,course,how,relative_speed\n0,20,801,20,slides,1\n1,20,801,20,slides,1\n"
      "1,20,802,20,slides,0.5\n1,20,790,19,tips,0.2\n",
      "failures.csv");
  const StageReport c = blocks_laid(StagedConstruction::Least::cohesion, stages, failures);
  EXPECT_EQ(c.standing, 3);
  EXPECT_EQ(
      c.worst,
      "the most demanding: the 2nd of 3, in course 20; if the cohesion is less, 1 block of course 19 tips, 2 "
      "blocks of course "
      "20 slide");
  EXPECT_EQ(c.table.columns[5].key, "least_stands_Pa");
  EXPECT_EQ(std::get<double>(c.table.rows[1][5]), 6000.0);
  EXPECT_EQ(std::get<std::string>(c.table.rows[0][7]), "1 block of course 20 slides");
  ASSERT_TRUE(c.figure);
  EXPECT_NE(c.figure->commands.find("\n1 6 \n"), std::string::npos) << "in kPa";
}

TEST(Stages, TheFirstStageThatDoesNotStandSaysWhatMoves) {
  const CsvFile stages = parse_csv(std::string(kConstruction) +
                                       "0,3,4,124,equilibrium,1e-9,,,1e-6,4e-5,\n"
                                       "1,3,4,128,moving,0.3,,,,,\n",
                                   "construction.csv");
  const CsvFile failures =
      parse_csv("stage,ring,block,course,how,relative_speed\n1,3,12,3,slides,1\n", "failures.csv");
  const StageReport c = blocks_laid(StagedConstruction::Least::none, stages, failures);
  EXPECT_EQ(c.standing, 1);
  EXPECT_EQ(c.worst, "the first that does not: the 2nd of 2, in course 3, where 1 block of course 3 slides");
  EXPECT_FALSE(c.figure);
  for (const Table::Column& column : c.table.columns)
    EXPECT_FALSE(column.key.starts_with("least")) << column.key;
}

}  // namespace
}  // namespace cupola::stages_test

#include "postproc/report/load_path.hpp"

#include <gtest/gtest.h>

namespace cupola::load_path_test {
namespace {

TEST(LoadPath, FigureShowsForceOverDisplacementInReadableUnits) {
  const CsvFile csv = parse_csv(
      "time_s,displacement_m,force_N,dissipated_J,mean_damage,solves,widest_gap_m\n"
      "0,0,0,0,0,1,0\n0.5,0.001,57000,12.5,0.25,3,0.001\n1,0.002,41000,40,0.5,2,0\n",
      "path.csv");
  const Table table = path_table(csv);
  ASSERT_EQ(table.rows.size(), 3U);
  ASSERT_EQ(table.columns.size(), table.rows[0].size());
  EXPECT_EQ(path_times(csv), (std::vector{0.0, 0.5, 1.0}));
  EXPECT_EQ(std::get<double>(table.rows[1][2]), 57000.0);
  EXPECT_EQ(std::get<double>(table.rows[2][4]), 0.5);
  EXPECT_EQ(std::get<double>(table.rows[1][5]), 0.001);
  const std::string commands = path_figure(table).commands;
  EXPECT_NE(commands.find("\n1 57 12.5 \n"), std::string::npos) << "mm, kN, J: " << commands;
  EXPECT_NE(commands.find("displacement (mm)"), std::string::npos);
  EXPECT_NE(commands.find("force (kN)"), std::string::npos);
}

}  // namespace
}  // namespace cupola::load_path_test

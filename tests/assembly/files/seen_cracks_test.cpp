#include "assembly/files/seen_cracks.hpp"

#include <fstream>

#include <gtest/gtest.h>

#include "assembly/base/error.hpp"

namespace cupola::seen_cracks_test {
namespace {

std::string written(const std::string& text) {
  const std::string path = ::testing::TempDir() + "seen.csv";
  std::ofstream(path) << text;
  return path;
}

std::string error_of(const std::string& text) {
  try {
    read_seen_cracks(written(text));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(SeenCracks, StandInAnyOrderOfColumns) {
  const std::vector<SeenCrack> seen =
      read_seen_cracks(written("place, width_m ,azimuth_deg\r\nnorth,0.006,-45\r\n\r\neast,0,300\r\n"));
  ASSERT_EQ(seen.size(), 2u);
  EXPECT_EQ(seen[0].azimuth, -45.0);
  EXPECT_EQ(seen[0].width, 0.006);
  EXPECT_EQ(seen[1].azimuth, 300.0);
}

// Each error names line, column and rule, in one line.
TEST(SeenCracks, ErrorsNameTheCell) {
  const std::vector<std::pair<std::string, std::string>> cases{
      {"azimuth_deg,width_m\n45,0.006\n30,0\n", "seen.csv:3:1: error: azimuth_deg = 30: must be above"},
      {"azimuth_deg,width_m\n45,0.006\n405,0\n",
       "seen.csv:3:1: error: azimuth_deg = 405: must be within one"},
      {"azimuth_deg,width_m\n45, -1\n90,1\n", "seen.csv:2:5: error: width_m = -1: must be >= 0"},
      {"azimuth_deg,width_m\n45,6 mm\n90,1\n", "seen.csv:2:4: error: width_m = `6 mm`: must be a number"},
      {"azimuth_deg,width_m\n45\n", "seen.csv:2:1: error: 1 cell, but the first line names 2 columns"},
      {"azimuth_deg,width\n45,1\n90,1\n",
       "seen.csv:1:1: error: has no column width_m; did you mean it by width?"},
      {"azimuth_deg,width_m\n45,0\n90,0\n", "seen.csv: error: must hold two places or more, and a crack"}};
  for (const auto& [text, expected] : cases) {
    const std::string error = error_of(text);
    EXPECT_NE(error.find(expected), std::string::npos) << error;
    EXPECT_EQ(error.find('\n'), std::string::npos) << error;
  }
}

}  // namespace
}  // namespace cupola::seen_cracks_test

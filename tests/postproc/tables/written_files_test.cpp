#include "postproc/tables/written_files.hpp"

#include <fstream>

#include <gtest/gtest.h>

#include "tests/fresh_folder.hpp"

namespace cupola::written_files_test {
namespace {

namespace fs = std::filesystem;

void write(const fs::path& path, const std::string& text = "x") {
  fs::create_directories(path.parent_path());
  std::ofstream(path) << text;
}

TEST(WrittenFiles, ANewRunRemovesThoseOfTheLastAndNoOthers) {
  const fs::path folder = test::fresh_folder("written_files");
  write(folder / "notes.csv");
  write(folder / "rings.csv", "of a version that kept no list");
  {
    const WrittenFiles written(folder.string());
    write(folder / "rings.csv", "changed");
    write(folder / "hoop_a.csv");
    write(folder / "figures" / "hoop_a.svg");
  }
  write(folder / "figures" / "mine.svg");
  {
    const WrittenFiles written(folder.string());
    EXPECT_FALSE(fs::exists(folder / "rings.csv"));
    EXPECT_FALSE(fs::exists(folder / "hoop_a.csv"));
    EXPECT_FALSE(fs::exists(folder / "figures" / "hoop_a.svg"));
    EXPECT_TRUE(fs::exists(folder / "notes.csv"));
    EXPECT_TRUE(fs::exists(folder / "figures" / "mine.svg"));
  }
}

TEST(WrittenFiles, AnEditedListRemovesNothingOutsideTheFolder) {
  const fs::path folder = test::fresh_folder("written_files");
  write(folder / "post" / "a.csv");
  write(folder / "outside.csv");
  write(folder / "post" / ".written", "../outside.csv\n/etc/hosts\na.csv\n");
  const WrittenFiles written((folder / "post").string());
  EXPECT_TRUE(fs::exists(folder / "outside.csv"));
  EXPECT_FALSE(fs::exists(folder / "post" / "a.csv"));
}

}  // namespace
}  // namespace cupola::written_files_test

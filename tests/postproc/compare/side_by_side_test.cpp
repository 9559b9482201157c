// Maps of several runs side by side in the page of a comparison.

#include "postproc/compare/side_by_side.hpp"

#include <gtest/gtest.h>

#include "assembly/files/atomic_file.hpp"
#include "postproc/tables/mesh_output.hpp"
#include "postproc/tables/shell_map.hpp"
#include "tests/postproc/scene.hpp"

namespace cupola::side_by_side_test {
namespace {

size_t count(const std::string& text, const std::string& part) {
  size_t n = 0;
  for (size_t at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++n;
  return n;
}

TEST(SideBySide, EveryMapHasItsPicture) {
  const ShellMap map = shell_maps(test::column_evaluation(0.9, 0.3)).front();
  const Table table = shell_table(map, map.boxes);
  const std::string runs[] = {test::fresh_folder("one"), test::fresh_folder("two")};
  for (const std::string& run : runs) write_text_atomically(run + "/" + table.name + ".csv", to_csv(table));
  std::vector<Figure> maps = common_maps({runs[0], runs[1]}, {"A", "B"});
  ASSERT_GE(maps.size(), 2u);
  EXPECT_TRUE(maps[0].vector);
  maps[1].vector = false;  // as of thousands of boxes
  const std::string figures = test::fresh_folder("figures");
  ASSERT_TRUE(draw_figures(figures, maps).empty());
  const std::string html = maps_html(maps, figures);
  EXPECT_EQ(count(html, "<figure><img "), maps.size());
  EXPECT_EQ(count(html, "data:image/svg+xml;base64,"), maps.size() - 1);
  EXPECT_EQ(count(html, "data:image/png;base64,"), 1u);
  std::filesystem::remove(figures + "/" + maps[0].name + ".svg");
  EXPECT_NE(maps_html(maps, figures).find("<figure>Not drawn: " + maps[0].title + ", A"), std::string::npos);
}

TEST(SideBySide, WythesAreNamedAsInTheCase) {
  ShellMap map = shell_maps(test::column_evaluation(0.9, 0.3)).front();
  map.wythe = "wall 2";
  const Table table = shell_table(map, map.boxes);
  const std::string run = test::fresh_folder("run");
  write_text_atomically(run + "/" + table.name + ".csv", to_csv(table));
  const std::vector<Figure> maps = common_maps({run}, {"A"});
  ASSERT_FALSE(maps.empty());
  EXPECT_NE(maps[0].title.find("over the wythe wall 2"), std::string::npos) << maps[0].title;
  EXPECT_EQ(maps[0].name, "map_forces_wall_2 A");
}

}  // namespace
}  // namespace cupola::side_by_side_test

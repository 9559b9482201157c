// The data of the figures: resultants across beds, drawn to scale.

#include "postproc/figures/figures.hpp"

#include <cmath>
#include <cstdlib>
#include <filesystem>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "assembly/files/atomic_file.hpp"
#include "assembly/model/outward.hpp"
#include "postproc/compare/side_by_side.hpp"
#include "postproc/evaluation/meridians.hpp"
#include "postproc/figures/plot_style.hpp"
#include "postproc/figures/shell_maps.hpp"
#include "postproc/tables/mesh_output.hpp"
#include "postproc/tables/result_tables.hpp"
#include "tests/postproc/figures/figure_data.hpp"
#include "tests/postproc/mechanics/key_stone.hpp"
#include "tests/postproc/scene.hpp"

namespace cupola::figures_test {
namespace {

using test::data_of;
using test::kGravity;

const double kBlockWeight = 0.48 * 1800.0 * kGravity;

TEST(BedResultants, CarryTheLoadAboveTheBedWhereItActs) {
  const Evaluation e = test::column_evaluation(0.9, 0.3, 10.0);
  ASSERT_EQ(e.sections.size(), 1u);
  ASSERT_EQ(e.sections[0].resultants.size(), 1u);
  const BedResultant& r = e.sections[0].resultants[0];
  EXPECT_EQ(r.block, 3);
  // The weight of one block, and ten times the weight of all three.
  EXPECT_LT((r.wrench.force - Vec3(0, 0, 31.0 * kBlockWeight)).norm(), 1e-9 * kBlockWeight);
  EXPECT_LT((r.point - Vec3(0.9, 0.3, 1.0)).norm(), 1e-12);
  EXPECT_NEAR(r.couple_length, 0.0, 1e-12);
}

TEST(BedResultants, UprightBlockOfAWallCountsWithTheWrenchAtItsFoot) {
  // Rings 1 and 2 are one upright block of one part: no joint crosses it at the bed nearest to 0.8 m.
  Assembly a = test::column(3);
  a.blocks[2].num_rings = 2;
  a.blocks[2].kind = BlockKind::herringbone;
  Frame frame = test::column_at_rest(a, kGravity, 0.0, 0.6, 0.4);
  const Evaluation e = test::evaluated(a, {frame}, test::column_summary(a), test::column_case(),
                                       test::fresh_folder("results"));
  ASSERT_EQ(e.sections[0].resultants.size(), 1u) << "the block on the upright lies above the bed with it";
  EXPECT_EQ(e.sections[0].resultants[0].block, 2);
  EXPECT_NEAR(e.sections[0].resultants[0].wrench.force.z(), 2.0 * kBlockWeight, 1e-9 * kBlockWeight);
  EXPECT_NEAR(e.sections[0].resultants[0].point.z(), 0.5, 1e-12) << "at its foot";
  EXPECT_EQ(data_of(levels_figure(e), "upright").size(), 1u);
  EXPECT_TRUE(data_of(levels_figure(e), "flat").empty());
}

// Two blocks, one of which carries nothing: grey, with a legend, and outside the colour scale.
TEST(ShellMaps, NegligibleBlocksAreGrey) {
  ShellMap map{
      true,
      1,
      {{0, 0, -10, 10, 4e3, 0.0, std::nan(""), std::nan("")}, {1, 0, 170, 190, 2e3, -5e3, 0.5, 1.5}}};
  MapScales scales;
  scales.include(map);
  const Figure forces = force_map(map, scales), use = utilisation_map(map, scales);
  EXPECT_EQ(data_of(forces, "meridional").size(), 3u) << "the block across 180 degrees is drawn at both ends";
  EXPECT_TRUE(data_of(forces, "meridional_grey").empty());
  EXPECT_EQ(data_of(forces, "hoop").size(), 2u);
  EXPECT_EQ(data_of(forces, "hoop_grey").size(), 1u);
  EXPECT_NE(forces.commands.find("set cbrange [-5:5]"), std::string::npos);
  EXPECT_NE(forces.commands.find("title 'negligible'"), std::string::npos);
  EXPECT_EQ(data_of(use, "friction_grey").size(), 1u);
  EXPECT_EQ(data_of(use, "kern")[0][6], 1.5);
}

// A block in three rings, wider and then more loaded in the upper ones, and one above it.
TEST(ShellMaps, ABlockIsOneBoxWhereItIsEquallyWideAndLoaded) {
  const ShellMap map{true,
                     6,
                     {{0, 1, -10, 10, 4e3, 1e3, 0.1, 0.2},
                      {0, 2, -10, 10, 4e3, 1e3, 0.1, 0.2},
                      {0, 3, -10, 11, 4e3, 1e3, 0.1, 0.2},
                      {0, 4, -10, 11, 5e3, 1e3, 0.1, 0.2},
                      {1, 5, -10, 11, 5e3, 1e3, 0.1, 0.2}}};
  std::vector<std::pair<int, int>> boxes;
  for (const auto& [lowest, rings] : tall_boxes(map)) boxes.emplace_back(lowest.ring, rings);
  EXPECT_EQ(boxes, (std::vector<std::pair<int, int>>{{1, 2}, {3, 1}, {4, 1}, {5, 1}}));
  MapScales scales;
  scales.include(map);
  EXPECT_EQ(data_of(force_map(map, scales), "hoop")[0],
            (std::vector<double>{0, 2, -10, 10, 1, 3, 1}));  // x, y, and their ends; kN/m
}

// In grey both ends of the scale of hoop forces look the same: blocks in tension have a dot.
TEST(ShellMaps, TensionHasDots) {
  const auto dots = [](double hoop_force) {
    const ShellMap map{true, 1, {{0, 0, -10, 10, 4e3, hoop_force, 0.1, 0.2}}};
    MapScales scales;
    scales.include(map);
    const std::string commands = force_map(map, scales).commands;
    return std::pair(commands.find("$hoop_pulls using 1:2 with points") != std::string::npos,
                     commands.find("title 'tension'") != std::string::npos);
  };
  EXPECT_EQ(dots(-1e3), std::pair(true, true));
  EXPECT_EQ(dots(1e3), std::pair(false, false));
}

// Maps that are compared have the scale of the run with the largest values.
TEST(ShellMaps, IncludedMapsShareTheirScale) {
  const ShellMap small{true, 1, {{0, 0, -10, 10, 4e3, 1e3, 0.1, 0.2}}};
  const ShellMap large{true, 1, {{0, 0, -10, 10, -7e3, 9e3, 0.1, 2.5}}};
  MapScales scales;
  scales.include(small);
  scales.include(large);
  EXPECT_NE(force_map(small, scales).commands.find("set cbrange [-7:4]"), std::string::npos);
  EXPECT_NE(force_map(small, scales).commands.find("set cbrange [-9:9]"), std::string::npos);
  EXPECT_NE(utilisation_map(small, scales).commands.find("set cbrange [0:2.5]"), std::string::npos);
}

// The courses of an arch run along y. Over x its blocks have no width: the map was empty.
TEST(ShellMaps, OfAnArchRunAcrossIt) {
  Assembly a = test::column(3);
  a.sheets.front().thrust_lines = Sheet::ThrustLines::one;
  Frame frame = test::column_at_rest(a, test::kGravity, 0.0, 0.9, 0.3);
  const auto turn = [](Vec3& x) {
    x = Vec3(-x.y(), x.x(), x.z());
  };  // its faces are normal to x, as at a springing
  for (Vec3& x : a.vertices) turn(x);
  compute_mass_properties(&a);
  for (Vec3& x : frame.contacts.point) turn(x);
  for (Vec3& x : frame.blocks.position) turn(x);
  const Evaluation e = test::evaluated(a, {frame}, test::column_summary(a), test::column_case(),
                                       test::fresh_folder("results"));
  const ShellMap map = shell_maps(e).front();
  EXPECT_EQ(shell_table(map, {}).name, "arch");
  ASSERT_EQ(map.boxes.size(), 3u);
  for (const ShellBox& box : map.boxes) EXPECT_NEAR(box.to - box.from, 1.2, 1e-12);
  EXPECT_NE(utilisation_map(map, {}).title.find("over the arch"), std::string::npos);
  MeridianEvaluation line = e.meridians.front();
  EXPECT_NE(thrust_figure(e, line).caption.find("resultant of the full width"), std::string::npos);
  EXPECT_EQ(thrust_figure(e, line).title, "Thrust line of the arch");
  line.thrust.name = "buttress 2";
  EXPECT_EQ(thrust_figure(e, line).title, "Thrust line of buttress 2");
  EXPECT_EQ(thrust_figure(e, line).name, "thrust_buttress_2");
  EXPECT_EQ(thrust_table(line.thrust).name, "thrust_buttress_2");
  // Outwards of an arch is along x: by the slanting direction from the z axis a barrel lost a fifth of its
  // thrust.
  EXPECT_EQ(outward_at({-3.0, 2.0, 0.0}, true), Vec3(-1, 0, 0));
  EXPECT_EQ(outward_at({-3.0, 4.0, 0.0}, false), Vec3(-0.6, 0.8, 0));
}

// Imported walls have their origin in the middle of their supports; a turned member keeps its own axis.
TEST(ShellMaps, ShowAWallWhereItStandsInTheModel) {
  Assembly a = test::column(3);
  a.sheets.front().origin = Vec3(0.6, 0.4, 0.0);
  const Evaluation e =
      test::evaluated(a, {test::column_at_rest(a, test::kGravity, 0.0, 0.9, 0.3)}, test::column_summary(a),
                      test::column_case(), test::fresh_folder("results"));
  const ShellMap map = shell_maps(e).front();
  ASSERT_EQ(map.boxes.size(), 3u);
  for (const ShellBox& box : map.boxes) {
    EXPECT_EQ(box.from, 0.0);
    EXPECT_EQ(box.to, 1.2);
  }
}

// A wall along y, or askew, had the width 0 or a shortened one.
TEST(ShellMaps, MeasureAlongTheWall) {
  for (const double degrees : {30.0, 90.0, 150.0}) {
    Assembly a = test::column(3);
    Frame frame = test::column_at_rest(a, test::kGravity, 0.0, 0.9, 0.3);
    const Eigen::AngleAxisd turn(degrees * std::numbers::pi / 180.0, Vec3::UnitZ());
    for (std::vector<Vec3>* points : {&a.vertices, &frame.contacts.point, &frame.blocks.position})
      for (Vec3& x : *points) x = turn * x;
    compute_mass_properties(&a);
    const Evaluation e = test::evaluated(a, {frame}, test::column_summary(a), test::column_case(),
                                         test::fresh_folder("results"));
    const ShellMap map = shell_maps(e).front();
    ASSERT_EQ(map.boxes.size(), 3u);
    for (const ShellBox& box : map.boxes) {
      EXPECT_NEAR(box.from, degrees < 100.0 ? 0.0 : -1.2, 1e-12);  // towards x, or y
      EXPECT_NEAR(box.to, degrees < 100.0 ? 1.2 : 0.0, 1e-12);
    }
  }
}

// Its last facet ends where the first begins: the map had a hole as wide as one of them.
TEST(ShellMaps, HaveAKeyStoneAroundTheWholeAxis) {
  Evaluation e;
  e.assembly = test::KeyStone(0.3).assembly;
  e.shell = shell_of(e.assembly, Vec3::UnitZ());
  e.last.fields.resize(e.assembly.blocks.size());
  const ShellMap map = shell_maps(e).front();
  const auto key = std::ranges::find(map.boxes, test::kRound, &ShellBox::block);
  ASSERT_NE(key, map.boxes.end());
  EXPECT_EQ(key->from, -180.0);
  EXPECT_EQ(key->to, 180.0);
  EXPECT_NEAR(map.boxes.front().to - map.boxes.front().from, 45.0, 1e-9);  // deg, of a wedge: rounding
}

TEST(ShellMaps, ReadBackUnchangedFromTheTable) {
  const ShellMap map = shell_maps(test::column_evaluation(0.9, 0.3)).front();
  ASSERT_EQ(map.boxes.size(), 3u);
  const std::string folder = test::fresh_folder("post");
  write_text_atomically(folder + "/wall.csv", to_csv(shell_table(map, map.boxes)));
  const auto read = read_shell_maps(folder);
  ASSERT_EQ(read.size(), 1u);
  EXPECT_FALSE(read[0].vault);
  EXPECT_EQ(read[0].num_rings, 3);
  for (size_t i = 0; i < 3; ++i) EXPECT_EQ(read[0].boxes[i].meridional_force, map.boxes[i].meridional_force);
  EXPECT_TRUE(read_shell_maps("/nowhere/at/all").empty());
}

TEST(ShellMaps, OfTheMembersOfRunsStandSideBySide) {
  ShellMap map = shell_maps(test::column_evaluation(0.9, 0.3)).front();
  const std::string folders[] = {test::fresh_folder("one"), test::fresh_folder("two")};
  for (const std::string& folder : folders)
    for (const char* member : {"upper wall", "base"}) {
      map.wythe = member;
      map.vault = member == std::string("base");
      for (ShellBox& box : map.boxes) box.ring = box.ring % 3 + (map.vault ? 0 : 3);
      const Table table = shell_table(map, map.boxes);
      write_text_atomically(folder + "/" + table.name + ".csv", to_csv(table));
    }
  const std::vector<Figure> maps = common_maps({folders[0], folders[1]}, {"A", "B"});
  ASSERT_GE(maps.size(), 4u);
  const char* names[] = {"map_forces_base A", "map_forces_base B", "map_forces_upper_wall A",
                         "map_forces_upper_wall B"};
  for (size_t i = 0; i < 4; ++i) EXPECT_EQ(maps[i].name, names[i]);
  EXPECT_NE(maps[0].title.find("over the wythe base"), std::string::npos) << maps[0].title;
  EXPECT_EQ(read_shell_maps(folders[0])[1].first_ring, 3);
}

// A wythe of a dome was read back as a wall if its name was `x`, as an arch if it was `y`.
TEST(ShellMaps, KeepTheirKindWhateverTheirWytheIsCalled) {
  ShellMap map = shell_maps(test::column_evaluation(0.9, 0.3)).front();
  const std::string folder = test::fresh_folder("post");
  map.vault = true;
  for (const char* wythe : {"x", "y", "wall", "arch"}) {
    map.wythe = wythe;
    const Table table = shell_table(map, map.boxes);
    write_text_atomically(folder + "/" + table.name + ".csv", to_csv(table));
  }
  const std::vector<ShellMap> read = read_shell_maps(folder);
  ASSERT_EQ(read.size(), 4u);
  for (const ShellMap& back : read) EXPECT_TRUE(back.vault && !back.arch) << back.wythe;
}

TEST(Panels, FillTheirFrameRowByRowFromTheTop) {
  const std::vector<PanelBox> boxes = panel_grid(2, 2, {0.1, 0.9, 0.2, 1.0}, 0.2, 0.4);
  ASSERT_EQ(boxes.size(), 4u);
  const double expected[4][4] = {
      {0.1, 0.4, 0.8, 1.0}, {0.6, 0.9, 0.8, 1.0}, {0.1, 0.4, 0.2, 0.4}, {0.6, 0.9, 0.2, 0.4}};
  for (size_t i = 0; i < 4; ++i) {
    const double box[4] = {boxes[i].left, boxes[i].right, boxes[i].bottom, boxes[i].top};
    for (size_t k = 0; k < 4; ++k) EXPECT_NEAR(box[k], expected[i][k], 1e-15) << i << " " << k;  // rounding
  }
  const std::string drawn = panels(boxes, {"plot 1\n", "plot 2\n"});
  EXPECT_NE(drawn.find("set lmargin at screen 0.6"), std::string::npos) << drawn;
  EXPECT_LT(drawn.find("plot 1"), drawn.find("plot 2"));
  EXPECT_TRUE(drawn.starts_with("set multiplot\n") && drawn.ends_with("unset multiplot\n")) << drawn;
}

// The same run writes the same bytes.
TEST(Figures, HaveNoDate) {
  Figure figure;
  figure.name = "line";
  figure.commands = "plot x\n";
  const std::string folder = test::fresh_folder("figures");
  ASSERT_TRUE(draw_figures(folder, {figure}).empty());
  EXPECT_NE(read_text(folder + "/line.pdf").find("/CreationDate (D:19700101000000"), std::string::npos);
}

TEST(Figures, TicksDifferAtCoordinatesOfMaps) {
  Figure figure;
  figure.name = "map";
  figure.commands = plot_style() + "set yrange [5399990:5400010]\nset ytics 5\nplot 5400000\n";
  const std::string folder = test::fresh_folder("figures");
  ASSERT_TRUE(draw_figures(folder, {figure}).empty());
  EXPECT_NE(read_text(folder + "/map.svg").find("5399995"), std::string::npos);
}

// gnuplot reads commands from ~/.gnuplot before those of a script.
TEST(Figures, DoNotDependOnTheHomeFolder) {
  Figure figure;
  figure.name = "line";
  figure.commands = "plot x\n";
  const std::string home = test::fresh_folder("home"), plain = test::fresh_folder("plain");
  ASSERT_TRUE(draw_figures(plain, {figure}).empty());
  write_text_atomically(home + "/.gnuplot", "set macros\nplot nothing\n");
  const char* const old_home = std::getenv("HOME");
  const std::string kept = old_home == nullptr ? "" : old_home;
  ::setenv("HOME", home.c_str(), 1);
  const std::vector<std::string> problems = draw_figures(home, {figure});
  if (old_home == nullptr)
    ::unsetenv("HOME");
  else
    ::setenv("HOME", kept.c_str(), 1);
  EXPECT_EQ(problems, std::vector<std::string>());
  EXPECT_EQ(read_text(home + "/line.svg"), read_text(plain + "/line.svg"));
}

// gnuplot ends at the first error, and its settings would reach the next figure. What draws no figure, be it a
// signal or an empty file, must not end the page with its tables.
TEST(Figures, DoNotDependOnEachOther) {
  const auto figure = [](const char* name, const char* commands) {
    Figure made;
    made.name = name;
    made.commands = commands;
    return made;
  };
  const Figure plain = figure("plain", "plot x\n");
  const std::string alone = test::fresh_folder("alone"), together = test::fresh_folder("together");
  ASSERT_TRUE(draw_figures(alone, {plain}).empty());
  const std::vector<std::string> problems = draw_figures(
      together, {figure("first", "set logscale y\nset multiplot\nplot 1\nunset multiplot\n"), plain,
                 figure("broken", "plot nothing\n"), figure("worse", "plot '/no/such/file'\n"),
                 figure("killed", "system 'kill -9 $PPID'\n"), figure("empty", "set output\n"),
                 figure("last", "plot x\n")});
  ASSERT_EQ(problems.size(), 4u);
  EXPECT_TRUE(problems[0].starts_with("figure broken was not drawn: gnuplot: ")) << problems[0];
  EXPECT_NE(problems[0].find("undefined variable: nothing"), std::string::npos) << problems[0];
  EXPECT_TRUE(problems[1].starts_with("figure worse was not drawn: gnuplot: ")) << problems[1];
  EXPECT_EQ(problems[2],
            "figure killed was not drawn: gnuplot: ended by signal 9, as happens when memory runs out");
  EXPECT_TRUE(problems[3].starts_with("figure empty was not drawn: gnuplot wrote an empty file"))
      << problems[3];
  EXPECT_EQ(read_text(together + "/plain.pdf"), read_text(alone + "/plain.pdf"));
  for (const char* file : {"/first.pdf", "/last.svg", "/last.pdf"})
    EXPECT_TRUE(std::filesystem::exists(together + file)) << file;
  EXPECT_FALSE(std::filesystem::exists(together + "/broken.svg"));
  EXPECT_FALSE(std::filesystem::exists(together + "/.drawing"));
}

// A chart of zeros has no message.
TEST(Figures, AreLeftOutWhereEverythingIsNegligible) {
  const auto names = [](const Evaluation& e) {
    std::string all;
    for (const Figure& figure : result_figures(e, {})) all += figure.name + " ";
    return all;
  };
  EXPECT_EQ(names(test::column_evaluation(0.6, 0.4)).find("rings"), std::string::npos)
      << "central and without friction";
  EXPECT_NE(names(test::column_evaluation(0.9, 0.4)).find("rings"), std::string::npos);
  Evaluation e = test::column_evaluation(0.9, 0.4);
  e.meridians.resize(1);
  e.meridians[0].thrust = thrust_line(thrust_input(e, e.last), "arch", std::nullopt);
  EXPECT_NE(names(e).find("thrust"), std::string::npos);
  e.meridians[0].thrust.undefined = static_cast<int>(e.meridians[0].thrust.points.size());
  EXPECT_EQ(names(e).find("thrust"), std::string::npos) << "no point of the line has a place";
  ShellMap map{false, 2, {}};
  map.boxes.resize(1);
  map.boxes[0].meridional_force = 1e3;
  MapScales scales;
  scales.include(map);
  EXPECT_EQ(utilisation_map(map, scales).commands, "");
  EXPECT_EQ(force_map(map, scales).commands.find("horizontal force"), std::string::npos);
  EXPECT_NE(force_map(map, scales).commands.find("vertical force"), std::string::npos);
}

// Course 0 of an arch stands on the support at +x, which other figures show on the right.
TEST(ShellMaps, AnArchBeginsOnTheRight) {
  ShellMap map{.num_rings = 1, .boxes = {{0, 0, 0.0, 1.0, 4e3, 0.0, 0.5, 1.5}}, .arch = true};
  MapScales scales;
  scales.include(map);
  EXPECT_TRUE(force_map(map, scales)
                  .caption.starts_with("The unrolled arch from the right springing (course 0) to the left."))
      << force_map(map, scales).caption;
}

// Courses of an arch from one springing to the other: a line up each haunch, which meet at the crown.
TEST(RingFigure, HasALinePerHaunch) {
  Evaluation e = test::column_evaluation(0.9, 0.4);
  e.assembly.sheets.clear();  // which have only the rings of the column
  e.rings.clear();
  for (const double height : {0.0, 1.0, 2.0, 1.5, 0.5})
    e.rings.push_back({.ring = static_cast<int>(e.rings.size()), .height = height, .blocks = 1});
  const std::string commands = ring_figure(e).commands;
  EXPECT_NE(commands.find("\n0 0 0 0 \n1 0 0 0 \n2 0 0 0 \n\n2 0 0 0 \n1.5 0 0 0 \n0.5 0 0 0 \n"),
            std::string::npos)
      << commands;
}

}  // namespace
}  // namespace cupola::figures_test

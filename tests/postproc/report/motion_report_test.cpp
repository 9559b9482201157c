// What reports say of a motion that came back: how far it went and when, and where it ended.

#include <gtest/gtest.h>

#include "postproc/figures/figures.hpp"
#include "postproc/report/answers.hpp"
#include "postproc/report/motion.hpp"
#include "postproc/report/report.hpp"
#include "postproc/tables/mesh_output.hpp"
#include "postproc/viewer/film.hpp"
#include "tests/postproc/scene.hpp"

namespace cupola::motion_report_test {
namespace {

/// Farthest at 3.05 s, 154 mm, and back at 50 mm after 12 s.
Evaluation returned(Status status, double threshold) {
  Evaluation e = test::column_evaluation(0.6, 0.4);
  e.scene.analysis.thresholds.displacement = threshold;
  e.scene.supports.base_motion = BaseMotion{};
  e.last.frame.role = FrameRole::step;
  e.last.frame.time = 12.0;
  e.last.frame.blocks.displacement[2] = Vec3(0.05, 0, 0);
  e.summary.analysis = AnalysisType::dynamic;
  e.summary.status = status;
  e.summary.max_displacement_m = 0.154;
  e.summary.max_displacement_time_s = 3.05;
  e.summary.final_displacement_m = 0.05;
  e.summary.rest_at_end = true;
  return e;
}

bool has(const std::string& text, const std::string& words) {
  return text.find(words) != std::string::npos;
}

TEST(ReturnedMotion, CollapseSaysThatItIsAtRestAtItsEnd) {
  const Evaluation e = returned(Status::collapsed, 0.1);
  EXPECT_EQ(margin_answer(e).detail().find("it rests only after it collapsed; to compute"), 0u);
  const std::string reason = reason_for_verdict(e);
  EXPECT_TRUE(has(reason,
                  "Within 12 s a block moves by up to 154 mm relative to the ground (at 3.05 s; 50 mm at the "
                  "end); a displacement above 100 mm counts as collapse. At the end it is at rest: with "
                  "`analysis.thresholds.displacement` above 154 mm it counts as standing."))
      << reason;
  const std::vector<KeyNumber> numbers = motion_numbers(e, {});
  ASSERT_FALSE(numbers.empty());
  EXPECT_EQ(numbers.front().value, "154 mm");
  EXPECT_EQ(numbers.front().detail(), "at 3.05 s, relative to the ground; 50 mm at the end");
  EXPECT_TRUE(has(motion_sentences(e, {}).front(), "largest displacement of the motion is 0.154 m"));
}

// Slow blocks are counted neither among those that begin to move nor among their bodies.
TEST(Mechanism, HasNoMoreBodiesThanBlocks) {
  Evaluation e = test::column_evaluation(0.6, 0.4);
  e.last.frame.role = FrameRole::mechanism;
  e.last.groups = {0, 1, 2, 3};
  e.last.frame.blocks.displacement = {Vec3::Zero(), {0.05, 0, 0}, {0.06, 0, 0}, {1, 0, 0}};
  e.summary.status = Status::moving;
  const KeyNumber number = motion_numbers(e, {}).at(0);
  EXPECT_EQ(number.value, "1 of 3");
  EXPECT_TRUE(number.detail().ends_with("they form 1 body")) << number.detail();
}

TEST(ReturnedMotion, RestSaysHowFarItWent) {
  const std::string reason = reason_for_verdict(returned(Status::stable, 0.222));
  EXPECT_TRUE(has(reason,
                  "at rest after 12 s of motion, in which a block moves by up to 154 mm relative to the "
                  "ground (at 3.05 s; 50 mm at the end)"))
      << reason;
}

// Histories have the speed of the fastest point and the displacement of the farthest one.
TEST(ReturnedMotion, SaysWhatMoves) {
  const Evaluation e = returned(Status::collapsed, 0.1);
  const std::vector<HistoryRow> history{{.time = 1.0, .max_speed = 0.2},
                                        {.time = 12.0, .max_speed = 0.01714}};
  const auto numbers = motion_numbers(e, history);
  EXPECT_TRUE(std::ranges::any_of(numbers, [](const KeyNumber& number) {
    return number.name == "Fastest point" && number.value == "0.0171 m/s";
  }));
  EXPECT_TRUE(history_figure(e, history)
                  .caption.starts_with("Largest displacement and speed of a point of the blocks"))
      << history_figure(e, history).caption;
}

// What fell and lies still is not said to stand under a larger threshold.
TEST(ReturnedMotion, DebrisAtRestHasFallen) {
  Evaluation e = returned(Status::collapsed, 0.1);
  e.summary.final_displacement_m = 0.12;
  EXPECT_FALSE(has(reason_for_verdict(e), "counts as standing"));
}

// The ground has moved by 2 m and carries the blocks along, one of which has slid back by 50 mm.
TEST(ReturnedMotion, IsDrawnFromTheGround) {
  Evaluation e = returned(Status::collapsed, 0.1);
  const Vec3 ground(2, 0, 0);
  BlockTable& blocks = e.last.frame.blocks;
  for (size_t b = 0; b < blocks.position.size(); ++b)
    blocks.position[b] = e.assembly.blocks[b].centroid + blocks.displacement[b] + ground;
  e.scene.supports.base_motion = BaseMotion{};
  e.last = evaluate_frame(e, e.last.frame);
  Film film(e);
  film.add(static_cast<size_t>(e.last_frame), e.last);
  ASSERT_EQ(film.shifts().size(), 3 * blocks.position.size());
  for (size_t b = 0; b < blocks.position.size(); ++b)
    EXPECT_NEAR(film.shifts()[3 * b], blocks.displacement[b].x(), 1e-12);
  DisplacedBlocks displaced(e);
  const Mesh& mesh = displaced.at(e.last);
  const auto& shown = std::get<std::vector<double>>(mesh.point_data.at(0).values);
  const auto [least, most] = std::ranges::minmax(shown);
  EXPECT_NEAR(most, 0.05, 1e-12);
  EXPECT_NEAR(least, 0.0, 1e-12);
}

}  // namespace
}  // namespace cupola::motion_report_test

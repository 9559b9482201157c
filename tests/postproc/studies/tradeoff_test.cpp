#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "assembly/files/atomic_file.hpp"
#include "postproc/studies/study.hpp"
#include "postproc/studies/study_figures.hpp"
#include "postproc/studies/study_text.hpp"
#include "tests/fresh_folder.hpp"

namespace cupola::tradeoff_test {
namespace {

using test::fresh_folder;

std::string written(const std::string& text) {
  const std::string path = fresh_folder("study") + "/study.txt";
  write_text_atomically(path, text);
  return path;
}

std::string error_of(const std::string& text) {
  try {
    read_study({written(text)});
  } catch (const InputError& error) {
    const std::string message = error.what();
    return message.substr(message.find("study.txt"));
  }
  return "";
}

TEST(StudyFile, ReadsKnobNameReferenceAndSettings) {
  const std::vector<StudyPoint> points =
      read_study({written("# comment\n\nmethod exact exact  a.b=1\nmethod fast exact c=2 d=[1,2]\n")});
  ASSERT_EQ(points.size(), 2u);
  EXPECT_TRUE(points[0].is_reference());
  EXPECT_EQ(points[1].knob, "method");
  EXPECT_EQ(points[1].settings, (std::vector<std::string>{"c=2", "d=[1,2]"}));
}

TEST(StudyRow, UsesWallTimeIfThreadsAreTheKnob) {
  const std::vector<StudyPoint> points = read_study({written("t one one --threads=1\nm two two a=1\n")});
  Summary summary;
  summary.cpu_time_seconds = 2.0;
  summary.wall_time_seconds = 1.25;
  EXPECT_EQ((StudyRow{points[0], summary, {}, {}}).seconds(), 1.25);
  EXPECT_EQ((StudyRow{points[1], summary, {}, {}}).seconds(), 2.0);
}

TEST(StudyFile, NamesTheInvalidLine) {
  EXPECT_EQ(error_of("a b\n"), "study.txt:1: error: expected KNOB NAME REFERENCE key.path=value ...");
  EXPECT_EQ(error_of("a b b x\n"), "study.txt:1: error: x: must have the form key.path=value");
  EXPECT_EQ(error_of("a b b\na b b\n"),
            "study.txt:2: error: b: another run has this name; names must be unique");
  EXPECT_EQ(error_of("a b c\n"),
            "study.txt:1: error: b: no line defines c as a reference, that is, with itself as reference");
  EXPECT_THROW(read_study({written("# nothing\n")}), InputError);
}

TEST(StudyFile, ExtrapolatesFromTwoRunsWhoseStepsDifferByTwo) {
  const std::string two =
      "t fine fine+coarse analysis.time_step=0.1\nt coarse fine+coarse analysis.time_step=";
  const std::vector<StudyPoint> points = read_study({written(two + "0.2\n")});
  EXPECT_FALSE(points[0].is_reference());
  EXPECT_EQ(points[1].reference_text(), "2 x fine - coarse");
  EXPECT_EQ(error_of(two + "0.3\n"),
            "study.txt:1: error: fine: extrapolation requires that analysis.time_step of coarse is twice "
            "that of fine");
  EXPECT_EQ(error_of("t fine fine+lost analysis.time_step=0.1\n"),
            "study.txt:1: error: fine: no line defines lost");
}

/// Two joints of area 4 m2 that carry 100 N and 300 N upwards at x = 0.
RunForces two_joints() {
  RunForces forces;
  forces.mean_area = 4.0;
  forces.beds[{0, 1, "base"}] = {Vec3::Zero(), Vec3(0, 0, 300), Vec3::Zero()};
  forces.beds[{1, 2, "bed"}] = {Vec3(0, 0, 1), Vec3(0, 0, 100), Vec3::Zero()};
  forces.thrust["thrust_arch"] = {{0, 0.5}, {1, 0.25}};
  forces.base_thrust = 50.0;
  return forces;
}

TEST(ForceErrors, AreZeroForTheSameRunWithMomentsAboutOtherPoints) {
  const RunForces reference = two_joints();
  RunForces same = reference;
  for (auto& [id, wrench] : same.beds) wrench = moved_to(wrench, {3, -2, 7});
  const ForceErrors errors = compare_forces(reference, same);
  EXPECT_NEAR(errors.wrench_rms, 0.0, 1e-15);
  EXPECT_NEAR(errors.wrench_worst, 0.0, 1e-15);
  EXPECT_EQ(errors.thrust_line, 0.0);
  EXPECT_EQ(errors.base_thrust, 0.0);
}

// A force of 100 N that acts 0.6 m away is a moment of 60 N m: 60 / sqrt(4 m2) = 30 N. Root mean square of
// the reference: sqrt(300^2 + 100^2) over the two joints.
TEST(ForceErrors, ConvertMomentsToForcesByTheSideOfTheJoint) {
  const RunForces reference = two_joints();
  RunForces run = reference;
  run.beds[{1, 2, "bed"}].point.x() += 0.6;
  run.thrust["thrust_arch"][1] = 0.35;
  run.base_thrust = 45.0;
  const ForceErrors errors = compare_forces(reference, run);
  const double size = std::sqrt(300.0 * 300 + 100 * 100);
  EXPECT_NEAR(errors.wrench_rms, 30.0 / size, 1e-12);
  EXPECT_NEAR(errors.wrench_worst, 30.0 / (size / std::sqrt(2.0)), 1e-12);
  EXPECT_NEAR(errors.thrust_line, 0.1, 1e-12);
  EXPECT_NEAR(errors.base_thrust, 0.1, 1e-12);
}

// Forces F + a h with steps h and 2 h: the extrapolation gives F, and the error of the run with step h is a
// h, where the difference between the two runs is also a h: measured against the finer run, the coarser one
// would seem twice as good.
TEST(ForceErrors, ExtrapolationRemovesAnErrorOfFirstOrder) {
  const RunForces exact = two_joints();
  const auto with_step = [&exact](double h) {
    RunForces run = exact;
    for (auto& [id, wrench] : run.beds) wrench.force.z() += 10.0 * h;
    run.beds[{2, 3, "bed"}] = {Vec3(0, 0, 2), Vec3(0, 0, h), Vec3(h, 0, 0)};
    run.thrust["thrust_arch"][1] += 0.01 * h;
    run.base_thrust += h;
    for (auto& [id, wrench] : run.beds) wrench = moved_to(wrench, {h, 0, 0});
    return run;
  };
  const RunForces reference = extrapolated(with_step(1.0), with_step(2.0));
  const ForceErrors none = compare_forces(exact, reference);
  EXPECT_NEAR(none.wrench_rms, 0.0, 1e-14);
  EXPECT_NEAR(none.thrust_line, 0.0, 1e-14);
  EXPECT_NEAR(none.base_thrust, 0.0, 1e-14);
  const double fine = compare_forces(reference, with_step(1.0)).wrench_rms;
  EXPECT_NEAR(compare_forces(reference, with_step(2.0)).wrench_rms, 2.0 * fine, 1e-14);
  EXPECT_GT(fine, 0.01);
}

TEST(ForceErrors, AJointMissingInOneRunCountsAsUnloaded) {
  const RunForces reference = two_joints();
  RunForces run = reference;
  run.beds.erase({1, 2, "bed"});
  const double size = std::sqrt(300.0 * 300 + 100 * 100);
  EXPECT_NEAR(compare_forces(reference, run).wrench_rms, 100.0 / size, 1e-12);
  EXPECT_NEAR(compare_forces(run, reference).wrench_rms, 100.0 / 300.0, 1e-12);
}

StudyRow row(const std::string& name, double seconds, double error, Status status = Status::stable) {
  StudyRow r{{"method", name, "exact", "", {}}, Summary{}, {}, {}};
  r.summary->cpu_time_seconds = seconds;
  r.summary->status = status;
  r.errors.wrench_rms = r.errors.wrench_worst = error;
  return r;
}

std::vector<StudyRow> small_study() {
  StudyRow missing{{"method", "lost", "exact", "", {}}, std::nullopt, {}, {}};
  return {row("exact", 9, 0),
          row("b_2", 2, 1e-3),
          row("c_3", 3, 1e-2),
          row("a_1", 1, 0.3),
          row("d_4", 4, 1e-7),
          row("e_5", 0.5, 1e-9, Status::unconverged),
          missing};
}

TEST(Study, FrontHoldsRunsThatNoFasterRunBeats) {
  const std::vector<StudyRow> front = pareto_front(rows_of(small_study(), "method"));
  ASSERT_EQ(front.size(), 3u);
  EXPECT_EQ(front[0].point.name, "a_1");
  EXPECT_EQ(front[1].point.name, "b_2");
  EXPECT_EQ(front[2].point.name, "d_4");
}

TEST(Study, RanksLimitAnalysesByTheirCriticalValue) {
  StudyRow fast = row("fast", 1, 0.9), fine = row("fine", 2, 0.9);
  fast.critical_error = 1e-2;
  fine.critical_error = 1e-4;
  EXPECT_EQ(pareto_front({fast, fine}).size(), 2u);
  EXPECT_EQ(study_text({fast, fine}).back().find("single joint"), std::string::npos);
}

TEST(Study, TextNamesTheFastestTheExchangeTheUnreachedAndTheMissing) {
  std::string text;
  for (const std::string& paragraph : study_text(small_study())) text += paragraph + "\n";
  for (const char* phrase :
       {"Not run: lost.",
        "Fastest run within 0.1 and 0.01 and 0.001: b_2 (2 s, 1.0e-03); within 1e-06: d_4 (4 s, 1.0e-07).",
        "From a_1 to d_4 the time grows by a factor of 4 and the error falls by a factor of 3e+06.",
        "Requested accuracy not reached: e_5"})
    EXPECT_NE(text.find(phrase), std::string::npos) << phrase << "\n" << text;
}

TEST(Study, TheTableHasARowPerRunAndEveryKnobAFigure) {
  const Table table = study_table(small_study());
  EXPECT_EQ(table.rows.size(), 7u);
  for (const auto& cells : table.rows) EXPECT_EQ(cells.size(), table.columns.size());
  EXPECT_EQ(std::get<std::string>(table.rows.back()[4]), "not run");
  const std::vector<Figure> figures = study_figures(small_study());
  ASSERT_EQ(figures.size(), 2u);
  EXPECT_EQ(figures[0].name, "tradeoff");
  EXPECT_EQ(figures[1].name, "tradeoff_method");
}

}  // namespace
}  // namespace cupola::tradeoff_test

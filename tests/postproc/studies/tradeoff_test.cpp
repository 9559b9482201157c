#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "assembly/files/atomic_file.hpp"
#include "postproc/studies/study.hpp"
#include "postproc/studies/tradeoff_figures.hpp"
#include "postproc/studies/tradeoff_text.hpp"
#include "tests/fresh_folder.hpp"

namespace cupola::tradeoff_test {
namespace {

using test::fresh_folder;

/// The trade-off of one knob with these runs, each {name: ..., set: ...}.
std::string knob(const std::string& reference, const std::string& runs) {
  return "  - {knob: t, " + reference + ", runs: [" + runs + "]}\n";
}

std::vector<TradeoffRun> tradeoff_of(const std::string& knobs) {
  const std::string path = fresh_folder("study") + "/study.yaml";
  write_text_atomically(path, "case: dome\ntradeoff:\n" + knobs);
  return read_study(path).tradeoff;
}

std::string error_of(const std::string& knobs) {
  try {
    tradeoff_of(knobs);
  } catch (const InputError& error) {
    const std::string message = error.what();
    return message.substr(message.find("study.yaml"));
  }
  return "";
}

TEST(Tradeoff, ReadsKnobsRunsAndTheSettingsTheyShare) {
  const std::vector<TradeoffRun> runs = tradeoff_of(
      "  - {knob: method, reference: exact, set: a.b=1, runs: [{name: exact}, {name: fast, set: "
      "'c=2 d=[1,2]'}]}\n"
      "  - {knob: other, reference: exact, only: vault, runs: [{name: more}]}\n");
  ASSERT_EQ(runs.size(), 2u) << "the second knob is of another case";
  EXPECT_TRUE(runs[0].is_reference());
  EXPECT_EQ(runs[1].knob, "method");
  EXPECT_EQ(runs[1].settings, (std::vector<std::string>{"a.b=1", "c=2", "d=[1,2]"}));
  EXPECT_EQ(runs[1].folder, "study/dome/fast");
}

TEST(TradeoffRow, UsesWallTimeIfThreadsAreTheKnob) {
  const std::vector<TradeoffRun> runs =
      tradeoff_of(knob("reference: one", "{name: one, set: --threads=1}, {name: two, set: a=1}"));
  Summary summary;
  summary.cpu_time_seconds = 2.0;
  summary.wall_time_seconds = 1.25;
  EXPECT_EQ((TradeoffRow{runs[0], summary, {}, {}}).seconds(), 1.25);
  EXPECT_EQ((TradeoffRow{runs[1], summary, {}, {}}).seconds(), 2.0);
}

TEST(Tradeoff, ErrorsNameThePlace) {
  EXPECT_EQ(error_of(knob("reference: b", "{name: b, set: x}")),
            "study.yaml:3:51: error: tradeoff[0].runs[0].set = x: must be key.path=value ..., of letters, "
            "digits and . _ + - [ ] , : only");
  EXPECT_NE(error_of(knob("reference: b", "{name: b}, {name: b}")).find(":3:5: error: b: another run has"),
            std::string::npos);
  EXPECT_EQ(error_of(knob("reference: exakt", "{name: a}") + knob("reference: exact", "{name: exact}")),
            "study.yaml:3:26: error: reference = exakt: no run of this name has itself as reference; did you "
            "mean exact?");
}

TEST(Tradeoff, ExtrapolatesFromTwoRunsWhoseStepsDifferByTwo) {
  const auto two = [](const std::string& step) {
    return knob(
        "reference: fine, coarse: coarse",
        "{name: fine, set: analysis.time_step=0.1}, {name: coarse, set: analysis.time_step=" + step + "}");
  };
  const std::vector<TradeoffRun> runs = tradeoff_of(two("0.2"));
  EXPECT_FALSE(runs[0].is_reference());
  EXPECT_EQ(runs[1].reference_text(), "2 x fine - coarse");
  EXPECT_NE(error_of(two("0.3")).find("analysis.time_step of coarse is twice that of fine"),
            std::string::npos);
  EXPECT_NE(error_of(knob("reference: fine, coarse: lost", "{name: fine, set: analysis.time_step=0.1}"))
                .find("no run has the name lost"),
            std::string::npos);
}

/// Two joints of area 4 m2 that carry 100 N and 300 N upwards at x = 0.
RunForces two_joints() {
  RunForces forces;
  forces.mean_area = 4.0;
  forces.beds[{0, 1, "base"}] = {Vec3::Zero(), Vec3(0, 0, 300), Vec3::Zero()};
  forces.beds[{1, 2, "bed"}] = {Vec3(0, 0, 1), Vec3(0, 0, 100), Vec3::Zero()};
  forces.thrust["thrust_arch"] = {{0, 0.5}, {1, 0.25}};
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
}

// A force of 100 N that acts 0.6 m away is a moment of 60 N m: 60 / sqrt(4 m2) = 30 N. Root mean square of
// the reference: sqrt(300^2 + 100^2) over the two joints.
TEST(ForceErrors, ConvertMomentsToForcesByTheSideOfTheJoint) {
  const RunForces reference = two_joints();
  RunForces run = reference;
  run.beds[{1, 2, "bed"}].point.x() += 0.6;
  run.thrust["thrust_arch"][1] = 0.35;
  const ForceErrors errors = compare_forces(reference, run);
  const double size = std::sqrt(300.0 * 300 + 100 * 100);
  EXPECT_NEAR(errors.wrench_rms, 30.0 / size, 1e-12);
  EXPECT_NEAR(errors.wrench_worst, 30.0 / (size / std::sqrt(2.0)), 1e-12);
  EXPECT_NEAR(errors.thrust_line, 0.1, 1e-12);
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
    for (auto& [id, wrench] : run.beds) wrench = moved_to(wrench, {h, 0, 0});
    return run;
  };
  const RunForces reference = extrapolated(with_step(1.0), with_step(2.0));
  const ForceErrors none = compare_forces(exact, reference);
  EXPECT_NEAR(none.wrench_rms, 0.0, 1e-14);
  EXPECT_NEAR(none.thrust_line, 0.0, 1e-14);
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

TradeoffRow row(const std::string& name, double seconds, double error, Status status = Status::stable) {
  TradeoffRow r{{"method", name, "exact", "", {}, ""}, Summary{}, {}, {}};
  r.summary->cpu_time_seconds = seconds;
  r.summary->status = status;
  r.errors.wrench_rms = r.errors.wrench_worst = error;
  return r;
}

std::vector<TradeoffRow> small_study() {
  TradeoffRow missing{{"method", "lost", "exact", "", {}, ""}, std::nullopt, {}, {}};
  return {row("exact", 9, 0),
          row("b_2", 2, 1e-3),
          row("c_3", 3, 1e-2),
          row("a_1", 1, 0.3),
          row("d_4", 4, 1e-7),
          row("e_5", 0.5, 1e-9, Status::unconverged),
          missing};
}

TEST(Study, FrontHoldsRunsThatNoFasterRunBeats) {
  const std::vector<TradeoffRow> front = pareto_front(rows_of(small_study(), "method"));
  ASSERT_EQ(front.size(), 3u);
  EXPECT_EQ(front[0].point.name, "a_1");
  EXPECT_EQ(front[1].point.name, "b_2");
  EXPECT_EQ(front[2].point.name, "d_4");
}

TEST(Study, RanksLimitAnalysesByTheirCriticalValue) {
  TradeoffRow fast = row("fast", 1, 0.9), fine = row("fine", 2, 0.9);
  fast.critical_error = 1e-2;
  fine.critical_error = 1e-4;
  EXPECT_EQ(pareto_front({fast, fine}).size(), 2u);
  EXPECT_EQ(tradeoff_text({fast, fine}).back().find("single joint"), std::string::npos);
}

TEST(Study, TextNamesTheFastestTheExchangeTheUnreachedAndTheMissing) {
  std::string text;
  for (const std::string& paragraph : tradeoff_text(small_study())) text += paragraph + "\n";
  for (const char* phrase :
       {"Not run: lost.",
        "Fastest run within 0.1 and 0.01 and 0.001: b_2 (2 s, 1.0e-03); within 1e-06: d_4 (4 s, 1.0e-07).",
        "From a_1 to d_4 the time grows by a factor of 4 and the error falls by a factor of 3e+06.",
        "Requested accuracy not reached: e_5"})
    EXPECT_NE(text.find(phrase), std::string::npos) << phrase << "\n" << text;
}

TEST(Study, TheTableHasARowPerRunAndEveryKnobAFigure) {
  const Table table = tradeoff_table(small_study());
  EXPECT_EQ(table.rows.size(), 7u);
  for (const auto& cells : table.rows) EXPECT_EQ(cells.size(), table.columns.size());
  EXPECT_EQ(std::get<std::string>(table.rows.back()[4]), "not run");
  const std::vector<Figure> figures = tradeoff_figures(small_study());
  ASSERT_EQ(figures.size(), 2u);
  EXPECT_EQ(figures[0].name, "tradeoff");
  EXPECT_EQ(figures[1].name, "tradeoff_method");
  EXPECT_NE(figures[0].commands.find("set label 'a 1' at"), std::string::npos) << "names are words";
  EXPECT_NE(figures[0].commands.find("title 'Newton (SAP in Drake)'"), std::string::npos);
}

}  // namespace
}  // namespace cupola::tradeoff_test

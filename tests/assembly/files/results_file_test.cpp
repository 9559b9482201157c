#include "assembly/files/results_file.hpp"

#include <cmath>
#include <filesystem>
#include <limits>
#include <map>
#include <set>

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "assembly/files/atomic_file.hpp"
#include "assembly/files/mesh_file.hpp"
#include "assembly/files/old_frames.hpp"
#include "tests/assembly/files/example_summary.hpp"
#include "tests/assembly/scene.hpp"
#include "tests/fresh_folder.hpp"

namespace cupola::results_file_test {
namespace {

using test::example_summary;

Frame two_block_frame(double time) {
  Frame frame;
  frame.time = time;
  for (int i = 0; i < 3; ++i) {
    ContactTable& c = frame.contacts;
    c.joint.push_back(i / 2);
    c.block_a.push_back(0);
    c.block_b.push_back(1 + i / 2);
    c.kind.push_back(i == 2 ? JointKind::head : JointKind::base);
    c.ring.push_back(i);
    c.point.emplace_back(0.1 * i, 1.0 / 3.0, time);
    c.normal.emplace_back(0.6, 0.0, 0.8);
    c.gap.push_back(-1e-9 / 3 * i);
    c.force.emplace_back(1e6 / 3.0, -2e-7, 5e6 + i);
    c.normal_force.push_back(4e6 / 3.0);
    c.friction_use.push_back(0.1 * i);
    c.area.push_back(1.0 / 7.0);
    c.slip.push_back(1e-12 * i);
    c.law_violation.push_back(1e-9 / 3.0 * i);
    if (time == 0.0) continue;  // frames of dry joints have none of what follows
    c.friction_limit.push_back(1e3 / 7.0 * i);
    c.strength_use.push_back(0.3 * i);
    c.damage.push_back(i / 3.0);
    c.crack_opening.push_back(1e-4 / 3.0 * i);
  }
  for (int i = 0; i < 2 && time > 0.0; ++i) {  // ties of a later stage
    TieTable& t = frame.ties;
    t.chain.push_back(i - 1);
    t.block_a.push_back(2 * i);  // the second is a restraint, of a block before the supports
    t.block_b.push_back(2 - i);
    t.point_a.emplace_back(0.1 * i, 1.0 / 3.0, time);
    t.point_b.emplace_back(0.2, 1.0 / 7.0 * i, time);
    t.force.push_back(1e5 / 3.0);
    t.yield_force.push_back(i == 0 ? 1e5 / 7.0 : std::numeric_limits<double>::infinity());
    t.yielded.push_back(1e-3 / 3.0 * i);
    t.strut.push_back(static_cast<std::uint8_t>(i));
  }
  for (int b = 0; b < 3; ++b) {
    frame.blocks.position.emplace_back(b, 1.0 / 3.0, time);
    frame.blocks.quaternion_wxyz.emplace_back(std::cos(0.1), std::sin(0.1), 0.0, 0.0);
    frame.blocks.velocity.emplace_back(0.1, 0.2, 0.3);
    frame.blocks.angular_velocity.emplace_back(-0.1, 1e-15, 3.0);
    frame.blocks.displacement.emplace_back(1e-3 / 3.0, 0.0, -2.0);
    if (time == 0.0) continue;  // found as built
    frame.blocks.contact_position.emplace_back(b, 1.0 / 7.0, time);
    frame.blocks.contact_quaternion_wxyz.emplace_back(std::cos(0.2), 0.0, std::sin(0.2), 0.0);
  }
  return frame;
}

void expect_equal(const Frame& a, const Frame& b) {
  EXPECT_EQ(a.time, b.time);
  EXPECT_EQ(a.contacts.joint, b.contacts.joint);
  EXPECT_EQ(a.contacts.block_a, b.contacts.block_a);
  EXPECT_EQ(a.contacts.block_b, b.contacts.block_b);
  EXPECT_EQ(a.contacts.kind, b.contacts.kind);
  EXPECT_EQ(a.contacts.ring, b.contacts.ring);
  EXPECT_EQ(a.contacts.point, b.contacts.point);
  EXPECT_EQ(a.contacts.normal, b.contacts.normal);
  EXPECT_EQ(a.contacts.gap, b.contacts.gap);
  EXPECT_EQ(a.contacts.force, b.contacts.force);
  EXPECT_EQ(a.contacts.normal_force, b.contacts.normal_force);
  EXPECT_EQ(a.contacts.friction_use, b.contacts.friction_use);
  EXPECT_EQ(a.contacts.area, b.contacts.area);
  EXPECT_EQ(a.contacts.slip, b.contacts.slip);
  EXPECT_EQ(a.contacts.law_violation, b.contacts.law_violation);
  EXPECT_EQ(a.contacts.friction_limit, b.contacts.friction_limit);
  EXPECT_EQ(a.contacts.strength_use, b.contacts.strength_use);
  EXPECT_EQ(a.contacts.damage, b.contacts.damage);
  EXPECT_EQ(a.contacts.crack_opening, b.contacts.crack_opening);
  EXPECT_EQ(a.blocks.position, b.blocks.position);
  EXPECT_EQ(a.blocks.quaternion_wxyz, b.blocks.quaternion_wxyz);
  EXPECT_EQ(a.blocks.velocity, b.blocks.velocity);
  EXPECT_EQ(a.blocks.angular_velocity, b.blocks.angular_velocity);
  EXPECT_EQ(a.blocks.displacement, b.blocks.displacement);
  EXPECT_EQ(a.blocks.contact_position, b.blocks.contact_position);
  EXPECT_EQ(a.blocks.contact_quaternion_wxyz, b.blocks.contact_quaternion_wxyz);
  EXPECT_EQ(a.ties.chain, b.ties.chain);
  EXPECT_EQ(a.ties.block_a, b.ties.block_a);
  EXPECT_EQ(a.ties.block_b, b.ties.block_b);
  EXPECT_EQ(a.ties.point_a, b.ties.point_a);
  EXPECT_EQ(a.ties.point_b, b.ties.point_b);
  EXPECT_EQ(a.ties.force, b.ties.force);
  EXPECT_EQ(a.ties.yield_force, b.ties.yield_force);
  EXPECT_EQ(a.ties.yielded, b.ties.yielded);
  EXPECT_EQ(a.ties.strut, b.ties.strut);
}

std::string open_error(const std::string& folder, const std::string& hash) {
  try {
    ResultsReader reader(folder, hash);
    for (size_t i = 0; i < reader.times().size(); ++i) reader.read_frame(static_cast<int>(i));
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

std::string written_results(const std::string& name) {
  const std::string folder = test::fresh_folder(name);
  ResultsWriter writer(folder, example_summary().assembly_hash);
  writer.write_frame(two_block_frame(0.0));
  writer.write_frame(two_block_frame(1.0 / 3.0));
  writer.write_summary(example_summary());
  return folder;
}

TEST(ResultsFile, FramesRoundTripExactly) {
  const std::string folder = written_results("a");
  const ResultsReader reader(folder, example_summary().assembly_hash);
  ASSERT_EQ(reader.times(), (std::vector{0.0, 1.0 / 3.0}));
  expect_equal(reader.read_frame(0), two_block_frame(0.0));
  expect_equal(reader.read_frame(1), two_block_frame(1.0 / 3.0));
}

TEST(ResultsFile, FramesSayWhatTheyAre) {
  const std::string folder = test::fresh_folder("roles");
  ResultsWriter writer(folder, example_summary().assembly_hash);
  constexpr auto kNames = enum_names(FrameRole{});
  for (size_t i = 0; i < kNames.size(); ++i) {
    Frame frame = two_block_frame(static_cast<double>(i));
    set_role(static_cast<FrameRole>(i), "least thrust", &frame);
    writer.write_frame(frame);
  }
  writer.write_summary(example_summary());
  const ResultsReader reader(folder, example_summary().assembly_hash);
  for (size_t i = 0; i < kNames.size(); ++i) {
    const Frame frame = reader.read_frame(static_cast<int>(i));
    EXPECT_EQ(to_string(frame.role), kNames[i]);
    EXPECT_EQ(frame.owner, "least thrust");
  }
  EXPECT_EQ(reader.read_frame(1).label, "1.000 s");
  EXPECT_EQ(reader.read_frame(static_cast<int>(FrameRole::range_end)).label, "Least thrust");
}

TEST(ResultsFile, AnOpenCourseIsLabelledByItsShare) {
  Frame frame;
  frame.time = 2.4;
  set_role(FrameRole::stage, "stage 7", &frame);
  EXPECT_EQ(frame.label, "course 3, 40 % laid");
  frame.time = -0.75;
  set_role(FrameRole::stage, "stage 0", &frame);
  EXPECT_EQ(frame.label, "course 0, 25 % laid");
}

// Version 0.2 wrote no roles. The frames of an unbounded end and of a static start that failed are in no
// fixture.
TEST(ResultsFile, OldFramesGetTheirRoleFromTheSummary) {
  const auto role = [](const Summary& summary, int index, const Frame& of = {}) {
    Frame frame = of;
    set_role_of_old_frame(summary, index, &frame);
    return fmt::format("{} of {}", to_string(frame.role), frame.owner);
  };
  Summary s;
  s.analysis = AnalysisType::range;
  EXPECT_EQ(role(s, 0), "unconverged of ");
  s.ranges = {
      {"thrust", "N", {RangeOutcome::bounded, 1.0, 1.0, 1}, {RangeOutcome::unbounded, {}, {}, 2}, {}}};
  EXPECT_EQ(role(s, 0), "equilibrium of ");
  EXPECT_EQ(role(s, 1), "range_end of least thrust");
  EXPECT_EQ(role(s, 2), "self_stress of greatest thrust");
  s.analysis = AnalysisType::dynamic;
  s.status = Status::moving;
  EXPECT_EQ(role(s, 0), "mechanism of ") << "the static start";
  s.max_speed_m_per_s = 0.1;
  EXPECT_EQ(role(s, 0), "step of ");
  s.analysis = AnalysisType::staged;
  Frame falls;
  falls.blocks.velocity = {Vec3::Zero(), Vec3(0, 0, -1)};
  EXPECT_EQ(role(s, 3, falls), "failed_stage of stage 3");
}

// Up to version 0.4 frames did not name the poses at which their contacts were found.
TEST(ResultsFile, OldFramesOfMotionsAndPathsStandAtTheEndOfTheirStep) {
  const std::string folder = test::fresh_folder("poses");
  ResultsWriter writer(folder, example_summary().assembly_hash);
  for (const FrameRole role : {FrameRole::path, FrameRole::step, FrameRole::equilibrium}) {
    Frame frame = two_block_frame(0.0);
    set_role(role, "", &frame);
    writer.write_frame(frame);
  }
  writer.write_summary(example_summary());
  const ResultsReader reader(folder, example_summary().assembly_hash);
  for (int i = 0; i < 2; ++i)
    EXPECT_EQ(reader.read_frame(i).blocks.contact_position, two_block_frame(0.0).blocks.position);
  EXPECT_TRUE(reader.read_frame(2).blocks.contact_position.empty());
}

TEST(ResultsFile, TextFilesThatChangedAreRefused) {
  const std::string folder = test::fresh_folder("texts"), hash = example_summary().assembly_hash;
  ResultsWriter writer(folder, hash);
  writer.write_frame(two_block_frame(0.0));
  writer.write_text("history.csv", "t\n0\n");
  writer.write_text("history.csv", "t\n0\n1\n");
  writer.write_text("run.yaml", "title: x\n");
  writer.write_summary(example_summary());
  write_text_atomically(folder + "/stages.csv", "of an earlier run\n");
  const ResultsReader reader(folder, hash);
  EXPECT_EQ(reader.read_text_file("history.csv"), "t\n0\n1\n");
  EXPECT_EQ(reader.read_text_file("run.yaml"), "title: x\n");
  const auto error_of = [&reader](const std::string& name) -> std::string {
    try {
      reader.read_text_file(name);
    } catch (const InputError& error) {
      return error.what();
    }
    return "";
  };
  write_text_atomically(folder + "/history.csv", "t\n0\n");
  EXPECT_NE(error_of("history.csv").find("history.csv: error: is damaged or was edited"), std::string::npos);
  std::filesystem::remove(folder + "/run.yaml");
  EXPECT_NE(error_of("run.yaml").find("run.yaml: error: does not exist"), std::string::npos);
  EXPECT_NE(error_of("stages.csv").find("is not listed in summary.json"), std::string::npos);
}

// A kill between the last step and summary.json: the run that is resumed has no step left that would write
// the table.
TEST(ResultsFile, ARunResumedAtItsEndKeepsItsTables) {
  const std::string folder = test::fresh_folder("results"), hash = example_summary().assembly_hash;
  {
    ResultsWriter killed(folder, hash);
    killed.write_frame(two_block_frame(0.0));
    killed.write_text("path.csv", "time_s\n0\n");
  }
  write_text_atomically(folder + "/.path.1.part.csv", "time_s\n");  // of another run that was killed
  ResultsWriter(folder, hash, {0.0}).write_summary(example_summary());
  EXPECT_THROW(ResultsReader(folder, hash).read_text_file(".path.1.part.csv"), InputError);
  EXPECT_EQ(ResultsReader(folder, hash).read_text_file("path.csv"), "time_s\n0\n");
}

TEST(ResultsFile, JointsOfAFrameAreIndexedByJointNumber) {
  const auto joints = joints_of(two_block_frame(0.0).contacts);
  ASSERT_EQ(joints.size(), 2u);
  EXPECT_EQ(joints[1].block_b, 2);
  EXPECT_EQ(joints[1].kind, JointKind::head);
  EXPECT_TRUE(joints_of(ContactTable()).empty());
}

TEST(ResultsFile, ErrorsNameForeignOrIncompleteFolders) {
  const auto has = [](const std::string& message, const std::string& part) {
    return testing::AssertionResult(message.find(part) != std::string::npos) << "got: " << message;
  };
  const std::string hash = example_summary().assembly_hash;
  EXPECT_TRUE(has(open_error("/nowhere/at/all", hash), "results folder does not exist"));
  EXPECT_TRUE(has(open_error(written_results("a"), "other"), "belongs to another assembly"));

  std::string folder = written_results("b");
  std::filesystem::remove(folder + "/contacts_0001.vtp");
  EXPECT_TRUE(has(open_error(folder, hash), "contacts_0001.vtp: error: does not exist"));

  folder = written_results("without_ties");
  std::filesystem::remove(folder + "/ties_0001.vtp");
  EXPECT_TRUE(has(open_error(folder, hash), "ties_0001.vtp: error: does not exist"));

  folder = written_results("c");
  std::filesystem::resize_file(folder + "/blocks_0001.vtp", 700);
  EXPECT_TRUE(has(open_error(folder, hash), "blocks_0001.vtp: error: is truncated"));

  folder = written_results("d");
  std::filesystem::remove(folder + "/summary.json");
  EXPECT_TRUE(has(open_error(folder, hash), "the run has not finished"));

  // A frame of another run in the folder.
  folder = written_results("e");
  ResultsWriter other(test::fresh_folder("f"), "another hash");
  other.write_frame(two_block_frame(0.0));
  std::filesystem::copy_file(other.folder() + "/blocks_0000.vtp", folder + "/blocks_0000.vtp",
                             std::filesystem::copy_options::overwrite_existing);
  EXPECT_TRUE(has(open_error(folder, hash), "blocks_0000.vtp: error: belongs to another assembly"));
}

TEST(ResultsFile, ErrorsNameInvalidContacts) {
  const auto error_of = [](const std::string& name, const std::function<void(ContactTable*)>& change) {
    const std::string folder = test::fresh_folder(name);
    ResultsWriter writer(folder, example_summary().assembly_hash);
    Frame frame = two_block_frame(0.0);
    change(&frame.contacts);
    writer.write_frame(frame);
    writer.write_summary(example_summary());
    return open_error(folder, example_summary().assembly_hash);
  };
  EXPECT_EQ(error_of("ok", [](ContactTable*) {}), "");
  EXPECT_NE(error_of("block", [](ContactTable* c) { c->block_b[1] = 3; }), "");
  EXPECT_NE(error_of("order", [](ContactTable* c) { c->block_a[1] = 1; }), "");
  EXPECT_NE(error_of("joint", [](ContactTable* c) { c->joint[1] = 1 << 30; }), "");
  EXPECT_NE(error_of("nan", [](ContactTable* c) { c->force[1].x() = std::nan(""); }), "");
}

TEST(ResultsFile, ErrorsNameInvalidTies) {
  const auto error_of = [](const std::string& name, const std::function<void(TieTable*)>& change) {
    const std::string folder = test::fresh_folder(name);
    ResultsWriter writer(folder, example_summary().assembly_hash);
    Frame frame = two_block_frame(1.0);
    change(&frame.ties);
    writer.write_frame(frame);
    writer.write_summary(example_summary());
    return open_error(folder, example_summary().assembly_hash);
  };
  EXPECT_EQ(error_of("no_tie_wrong", [](TieTable*) {}), "");
  const std::string beyond = error_of("tie_block", [](TieTable* t) { t->block_a[1] = 3; });
  EXPECT_NE(beyond.find("ties_0000.vtp: error: tie 1 between blocks 3 and 1 "), std::string::npos) << beyond;
  EXPECT_NE(error_of("tie_below", [](TieTable* t) { t->block_b[0] = -1; }), "");
  EXPECT_NE(error_of("tie_of_one", [](TieTable* t) { t->block_b[1] = 2; }), "");
  EXPECT_NE(error_of("tie_nan", [](TieTable* t) { t->force[0] = std::nan(""); }), "");
}

// Tables and frames of an earlier run would be taken for those of this one, which may write none.
TEST(ResultsFile, ANewRunRemovesTheResultsOfTheLast) {
  const std::string folder = test::fresh_folder("again"), hash = example_summary().assembly_hash;
  const auto names = [&folder] {
    std::set<std::string> found;
    for (const auto& file : std::filesystem::directory_iterator(folder)) found.insert(file.path().filename());
    return found;
  };
  {
    ResultsWriter earlier(folder, hash);
    for (const double time : {0.0, 0.5}) earlier.write_frame(two_block_frame(time));
    earlier.write_text("failures.csv", "stage\n0\n");
    earlier.write_summary(example_summary());
  }
  write_text_atomically(folder + "/notes.csv", "of the user\n");
  ResultsWriter writer(folder, hash);
  EXPECT_EQ(names(), std::set<std::string>{"notes.csv"});
  writer.write_frame(two_block_frame(0.0));
  ResultsWriter(folder, hash, {0.0}).write_summary(example_summary());  // that run was killed
  EXPECT_EQ(ResultsReader(folder, hash).summary().text_files, (std::map<std::string, std::string>{}));
}

TEST(ResultsFile, FramesOfAnotherRunAreRefused) {
  const std::string folder = test::fresh_folder("two_runs"), other = test::fresh_folder("other_run");
  Summary summary = example_summary();
  for (const std::string& run : {other, folder}) {
    ResultsWriter writer(run, summary.assembly_hash, {}, summary.case_hash = run);
    writer.write_frame(two_block_frame(0.0));
    writer.write_frame(two_block_frame(0.5));
    writer.write_summary(summary);
  }
  std::filesystem::copy_file(other + "/contacts_0001.vtp", folder + "/contacts_0001.vtp",
                             std::filesystem::copy_options::overwrite_existing);
  const ResultsReader reader(folder, summary.assembly_hash);
  EXPECT_NO_THROW(reader.read_frame(0));
  try {
    reader.read_frame(1);
    FAIL() << "the second frame is of the first run";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("contacts_0001.vtp: error: belongs to another run"),
              std::string::npos)
        << error.what();
  }
}

TEST(ResultsFile, RemovedFramesStopARun) {
  const std::string folder = test::fresh_folder("removed");
  ResultsWriter writer(folder, "hash", {}, "run");
  writer.write_frame(two_block_frame(0.0));
  std::filesystem::remove(folder + "/blocks_0000.vtp");
  EXPECT_THROW(writer.write_frame(two_block_frame(0.5)), SystemError);
  EXPECT_THROW(ResultsWriter(folder, "hash", {0.0}, "run"), InputError) << "and it cannot be resumed";
}

// Collections and growing tables are written again when they have grown by a hundredth: the cost of a run is
// proportional to its frames. A killed run lacks at most the last hundredth, an interrupted one nothing.
TEST(ResultsFile, WhatGrowsIsWrittenInProportion) {
  const std::string folder = test::fresh_folder("growing"), hash = example_summary().assembly_hash;
  ResultsWriter(folder, hash).write_frame(two_block_frame(1.0));
  std::vector<double> times{1.0};
  std::string rows = "row\n";
  while (times.size() < 200) {
    for (const char* what : {"contacts", "blocks", "ties"})
      std::filesystem::copy_file(fmt::format("{}/{}_0000.vtp", folder, what),
                                 fmt::format("{}/{}_{:04}.vtp", folder, what, times.size()));
    times.push_back(static_cast<double>(times.size()) + 1.0);
    rows += "row\n";
  }
  const auto add_frame = [&](ResultsWriter* writer) {
    times.push_back(static_cast<double>(times.size()) + 1.0);
    writer->write_frame(two_block_frame(times.back()));
    writer->write_growing("path.csv", rows += "row\n");
  };
  const auto expect_listed = [&folder](size_t frames) {
    for (const char* what : {"contacts", "blocks", "ties"})
      EXPECT_EQ(read_pvd(fmt::format("{}/{}.pvd", folder, what)).size(), frames) << what;
    EXPECT_EQ(read_text(folder + "/path.csv").size(), 4 * frames);
  };
  {
    ResultsWriter writer(folder, hash, times);
    for (const size_t listed : {201, 201, 201, 204, 204}) {
      add_frame(&writer);
      expect_listed(listed);
    }
    writer.write_interruption({});
    expect_listed(205);
    add_frame(&writer);
    writer.finish_tables();  // before a checkpoint
    EXPECT_EQ(read_pvd(folder + "/contacts.pvd").size(), 205u);
  }
  ResultsWriter(folder, hash, times).write_summary(example_summary());  // that run was killed
  expect_listed(206);
}

TEST(ResultsFile, ARunWithoutFramesSaysWhy) {
  const std::string folder = test::fresh_folder("no_frames");
  const Summary summary = example_summary();
  ResultsWriter(folder, summary.assembly_hash).write_summary(summary);
  try {
    const ResultsReader reader(folder, summary.assembly_hash);
    FAIL() << "there are no frames";
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("found no state that could be evaluated: largest speed"),
              std::string::npos);
  }
}

}  // namespace
}  // namespace cupola::results_file_test

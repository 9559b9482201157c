#include <bit>
#include <cstdint>
#include <cstdlib>

#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "assembly/files/atomic_file.hpp"
#include "solver/analysis/analysis.hpp"
#include "solver/runtime/checkpoint.hpp"
#include "solver/runtime/interruption.hpp"
#include "tests/solver/motion_scenes.hpp"

namespace cupola::resume_test {
namespace {

/// Records everything that an analysis writes.
struct Recorder {
  std::string history;
  std::vector<Frame> frames;
  std::string checkpoint;
  size_t rows_at_checkpoint = 0, frames_at_checkpoint = 0;

  AnalysisSinks sinks() {
    AnalysisSinks sinks;
    sinks.history = [this](const std::string& row) { history += row + "\n"; };
    sinks.frame = [this](const Frame& frame) { frames.push_back(frame); };
    sinks.checkpoint = [this](const std::string& bytes) {
      checkpoint = bytes;
      rows_at_checkpoint = history.size();
      frames_at_checkpoint = frames.size();
    };
    return sinks;
  }
};

/// A wall whose floor is pulled away: blocks slide, rock and fall, contacts open and close.
Case collapsing_case() {
  Case scene = testing::make_case(0.4, 1e-8, 0.005);
  scene.analysis.tolerance = 1e-9;
  scene.analysis.duration = 0.6;
  scene.output.frames_every = 0.05;
  SupportMove move;
  move.displacement = Vec3(0.8, 0.1, 0);
  move.time = RampInTime{.from = 0.0, .to = 1.0, .start = 0.05, .duration = 0.3};
  scene.supports.moves = {move};
  return scene;
}

void expect_same_bits(const Recorder& expected, const Recorder& got) {
  EXPECT_EQ(expected.history, got.history);
  ASSERT_EQ(expected.frames.size(), got.frames.size());
  for (size_t i = 0; i < expected.frames.size(); ++i) {
    const Frame &p = expected.frames[i], &q = got.frames[i];
    ASSERT_EQ(p.contacts.size(), q.contacts.size()) << "frame " << i;
    for (int k = 0; k < p.contacts.size(); ++k) {
      ASSERT_EQ(p.contacts.force[k], q.contacts.force[k]) << "frame " << i;
      ASSERT_EQ(std::bit_cast<std::uint64_t>(p.contacts.slip[k]),
                std::bit_cast<std::uint64_t>(q.contacts.slip[k]))
          << "NaN where parted, frame " << i;
    }
    for (int k = 0; k < p.blocks.size(); ++k)
      ASSERT_EQ(p.blocks.position[k], q.blocks.position[k]) << "frame " << i;
  }
}

/// Interrupts at the `query`-th call of AnalysisSinks::interrupted (made at frames and every ten steps),
/// resumes from the checkpoint in a new analysis, and compares.
void interrupt_and_resume(const Case& scene, const Assembly& assembly, int query, const Recorder& whole) {
  Recorder first;
  AnalysisSinks sinks = first.sinks();
  int seen = 0;
  sinks.interrupted = [&] { return ++seen >= query; };
  ASSERT_FALSE(run_dynamic(scene, assembly, sinks));
  ASSERT_FALSE(first.checkpoint.empty());

  Recorder second = first;
  second.history.resize(first.rows_at_checkpoint);
  second.frames.resize(first.frames_at_checkpoint);
  sinks = second.sinks();
  sinks.resume_from = first.checkpoint;
  const std::optional<Summary> summary = run_dynamic(scene, assembly, sinks);
  ASSERT_TRUE(summary);
  expect_same_bits(whole, second);
}

TEST(Resume, GivesTheSameBits) {
  const Assembly wall = testing::running_bond_wall({0.6, 0.3, 0.3}, 3, 4);
  const Case scene = collapsing_case();
  Recorder whole;
  ASSERT_TRUE(run_dynamic(scene, wall, whole.sinks()));
  ASSERT_GT(whole.frames.back().blocks.displacement[5].norm(), 0.1) << "the wall must move";
  for (const int query : {1, 4, 11}) interrupt_and_resume(scene, wall, query, whole);
}

TEST(Resume, GivesTheSameBitsWithAdaptiveStepsAndAStaticStart) {
  const Assembly wall = testing::running_bond_wall({0.6, 0.3, 0.3}, 3, 4);
  Case scene = collapsing_case();
  scene.analysis.adaptive = AdaptiveStep{.smallest = 1e-4, .largest = 0.02, .displacement_error = 1e-4};
  scene.analysis.start = Analysis::Start::static_;
  Recorder whole;
  ASSERT_TRUE(run_dynamic(scene, wall, whole.sinks()));
  for (const int query : {1, 3}) interrupt_and_resume(scene, wall, query, whole);
}

// A stop that cannot wait for the next frame or tenth step leaves a solve, as that of the fifteenth step here.
TEST(Resume, ContinuesAMotionThatIsAbandonedBetweenFrames) {
  const Assembly wall = testing::running_bond_wall({0.6, 0.3, 0.3}, 3, 4);
  Case scene = collapsing_case();
  scene.output.frames_every = 0.3;
  scene.analysis.duration = 0.15;
  Recorder whole, first;
  ASSERT_TRUE(run_dynamic(scene, wall, whole.sinks()));
  AnalysisSinks sinks = first.sinks();
  sinks.log = [step = 0](const std::string&) mutable {
    if (++step == 15) throw Interrupted();
  };
  EXPECT_THROW(run_dynamic(scene, wall, sinks), Interrupted);
  ASSERT_FALSE(first.checkpoint.empty());

  Recorder second = first;
  second.history.resize(first.rows_at_checkpoint);
  sinks = second.sinks();
  sinks.resume_from = first.checkpoint;
  ASSERT_TRUE(run_dynamic(scene, wall, sinks));
  expect_same_bits(whole, second);
}

TEST(Checkpoint, IsReadBackAndRefusedIfDamaged) {
  const std::string path = ::testing::TempDir() + "/checkpoint";
  const Checkpoint written{"0.1", "case", "assembly", {0.1, 0.2}, "a,b\n1,2\n", std::string("\0\1\2", 3)};
  write_checkpoint(path, written);
  const std::optional<Checkpoint> read = read_checkpoint(path);
  ASSERT_TRUE(read);
  EXPECT_EQ(read->frame_times, written.frame_times);
  EXPECT_EQ(read->history, written.history);
  EXPECT_EQ(read->analysis, written.analysis);
  EXPECT_FALSE(read_checkpoint(path + ".absent"));

  const std::string good = read_text(path);
  for (size_t i = 0; i < good.size(); i += 7) {
    std::string bad = good;
    bad[i] = static_cast<char>(bad[i] ^ 1);
    write_text_atomically(path, bad);
    EXPECT_THROW(read_checkpoint(path), InputError) << "byte " << i;
    write_text_atomically(path, good.substr(0, i));
    EXPECT_THROW(read_checkpoint(path), InputError) << "cut at " << i;
  }
}

// A failed write leaves the previous checkpoint intact.
TEST(Checkpoint, SurvivesAFailedWrite) {
  const std::string folder = ::testing::TempDir() + "/readonly_checkpoint";
  make_folder(folder);
  const std::string path = folder + "/checkpoint";
  write_checkpoint(path, {"0.1", "a", "b", {}, "", "good"});
  // A file cannot lie below a file, so that the write fails, even for root. A folder in its place is refused.
  EXPECT_THROW(write_checkpoint(path + "/below", {"0.1", "a", "b", {}, "", "bad"}), SystemError);
  EXPECT_THROW(write_checkpoint(folder, {"0.1", "a", "b", {}, "", "bad"}), InputError);
  EXPECT_EQ(read_checkpoint(path)->analysis, "good");
}

}  // namespace
}  // namespace cupola::resume_test

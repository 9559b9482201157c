// Outputs that cannot be written, folders that are in use or removed, and what killed runs leave behind.

#include "tests/pipeline/program_run.hpp"

namespace cupola::disk_faults_test {
namespace {

/// A folder with the small wall of the fault campaigns and its assembly.
struct WallFolder : ProgramFolder {
  WallFolder() {
    std::filesystem::copy(CUPOLA_SOURCE_DIR "/tests/faults/small.yaml", file("wall.yaml"));
    EXPECT_EQ(run("cupola-generate wall.yaml --output a.vtu").code, 0);
  }
  const std::string solve = "cupola-solve wall.yaml --assembly a.vtu --quiet --output ";
};

TEST(DiskFaults, OutputFollowsLinksAndRefusesDevices) {
  const WallFolder folder;
  std::filesystem::create_symlink("real.vtu", folder.file("link.vtu"));
  ASSERT_EQ(folder.run("cupola-generate wall.yaml --output link.vtu").code, 0);
  EXPECT_TRUE(std::filesystem::is_symlink(folder.file("link.vtu")));
  EXPECT_EQ(slurp(folder.file("real.vtu")), slurp(folder.file("a.vtu")));
  for (const std::string option : {"--output /dev/null", "--output a.vtu --report /dev/null",
                                   "--output a.vtu --export .", "--output a.vtu --bond-map /dev/null"}) {
    const ProgramRun run = folder.run("cupola-generate wall.yaml " + option);
    EXPECT_NE(run.code, 0) << option;
    EXPECT_EQ(run.err.find("error: /"), std::string::npos);
  }
  EXPECT_TRUE(std::filesystem::is_character_file("/dev/null"));
  EXPECT_EQ(folder.run(folder.solve + "results --dump-fclib /dev/null").code, 2);
}

TEST(DiskFaults, FullStandardOutputIsAnError) {
  const WallFolder folder;
  for (const std::string program :
       {"cupola-generate --schema", "cupola-generate wall.yaml --output b.vtu", "cupola-post columns",
        "cupola-solve wall.yaml --assembly a.vtu --explain"}) {
    const ProgramRun run = folder.run("sh -c '" + program + " > /dev/full'");
    EXPECT_EQ(run.code, 1) << program;
    EXPECT_NE(run.err.find("No space left on device"), std::string::npos) << run.err;
  }
}

TEST(DiskFaults, FilesAboveTheLimitGiveTheReason) {
  const WallFolder folder;
  // 4 blocks of 512 or 1024 bytes, depending on the shell; the assembly has more than 10 kB.
  for (const std::string& program :
       {std::string("cupola-generate wall.yaml --output b.vtu"), folder.solve + "results"}) {
    const ProgramRun run = folder.run("sh -c 'ulimit -f 4; " + program + "'");
    EXPECT_EQ(run.code, 1) << program;
    EXPECT_NE(run.err.find("File too large"), std::string::npos) << run.err;
  }
}

TEST(DiskFaults, TwoRunsDoNotShareAFolder) {
  const WallFolder folder;
  // The first run solves until it is stopped.
  const ProgramRun run =
      folder.run("sh -c '" + folder.solve +
                 "results --set analysis.duration=100 & first=$!; "
                 "until [ -e results/checkpoint ]; do sleep 0.02; done; " +
                 folder.solve + "results; code=$?; kill -9 $first; echo process $first >&2; exit $code'");
  EXPECT_EQ(run.code, 1);
  const size_t at = run.err.find("results: process ");
  ASSERT_NE(at, std::string::npos) << run.err;
  const std::string owner = run.err.substr(at + 9, run.err.find(" on ", at) - at - 9);
  EXPECT_NE(run.err.find(owner + "\n"), std::string::npos) << run.err;
  EXPECT_EQ(folder.run(folder.solve + "results").code, 0) << "a killed owner holds no lock";
}

TEST(DiskFaults, OutputRemovedDuringAMotionStopsIt) {
  const WallFolder folder;
  for (const std::string removal : {"rm -r results", "mv results other", "rm results/*_0001.vtp"}) {
    const ProgramRun run = folder.run("sh -c '" + folder.solve +
                                      "results --set analysis.duration=100 & first=$!; "
                                      "until [ -e results/blocks_0002.vtp ]; do sleep 0.02; done; until " +
                                      removal + " 2> /dev/null; do :; done; wait $first'");
    EXPECT_EQ(run.code, 1) << removal;
    EXPECT_NE(run.err.find("results"), std::string::npos) << run.err;
    std::filesystem::remove_all(folder.file("results"));
  }
}

TEST(DiskFaults, OnlyInterruptedRunsLeaveACheckpoint) {
  const WallFolder folder;
  const std::string checkpoint = folder.file("results/checkpoint");
  ASSERT_EQ(folder.run(folder.solve + "results").code, 0);
  EXPECT_FALSE(std::filesystem::exists(checkpoint));
  folder.run("sh -c '" + folder.solve + "results --set analysis.duration=100 & first=$!; " +
             "until [ -e results/checkpoint ]; do sleep 0.02; done; kill -9 $first; wait $first'");
  EXPECT_TRUE(std::filesystem::exists(checkpoint));
  // It is not offered to another analysis in the same folder.
  ASSERT_EQ(folder.run(folder.solve + "results --set analysis.type=static").code, 0);
  EXPECT_FALSE(std::filesystem::exists(checkpoint));
}

TEST(DiskFaults, FilesOfKilledRunsAreRemoved) {
  const WallFolder folder;
  const std::string part = ".contacts_0099.$!.part.vtp";  // $!: a process that has ended
  const ProgramRun run = folder.run(
      "sh -c 'true & wait; mkdir -p post/figures results; for f in . results post; do touch $f/" + part +
      "; done; cupola-generate wall.yaml --output a.vtu && " + folder.solve +
      "results && cupola-post analyse wall.yaml --assembly a.vtu --results results --output post --tables'");
  ASSERT_EQ(run.code, 0) << run.err;
  for (const auto& entry : std::filesystem::recursive_directory_iterator(folder.file("")))
    EXPECT_EQ(entry.path().string().find(".part"), std::string::npos) << entry.path();
}

}  // namespace
}  // namespace cupola::disk_faults_test

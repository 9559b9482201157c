#include "assembly/files/atomic_file.hpp"

#include <filesystem>
#include <fstream>

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include "assembly/base/error.hpp"
#include "assembly/files/csv_columns.hpp"
#include "assembly/files/csv_text.hpp"
#include "assembly/files/folder_lock.hpp"
#include "tests/fresh_folder.hpp"

namespace cupola::atomic_file_test {
namespace {

namespace fs = std::filesystem;

TEST(AtomicFile, FollowsLinks) {
  const fs::path folder = test::fresh_folder("atomic_links");
  fs::create_directory(folder / "inner");
  fs::create_symlink("inner/target.csv", folder / "first.csv");  // relative to its own folder, not to ours
  fs::create_symlink("first.csv", folder / "second.csv");
  for (const char* text : {"one", "two"}) {  // the target is absent, then present
    write_text_atomically((folder / "second.csv").string(), text);
    EXPECT_TRUE(fs::is_symlink(folder / "second.csv"));
    EXPECT_TRUE(fs::is_symlink(folder / "first.csv"));
    EXPECT_EQ(read_text((folder / "inner/target.csv").string()), text);
  }
}

TEST(AtomicFile, RefusesWhatIsNoRegularFile) {
  const fs::path folder = test::fresh_folder("atomic_devices");
  ASSERT_EQ(::mkfifo((folder / "pipe").c_str(), 0600), 0);
  fs::create_symlink("/dev/null", folder / "link");
  for (const std::string& path :
       {std::string("/dev/null"), (folder / "pipe").string(), (folder / "link").string(), folder.string()})
    EXPECT_THROW(write_text_atomically(path, "text"), InputError) << path;
  EXPECT_TRUE(fs::is_character_file("/dev/null"));
  EXPECT_TRUE(fs::is_fifo(folder / "pipe"));
}

TEST(AtomicFile, ReadsTextWithoutAByteOrderMark) {
  const std::string folder = test::fresh_folder("atomic_mark"), mark = "\xEF\xBB\xBF";
  for (const std::string text : {"", "o ground\n", "\xEF\xBB"}) {
    write_text_atomically(folder + "/text", mark + text);
    EXPECT_EQ(read_text(folder + "/text"), text);
    EXPECT_EQ(read_bytes(folder + "/text"), mark + text);
    write_text_atomically(folder + "/text", text);
    EXPECT_EQ(read_text(folder + "/text"), text);
  }
}

/// The number of a process that has ended.
int ended_process() {
  const pid_t child = ::fork();
  if (child == 0) ::_exit(0);
  ::waitpid(child, nullptr, 0);
  return child;
}

TEST(FolderLock, RemovesTemporaryFilesOfKilledRunsOnly) {
  const fs::path folder = test::fresh_folder("lock_parts");
  const std::string ended = "." + std::to_string(ended_process()), alive = "." + std::to_string(::getpid());
  const auto part = [&](const std::string& process) {
    return folder / (".contacts_0001" + process + ".part.vtp");
  };
  for (const fs::path& file :
       {part(ended), part(alive), folder / ".notes.12.particular", folder / "x.12.part"})
    std::ofstream(file) << "text";
  const FolderLock lock(folder.string());
  EXPECT_FALSE(fs::exists(part(ended)));
  EXPECT_TRUE(fs::exists(part(alive)));
  EXPECT_TRUE(fs::exists(folder / ".notes.12.particular"));
  EXPECT_TRUE(fs::exists(folder / "x.12.part"));
}

// A make that was killed waits for none of its programs.
TEST(FolderLock, RemovesTemporaryFilesOfProcessesThatNobodyWaitsFor) {
  const fs::path folder = test::fresh_folder("lock_zombie");
  const pid_t child = ::fork();
  if (child == 0) ::_exit(0);
  siginfo_t info{};
  ASSERT_EQ(::waitid(P_PID, static_cast<id_t>(child), &info, WEXITED | WNOWAIT), 0);
  const fs::path part = folder / (".blocks_0000." + std::to_string(child) + ".part.vtp");
  std::ofstream(part) << "text";
  const FolderLock lock(folder.string());
  EXPECT_FALSE(fs::exists(part));
  ::waitpid(child, nullptr, 0);
}

TEST(FolderLock, RefusesASecondOwnerAndNamesTheFirst) {
  const fs::path folder = test::fresh_folder("lock_two");
  {
    const FolderLock first(folder.string());
    try {
      const FolderLock second(folder.string());
      FAIL() << "two owners";
    } catch (const SystemError& error) {
      EXPECT_NE(std::string(error.what()).find("process " + std::to_string(::getpid())), std::string::npos)
          << error.what();
    }
  }
  EXPECT_NO_THROW(FolderLock(folder.string()));
}

TEST(FolderLock, NoticesThatTheFolderWasReplaced) {
  const fs::path folder = test::fresh_folder("lock_removed");
  const FolderLock lock(folder.string());
  EXPECT_NO_THROW(lock.check());
  fs::remove_all(folder);
  EXPECT_THROW(lock.check(), SystemError);
  const FolderLock next(folder.string());
  EXPECT_THROW(lock.check(), SystemError);
  EXPECT_NO_THROW(next.check());
}

TEST(CsvText, QuotesFormulasAsText) {
  for (const char* formula : {"=1+1", "+x", "-x", "@sum", "=cmd|' /C calc'!A0", "-1+1", "+"}) {
    const std::string cell = csv_text(formula);
    EXPECT_EQ(cell.substr(0, 2), "\"'") << formula;
    EXPECT_EQ(text_of_csv(cell.substr(1, cell.size() - 2)), formula);
  }
  for (const char* plain : {"-1.5", "+2e-3", "-inf", "x=1", "", "'quoted'"}) {
    EXPECT_EQ(csv_text(plain), plain);
    EXPECT_EQ(text_of_csv(plain), plain);
  }
  EXPECT_EQ(csv_text("a \"b\", c"), "\"a \"\"b\"\", c\"");
}

struct NamedBlock {
  std::string name;
  double force;
};

TEST(CsvColumns, KeepNamesWithCommasInOneCell) {
  constexpr CsvColumn<NamedBlock> columns[] = {
      {"block", [](const NamedBlock& b) { return b.name; }},
      {"force_N", [](const NamedBlock& b) { return fmt::format("{:g}", b.force); }},
  };
  EXPECT_EQ(csv_header(columns), "block,force_N");
  EXPECT_EQ(csv_row(columns, NamedBlock{"=top, 1", -2.5}), "\"'=top, 1\",-2.5");
  EXPECT_EQ(csv_row(columns, NamedBlock{"plain", 2.0}), "plain,2");
}

}  // namespace
}  // namespace cupola::atomic_file_test

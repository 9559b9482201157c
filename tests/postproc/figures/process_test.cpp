#include "postproc/figures/process.hpp"

#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "assembly/files/atomic_file.hpp"
#include "tests/fresh_folder.hpp"

namespace cupola::process_test {
namespace {

std::string error_of(const std::vector<std::string>& words, const std::string& log) {
  try {
    run_process(words, log);
  } catch (const SystemError& error) {
    return error.what();
  }
  return "";
}

TEST(Process, ReportsHowAProgramEnded) {
  const std::string log = test::fresh_folder("process") + "/log";
  EXPECT_EQ(run_process({"sh", "-c", "echo said; echo also >&2; exit 3"}, log), 3);
  EXPECT_EQ(read_text(log), "said\nalso\n");
  EXPECT_EQ(run_process({"no-program-of-this-name"}, log), kNotFound);
  EXPECT_EQ(error_of({"sh", "-c", "kill -9 $$"}, log),
            "sh: ended by signal 9, as happens when memory runs out");
  EXPECT_EQ(error_of({"sh", "-c", "echo no library; exit 127"}, log),
            "sh: cannot be loaded, memory or a library is missing: no library");
}

TEST(Process, LastLineSkipsBlankLines) {
  EXPECT_EQ(last_line("\n  line 0: all points undefined\n\n \n"), "  line 0: all points undefined");
  EXPECT_EQ(last_line("one"), "one");
  EXPECT_EQ(last_line("\n \n"), "");
}

}  // namespace
}  // namespace cupola::process_test

// Cases that come with Cupola, in any folder; the files that a case reads.
#include "assembly/case/bundled.hpp"

#include <algorithm>

#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "assembly/case/case_reader.hpp"
#include "tests/assembly/case/case_scratch.hpp"

namespace cupola::bundled_test {
namespace {

// The tests lie in the build tree, beside which the repository's cases are found.
TEST(BundledCase, IsExtendedInAnyFolder) {
  const ScratchFolder scratch;
  const Case mine =
      read_case(scratch.write("my_dome.yaml", "extends: cupola:dome_circular\njoints: {friction: 0.2}\n"));
  const Case original = read_case(bundled_folder() + "/dome_circular.yaml");
  EXPECT_EQ(mine.geometry_hash, original.geometry_hash);
  EXPECT_NE(mine.hash, original.hash);
  EXPECT_EQ(mine.joints.friction, 0.2);
  EXPECT_EQ(mine.inputs, (std::vector<std::string>{scratch.file("my_dome.yaml"),
                                                   bundled_folder() + "/dome_circular.yaml"}));
}

// Files that a bundled case names lie beside it, those of the user's case beside that.
TEST(BundledCase, FindsItsOwnFiles) {
  const ScratchFolder scratch;
  const Case mine = read_case(scratch.write("my_portal.yaml", "extends: cupola:portal\n"));
  EXPECT_EQ(mine.geometry.imported->path, bundled_folder() + "/portal.obj");
  EXPECT_TRUE(std::ranges::count(mine.inputs, bundled_folder() + "/portal.obj") == 1);
  const Case again = read_case(scratch.write("run.yaml", mine.effective_yaml));
  EXPECT_EQ(again.geometry.imported->path, mine.geometry.imported->path);
  EXPECT_EQ(again.effective_yaml, mine.effective_yaml);
  scratch.write("portal.obj", "o a\n");
  const Case own = read_case(
      scratch.write("own.yaml", "extends: cupola:portal\ngeometry: {import: {file: portal.obj}}\n"));
  EXPECT_EQ(own.geometry.imported->path, scratch.file("portal.obj"));
}

TEST(BundledCase, NamesLeadToNoOtherFile) {
  const ScratchFolder scratch;
  scratch.write("secret.yaml", "title: x\n");
  for (const char* name :
       {"cupola:", "cupola:.", "cupola:..", "cupola:../tests/faults/small", "cupola:/etc/passwd",
        "cupola:dome_circular.yaml", "cupola:a b", "Cupola:dome_circular"})
    EXPECT_THROW(read_case(scratch.write("bad.yaml", std::string("extends: \"") + name + "\"\n")), InputError)
        << name;
}

TEST(Case, BundledCasesThatAreNamedAsFilesAreSuggested) {
  const ScratchFolder scratch;
  const auto message = [&scratch](const std::string& extends) -> std::string {
    try {
      read_case(scratch.write("mine/bad.yaml", "extends: " + extends + "\n"));
    } catch (const InputError& error) {
      return error.what();
    }
    return "no error";
  };
  EXPECT_NE(message("../cases/dome_circular.yaml").find("copy it there, or write cupola:dome_circular"),
            std::string::npos);
  EXPECT_NE(message("dome_circular.yaml").find("no such file; did you mean cupola:dome_circular?"),
            std::string::npos);
  EXPECT_EQ(message("../cases/my_dome.yaml").find("cupola:"), std::string::npos);
  EXPECT_EQ(message("my_dome.yaml").find("cupola:"), std::string::npos);
}

// Nobody edits a case that comes with Cupola.
TEST(BundledCases, AKeyThatMustGoIsRemovedWhereItIsInherited) {
  const ScratchFolder scratch;
  try {
    read_case(scratch.write("mine.yaml",
                            "extends: cupola:arch\ngeometry: {wythes: [{name: a, thickness: 0.3}]}\n"));
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_TRUE(
        std::string(error.what()).ends_with("; it is inherited: write geometry.surface.thickness: null"))
        << error.what();
  }
}

}  // namespace
}  // namespace cupola::bundled_test

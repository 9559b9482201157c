#include <gtest/gtest.h>

#include "assembly/export/export.hpp"
#include "assembly/export/formats.hpp"
#include "tests/assembly/scene.hpp"

namespace cupola::obj_test {
namespace {

// A line end in a name would begin a statement of the file, # at the start of a word a comment, and a final
// backslash would swallow the next line. NAME#1 is a piece of a block.
TEST(Obj, EscapesNames) {
  Assembly a = test::two_block_assembly();
  a.blocks[0].name = "one\nv 1 2 3";
  a.blocks[1].name = " a #2, 50% \\";
  const std::string text = obj_text({a, {}, {}});
  EXPECT_NE(text.find("\no one%0Av 1 2 3\n"), std::string::npos) << text;
  EXPECT_NE(text.find("\no %20a %232, 50% %5C\n"), std::string::npos) << text;
  a.blocks[0].name = "voussoir 1#2 (é)";
  EXPECT_NE(obj_text({a, {}, {}}).find("\no voussoir 1#2 (é)\n"), std::string::npos);
}

}  // namespace
}  // namespace cupola::obj_test

#include <cmath>

#include <gtest/gtest.h>

#include "assembly/case/section.hpp"
#include "assembly/case/yaml_text.hpp"
#include "tests/assembly/case/case_scratch.hpp"

namespace cupola::case_section_test {
namespace {

std::string message_of(const std::function<void()>& body) {
  try {
    body();
  } catch (const InputError& error) {
    return error.what();
  }
  return "no error";
}

TEST(SectionFile, OpensOnlyFilesInOrBelowTheFolderOfTheCase) {
  const ScratchFolder scratch;
  const std::string case_file = scratch.write("case.yaml", "");
  scratch.write("meshes/block.obj", "");
  const auto read = [&](const std::string& text) {
    const CaseNode tree = parse_yaml(text, "case.yaml");
    Section s(&tree, "geometry", tree.where, case_file);
    std::string path;
    s.file("mesh", path, "");
    return path;
  };
  EXPECT_EQ(read("mesh: meshes/block.obj"), scratch.file("meshes/block.obj"));
  EXPECT_EQ(read("mesh: meshes/../meshes/block.obj"), scratch.file("meshes/../meshes/block.obj"));
  EXPECT_EQ(message_of([&] { read("mesh: meshes/none.obj"); }),
            "case.yaml:1:7: error: geometry.mesh = meshes/none.obj: no such file in the folder of the case");
  EXPECT_EQ(
      message_of([&] { read("mesh: ../../etc/passwd"); }),
      "case.yaml:1:7: error: ../../etc/passwd: the file must lie in or below the folder of the case; copy "
      "it there");
}

TEST(SectionFlag, AcceptsOnlyTrueAndFalse) {
  const auto read = [](const std::string& text) {
    const CaseNode tree = parse_yaml(text, "case.yaml");
    Section s(&tree, "", tree.where, "case.yaml");
    bool value = false;
    s.flag("on", value, "");
    return value;
  };
  EXPECT_TRUE(read("on: true"));
  EXPECT_FALSE(read("on: false"));
  EXPECT_EQ(message_of([&] { read("on: yes"); }), "case.yaml:1:5: error: on = yes: must be true or false");
}

TEST(Scalar, NumbersSurviveARoundTripBitForBit) {
  for (const double value : {0.1, 1.0 / 3.0, 1e-8, -2.5e300, 5e-324, 17658.000000000004}) {
    double again = 0.0;
    EXPECT_EQ(read_number(format_number(value), &again), "");
    EXPECT_EQ(again, value) << format_number(value);
  }
  EXPECT_EQ(format_number(1e-8), "1e-8");
  EXPECT_EQ(format_number(1e300), "1e300");
}

TEST(Scalar, MinusZeroIsZero) {
  double value = 1.0;
  ASSERT_EQ(read_number("-0.0", &value), "");
  EXPECT_FALSE(std::signbit(value));
}

TEST(Scalar, RefusesTextThatIsNotOneDecimalNumber) {
  for (const char* text :
       {"", "+", "-", "+-1", "1 2", "1,5", "1_000", "0x1p3", "1e", "nan(1)", "infinity", "--1"}) {
    double value = 0.0;
    EXPECT_NE(read_number(text, &value), "") << text;
  }
  int whole = 0;
  for (const char* text : {"", "1.0", "2147483648", "1e3", "0x1"})
    EXPECT_NE(read_integer(text, &whole), "") << text;
}

}  // namespace
}  // namespace cupola::case_section_test

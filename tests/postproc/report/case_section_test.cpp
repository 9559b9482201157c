// What a report says of the case.

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "assembly/files/atomic_file.hpp"
#include "tests/postproc/analysed_column.hpp"

namespace cupola::case_section_test {
namespace {

// Files give blocks densities: 1800 and 2400 kg/m3 are 17.66 and 23.54 kN/m3, where the case has 18. A support
// weighs nothing.
TEST(CaseSection, UnitWeightsAreThoseOfTheBlocks) {
  for (const bool alike : {true, false}) {
    Assembly a = test::column(3);
    a.blocks[0].density = 2700.0;
    a.blocks[2].density = alike ? 1800.0 : 2400.0;
    compute_mass_properties(&a);
    const std::string post = test::analysed_column(
        "densities", {test::column_at_rest(a, test::kGravity, 0.0, 0.6, 0.4)}, test::column_summary(a), a);
    EXPECT_NE(
        read_text(post + "/report.html")
            .find(fmt::format("<dt>Unit weight</dt><dd>{} kN/m³</dd>", alike ? "17.66" : "17.66 to 23.54")),
        std::string::npos);
  }
}

// The time of a stage is the number of the last course laid.
TEST(CaseSection, NamesTheStageShown) {
  const Assembly a = test::column(3);
  Frame frame = test::column_at_rest(a, test::kGravity, 0.0, 0.6, 0.4);
  frame.time = 2.0;
  Summary summary = test::column_summary(a);
  summary.analysis = AnalysisType::staged;
  const std::string page = read_text(test::analysed_column("stages", {frame}, summary) + "/report.html");
  EXPECT_NE(page.find("<dt>Stage shown</dt><dd>stage 0, frame 1 of 1</dd>"), std::string::npos);
  EXPECT_EQ(page.find("Time shown"), std::string::npos);
}

}  // namespace
}  // namespace cupola::case_section_test

// The numbers of the tutorials, docs/getting-started.md and docs/import.md, against the runs that they
// describe (slow).

#include <regex>

#include <fmt/format.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "tests/pipeline/program_run.hpp"

namespace cupola::tutorial_test {
namespace {

using Json = nlohmann::json;

/// Runs a case through the three programs and returns the summaries of results/ and post/.
std::pair<Json, Json> summaries(const ProgramFolder& folder, const std::string& case_file,
                                const std::string& set = "") {
  for (const std::string& stage :
       {"cupola-generate " + case_file + " --quiet --output a.vtu" + set,
        "cupola-solve " + case_file + " --quiet --assembly a.vtu --output results" + set,
        "cupola-post analyse " + case_file +
            " --quiet --tables --assembly a.vtu --results results --output post" + set}) {
    const ProgramRun run = folder.run(stage);
    EXPECT_EQ(run.code, 0) << stage << "\n" << run.err;
    if (run.code != 0) return {};
  }
  return {Json::parse(slurp(folder.file("results/summary.json"))),
          Json::parse(slurp(folder.file("post/summary.json")))};
}

std::string shipped(const std::string& name) {
  return CUPOLA_SOURCE_DIR "/cases/" + name + ".yaml";
}

/// The page without the comments that name the cells of its numbers, and without its line breaks.
void expect_in(const std::string& document, const std::string& phrase) {
  static const std::regex comment("<!--[^>]*-->"), blanks("\\s+");
  const std::string page = std::regex_replace(slurp(CUPOLA_SOURCE_DIR "/docs/" + document), comment, "");
  EXPECT_NE(std::regex_replace(page, blanks, " ").find(phrase), std::string::npos)
      << document << " does not say: " << phrase;
}

/// The settings of a line of cases/variants.txt, as options.
std::string settings_of_variant(const std::string& name) {
  std::istringstream lines(slurp(CUPOLA_SOURCE_DIR "/cases/variants.txt"));
  for (std::string line; std::getline(lines, line);) {
    std::istringstream words(line);
    std::string word, options;
    if (!(words >> word) || word != name) continue;
    for (words >> word; words >> word;) options += " --set " + word;
    return options;
  }
  ADD_FAILURE() << "no variant " << name;
  return "";
}

TEST(TutorialSlow, NumbersOfTheDomesAreThoseOfTheRuns) {
  const ProgramFolder folder;
  const std::string page = "getting-started.md";
  const auto [dome, dome_post] = summaries(folder, shipped("dome_circular"));
  EXPECT_EQ(dome["status"], "stable");
  EXPECT_EQ(dome["free_blocks"], 1280);
  expect_in(page, "1,280 blocks and a support");
  for (const auto& [friction, status] : {std::pair{"0.08", "moving"}, {"0.1", "stable"}}) {
    const auto [run, post] =
        summaries(folder, shipped("dome_circular"), std::string(" --set joints.friction=") + friction);
    EXPECT_EQ(run["status"], status) << friction;
  }
  expect_in(page, "the dome is `moving` at 0.08 and `stable` at 0.1");
  const auto [spirals, spirals_post] =
      summaries(folder, shipped("dome_circular_herringbone"), " --set loads.lantern.weight_fraction=0");
  expect_in(page, fmt::format("raise the outward thrust from {:.3f} to {:.3f} of the weight",
                              dome_post["thrust_over_weight"].get<double>(),
                              spirals_post["thrust_over_weight"].get<double>()));
  expect_in(page, fmt::format("displacements of {:.3f} m are not small",
                              spirals["max_displacement_m"].get<double>()));
  const auto [limit, limit_post] =
      summaries(folder, shipped("dome_circular"), settings_of_variant("dome_circular_limit"));
  expect_in(page, fmt::format("the critical friction, {:.4g},", limit["critical_value"].get<double>()));
}

TEST(TutorialSlow, NumbersOfTheImportedBlocksAreThoseOfTheRuns) {
  const ProgramFolder folder;
  const auto critical = [](const Json& run) { return run["critical_value"].get<double>(); };
  expect_in("getting-started.md", fmt::format("at which the portal overturns, {:.3g} g.",
                                              critical(summaries(folder, shipped("portal")).first)));
  expect_in("import.md", fmt::format("find the tilt at which they fall, {:.2f} degrees here",
                                     critical(summaries(folder, shipped("wall_window")).first)));
  const std::string wall = shipped("wall_window");
  for (const std::string& command :
       {"cupola-generate " + wall + " --output a.vtu",
        "cupola-solve " + wall + " --assembly a.vtu --output results | grep ^critical"}) {
    std::istringstream printed(folder.run(command).out);
    std::string line;
    for (int i = 0; i < 2 && std::getline(printed, line); ++i)  // the page cuts the lines at these places
      expect_in("import.md", line.substr(0, std::min(line.find("; largest"), line.find(" (relative"))));
  }
  const std::string push =
      " --set 'loads.forces=[{block: lintel, force: [0, 500, 0]}]'";  // as typed in section 4
  expect_in("import.md", fmt::format("The wall now falls at {:.2f} degrees.",
                                     critical(summaries(folder, shipped("wall_window"), push).first)));
}

}  // namespace
}  // namespace cupola::tutorial_test

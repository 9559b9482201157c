// Joint forces that were exported are those of the table of joints.

#include <cmath>

#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include "assembly/files/atomic_file.hpp"
#include "postproc/export_run.hpp"
#include "postproc/tables/result_tables.hpp"
#include "tests/postproc/scene.hpp"

namespace cupola::export_run_test {
namespace {

using Json = nlohmann::json;

/// Exports a column of three blocks whose resultants act at (0.5, 0.3) to a file with this ending; returns
/// its text.
std::string exported_column(const std::string& ending, Status status = Status::stable) {
  const std::string folder = test::fresh_folder("exported");
  const Assembly a = test::column(3);
  write_assembly(folder + "/assembly.vtu", a);
  ResultsWriter writer(folder + "/results", content_hash(a));
  Summary summary = test::column_summary(a);
  summary.status = status;
  test::write_frames({test::column_at_rest(a, test::kGravity, 0.0, 0.5, 0.3)}, summary, &writer);
  writer.write_summary(summary);
  const RunInput input{test::column_case(), folder + "/assembly.vtu", folder + "/results"};
  EXPECT_EQ(export_run(input, folder + "/column" + ending, true), ExitCode::done);
  return read_text(folder + "/column" + ending);
}

// Closed form: bed k carries the weight above it at (0.5, 0.3). The sums of four corner forces differ from it
// by rounding.
TEST(ExportRun, GivesTheInterfacesOfACompasFileTheirForces) {
  const Json graph = Json::parse(exported_column(".json"))["data"]["graph"]["data"];
  const double weight = 1.2 * 0.8 * 0.5 * 1800.0 * test::kGravity;
  for (int k = 0; k < 3; ++k) {
    const Json& edge = graph["edge"][std::to_string(k)][std::to_string(k + 1)];
    ASSERT_EQ(edge["interfaces"].size(), 1u);
    const Json& face = edge["interfaces"][0]["data"];
    EXPECT_NEAR(face["size"].get<double>(), 1.2 * 0.8, 1e-12);
    ASSERT_EQ(face["points"].size(), 4u);
    ASSERT_EQ(face["forces"].size(), 4u);
    double total = 0.0;
    Vec3 moment = Vec3::Zero();
    for (size_t i = 0; i < 4; ++i) {
      const double n = face["forces"][i]["c_np"];
      const Json& p = face["points"][i];
      total += n;
      moment += n * Vec3(p[0].get<double>(), p[1].get<double>(), p[2].get<double>());
      EXPECT_EQ(face["forces"][i]["c_nn"], 0.0);
      EXPECT_NEAR(face["forces"][i]["c_u"].get<double>(), 0.0, 1e-9);
    }
    const double above = (3 - k) * weight;
    EXPECT_NEAR(total, above, 1e-9 * above);
    EXPECT_NEAR((moment / total - Vec3(0.5, 0.3, 0.5 * k)).norm(), 0.0, 1e-12);
    const Json& resultant = edge["resultants"][0];
    EXPECT_NEAR(resultant["force"][2].get<double>(), above, 1e-9 * above);
    EXPECT_NEAR(resultant["point"][0].get<double>(), 0.5, 1e-12);
  }
}

TEST(ExportRun, WritesTheTableOfJointsAsCsv) {
  const std::string text = exported_column(".csv");
  const Evaluation e = test::column_evaluation(0.5, 0.3);
  EXPECT_EQ(text, to_csv(joint_table(e, e.last.joints.wrenches)));
  EXPECT_EQ(std::count(text.begin(), text.end(), '\n'), 4) << "a header and three joints";
}

TEST(ExportRun, AddsAnArrowPerJointToTheGltf) {
  const Json file = Json::parse(exported_column(".gltf"));
  EXPECT_EQ(file["nodes"].back()["name"], "forces");
  EXPECT_GT(file["nodes"].back()["extras"]["scale_m_per_N"], 0.0);
}

// Forces of an unfinished solve are no result.
TEST(ExportRun, LeavesOutForcesWithoutEquilibrium) {
  const Json graph = Json::parse(exported_column(".json", Status::unconverged))["data"]["graph"]["data"];
  EXPECT_TRUE(graph["edge"].empty());
  EXPECT_EQ(graph["node"].size(), 4u);
}

// The frame has the contacts of the two lower blocks.
TEST(ExportRun, WarnsOfBlocksThatTheLastStageHasNotLaid) {
  const std::string folder = test::fresh_folder("exported");
  const Assembly a = test::column(3);
  write_assembly(folder + "/assembly.vtu", a);
  ResultsWriter writer(folder + "/results", content_hash(a));
  Summary summary = test::column_summary(a);
  summary.analysis = AnalysisType::staged;
  Frame stage = test::column_at_rest(a, test::kGravity, 0.0, 0.5, 0.3);
  stage.contacts = test::column_at_rest(test::column(2), test::kGravity, 0.0, 0.5, 0.3).contacts;
  stage.time = 1.0;
  test::write_frames({stage}, summary, &writer);
  writer.write_summary(summary);
  testing::internal::CaptureStderr();
  EXPECT_EQ(export_run({test::column_case(), folder + "/assembly.vtu", folder + "/results"},
                       folder + "/column.obj", true),
            ExitCode::done);
  const std::string said = testing::internal::GetCapturedStderr();
  EXPECT_NE(said.find("1 block that the last stage has not laid"), std::string::npos) << said;
}

// An assembly holds no damage and no crushing of joints: said where a path has left some, or the stages of a
// construction. The table of joints has a column for it.
TEST(ExportRun, WarnsOfDamageThatIsLost) {
  const Assembly a = test::column(3);
  const auto said_of = [&a](double damage, bool crushes, FrameRole role = FrameRole::path,
                            const std::string& ending = ".vtu") {
    const std::string folder = test::fresh_folder("exported");
    write_assembly(folder + "/assembly.vtu", a);
    ResultsWriter writer(folder + "/results", content_hash(a));
    Summary summary = test::column_summary(a);
    summary.analysis = AnalysisType::path;
    Frame frame = test::column_at_rest(a, test::kGravity, 0.0, 0.5, 0.3);
    set_role(role, "", &frame);
    ContactTable& contacts = frame.contacts;
    const std::vector<double> zero(static_cast<size_t>(contacts.size()), 0.0);
    contacts.friction_limit = contacts.strength_use = contacts.damage = contacts.crack_opening = zero;
    contacts.damage[2] = damage;
    contacts.damage[3] = std::nan("");  // a dry joint
    writer.write_frame(frame);
    writer.write_summary(summary);
    Case scene = test::column_case();
    scene.analysis.type = AnalysisType::path;
    scene.joints.compliance.per = Compliance::Per::area;
    scene.joints.strength.cohesion = 1e5;
    if (crushes) scene.joints.strength.compression = 1e6;
    testing::internal::CaptureStderr();
    export_run({scene, folder + "/assembly.vtu", folder + "/results"}, folder + "/column" + ending, true);
    return testing::internal::GetCapturedStderr();
  };
  EXPECT_EQ(said_of(0.0, false).find("exported as new"), std::string::npos);
  EXPECT_NE(said_of(0.75, false).find("without their damage (up to 0.75):"), std::string::npos);
  EXPECT_NE(said_of(0.0, true).find("(up to 0) and crushing:"), std::string::npos);
  EXPECT_NE(said_of(1.0, false, FrameRole::stage).find("without their damage (up to 1):"), std::string::npos);
  EXPECT_EQ(said_of(0.75, true, FrameRole::path, ".csv").find("exported as new"), std::string::npos);
}

}  // namespace
}  // namespace cupola::export_run_test

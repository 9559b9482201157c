#include "postproc/evaluation/evaluation.hpp"

#include <algorithm>
#include <cmath>
#include <filesystem>

#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "assembly/export/placed_assembly.hpp"
#include "assembly/files/atomic_file.hpp"
#include "assembly/files/content_hash.hpp"
#include "assembly/model/thickness.hpp"
#include "postproc/mechanics/ring_sums.hpp"
#include "postproc/report/report.hpp"
#include "postproc/tables/mesh_output.hpp"
#include "postproc/tables/post_summary.hpp"
#include "postproc/tables/result_columns.hpp"
#include "postproc/tables/result_tables.hpp"
#include "tests/postproc/scene.hpp"

namespace cupola::evaluation_test {
namespace {

using test::column_case;
using test::column_evaluation;
using test::column_summary;
using test::evaluated;
using test::kGravity;

const double kBlockWeight = 0.48 * 1800.0 * kGravity;

TEST(Evaluation, EveryRingCarriesTheLoadAbove) {
  const Evaluation e = column_evaluation(0.6, 0.4, 10.0);
  ASSERT_EQ(e.rings.size(), 3u);
  for (int k = 0; k < 3; ++k) {
    EXPECT_NEAR(e.rings[k].load_above.z(), -((3 - k) + 30) * kBlockWeight, 1e-9 * kBlockWeight);
    EXPECT_LT(e.rings[k].relative_difference, 1e-14);
    EXPECT_EQ(e.rings[k].blocks, 1);
    EXPECT_NEAR(e.rings[k].height, 0.5 * k, 1e-15);
  }
  EXPECT_TRUE(e.warnings.empty());
}

TEST(Evaluation, MissingForceShowsInTheRingSum) {
  const Assembly a = test::column(3);
  Frame frame = test::column_at_rest(a, kGravity, 0.0, 0.6, 0.4);
  for (int i = 0; i < frame.contacts.size(); ++i)
    if (frame.contacts.ring[i] == 1) frame.contacts.force[i] *= 0.99;
  const Evaluation e = evaluated(a, {frame}, column_summary(a), column_case(), test::fresh_folder("results"));
  EXPECT_LT(e.rings[0].relative_difference, 1e-14);
  EXPECT_NEAR(e.rings[1].relative_difference, 0.01, 1e-12);
}

// Of three blocks the lowest stands alone; the others, with the load on top, are parts that fall.
TEST(Evaluation, PartsThatFallLoadNothing) {
  const Assembly a = test::column(3);
  Frame frame = test::column_at_rest(a, kGravity, 0.0, 0.6, 0.4);
  frame.contacts = test::column_at_rest(test::column(1), kGravity, 0.0, 0.6, 0.4).contacts;
  Summary summary = column_summary(a);
  summary.parts = {{1, 1, Status::stable}, {2, 2, Status::moving}};
  Case scene = column_case();
  scene.loads.top_load = TopLoad{10.0};
  const Evaluation e = evaluated(a, {frame}, summary, scene, test::fresh_folder("results"));
  ASSERT_EQ(e.rings.size(), 3u);
  EXPECT_NEAR(e.rings[0].load_above.z(), -kBlockWeight, 1e-9 * kBlockWeight);
  EXPECT_LT(e.rings[0].relative_difference, 1e-14);
  EXPECT_EQ(e.rings[1].blocks, 0);
  EXPECT_NEAR(e.rings[1].height, 0.5, 1e-15) << "of its bed as built: no joint is left on it";
  EXPECT_TRUE(e.last.loads.empty());
}

TEST(Evaluation, EccentricColumnHasEccentricityKernAndEdgeDistance) {
  // Resultant at (0.9, 0.4) of a 1.2 x 0.8 m bed: eccentricity 0.3 m, kern 6 e / b = 1.5, edge 0.3 m away.
  const Evaluation e = column_evaluation(0.9, 0.4);
  for (const JointWrench& joint : e.last.joints.wrenches) {
    EXPECT_NEAR(joint.eccentricity, 0.3, 1e-12);
    EXPECT_NEAR(joint.kern, 1.5, 1e-12);
    EXPECT_NEAR(joint.edge_distance, 0.3, 1e-12);
    EXPECT_NEAR(joint.patch.area, 0.96, 1e-12);
    EXPECT_LT(joint.wrench.moment.norm(), 1e-12 * kBlockWeight) << "about the centre of pressure";
    EXPECT_EQ(joint.upper, joint.block_b);
  }
  // Meridional force of the middle block: mean of the forces on its lower and upper bed, per metre of length.
  EXPECT_NEAR(e.last.fields[2].meridional_force, 1.5 * kBlockWeight / 1.2, 1e-9 * kBlockWeight);
  EXPECT_NEAR(e.last.fields[2].hoop_force, 0.0, 1e-9 * kBlockWeight);
  EXPECT_NEAR(e.axes[2].thickness, 0.8, 1e-12);
}

TEST(Evaluation, WrenchOfAJointIsTheSumOfItsContacts) {
  const Assembly a = test::column(2);
  Frame frame = test::column_at_rest(a, kGravity, 0.0, 0.7, 0.3);
  for (int i = 0; i < frame.contacts.size(); ++i)
    frame.contacts.force[i] += Vec3(30.0 * i, -20.0 * i * i, 7.0);
  const JointWrenches joints = joint_wrenches(a, frame.contacts, shell_of(a, Vec3::UnitZ()));
  for (const Vec3& about : {Vec3(0, 0, 0), Vec3(5, -3, 8)}) {
    for (size_t j = 0; j < joints.wrenches.size(); ++j) {
      Wrench direct;
      direct.point = about;
      for (int i = 0; i < frame.contacts.size(); ++i)
        if (frame.contacts.joint[i] == static_cast<int>(j))
          direct.add_force(frame.contacts.point[i], frame.contacts.force[i]);
      const Wrench moved = moved_to(joints.wrenches[j].wrench, about);
      EXPECT_LT((moved.force - direct.force).norm(), 1e-12 * direct.force.norm());
      EXPECT_LT((moved.moment - direct.moment).norm(), 1e-11 * direct.force.norm()) << "lever arms of 10 m";
    }
  }
}

// The ground has carried the column 3 m away, of them 2.9 m when its contacts were found: all is where it was
// built.
TEST(Evaluation, LeavesTheMotionOfTheGroundOut) {
  const Assembly a = test::column(3);
  const Frame still = test::column_at_rest(a, kGravity, 0.0, 0.6, 0.4);
  Frame frame = still;
  BlockTable& blocks = frame.blocks;
  const Vec3 then(2.9, 0.0, 0.0);
  for (const Vec3& position : still.blocks.position) blocks.contact_position.push_back(position + then);
  blocks.contact_quaternion_wxyz = blocks.quaternion_wxyz;
  for (Vec3& point : frame.contacts.point) point += then;
  for (Vec3& position : blocks.position) position.x() += 3.0;
  const Evaluation e = test::evaluated_path(a, frame, BaseMotion{});
  constexpr double kRounding = 1e-14;  // of coordinates of 3 m
  const auto expect_at = [=](const std::vector<Vec3>& found, const std::vector<Vec3>& expected) {
    ASSERT_EQ(found.size(), expected.size());
    for (size_t i = 0; i < found.size(); ++i) EXPECT_LT((found[i] - expected[i]).norm(), kRounding);
  };
  expect_at(e.last.frame.contacts.point, still.contacts.point);
  expect_at(e.last.frame.blocks.position, still.blocks.position);
  expect_at(e.last.frame.blocks.contact_position, still.blocks.position);
  ASSERT_EQ(e.sections.at(0).polygons.size(), 1u);
  EXPECT_LT((polygon_centroid(e.sections[0].polygons[0].outline) - Vec3(0.6, 0.4, 0.8)).norm(), kRounding);
}

TEST(Evaluation, LoadsFollowTheirTimeFunction) {
  // At the time of the frame, gravity and top load have half their values, and so do the contact forces.
  const Assembly a = test::column(3);
  Case scene = column_case();
  scene.loads.top_load = TopLoad{2.0};
  scene.loads.dead_load_time = RampInTime{0.0, 1.0, 0.0, 4.0};
  const double g = 0.5 * kGravity;
  Frame frame = test::column_at_rest(a, g, 2.0 * free_weight(a, g), 0.6, 0.4);
  frame.time = 2.0;
  const Evaluation e = evaluated(a, {frame}, column_summary(a), scene, test::fresh_folder("results"));
  for (const RingSum& ring : e.rings) EXPECT_LT(ring.relative_difference, 1e-14);
  EXPECT_NEAR(e.rings[0].load_above.z(), -4.5 * kBlockWeight, 1e-9 * kBlockWeight);
}

TEST(Evaluation, UnreadableFramesAreReportedBeforeWarnings) {
  const Assembly a = test::column(3);
  const Frame frame = test::column_at_rest(a, kGravity, 0.0, 0.6, 0.4);
  Summary summary = column_summary(a);
  summary.status = Status::unconverged;
  summary.case_hash = "another";
  Frame later = frame;
  later.time = 1.0;
  const std::string folder = test::fresh_folder("results");
  ResultsWriter writer(folder, content_hash(a));
  test::write_frames({frame, later}, summary, &writer);
  writer.write_summary(summary);
  std::filesystem::remove(folder + "/contacts_0001.vtp");
  const Evaluation e = evaluate(column_case(), a, ResultsReader(folder, content_hash(a)));
  EXPECT_EQ(e.last.frame.time, 0.0);
  const std::vector<std::string> reported = notices(e);
  ASSERT_EQ(reported.size(), 3u);
  EXPECT_NE(reported[0].find("frame 1 was left out"), std::string::npos);
  EXPECT_NE(reported[0].find("contacts_0001.vtp"), std::string::npos);
  EXPECT_NE(reported[1].find("did not reach the requested accuracy"), std::string::npos);
  EXPECT_NE(reported[2].find("the case has changed"), std::string::npos);
}

TEST(Evaluation, ResultsOfAnotherAssemblyAreRejected) {
  const Assembly a = test::column(3), b = test::column(4);
  const std::string folder = test::fresh_folder("results");
  evaluated(a, {test::column_at_rest(a, kGravity, 0.0, 0.6, 0.4)}, column_summary(a), column_case(), folder);
  EXPECT_THROW(ResultsReader(folder, content_hash(b)), InputError);
}

TEST(Evaluation, MechanismGroupsFollowTheMotion) {
  const Assembly a = test::column(3);
  Frame frame = test::column_at_rest(a, kGravity, 0.0, 0.6, 0.4);
  for (const size_t b : {2u, 3u}) {  // the two upper blocks slide as one
    frame.blocks.displacement[b] = Vec3(0.2, 0, 0);
    frame.blocks.position[b] += Vec3(0.2, 0, 0);
  }
  const JointWrenches joints = joint_wrenches(a, frame.contacts, shell_of(a, Vec3::UnitZ()));
  EXPECT_EQ(mechanism_groups(a, poses_of(a, frame.blocks), joints, 0.004), (std::vector{0, 0, 1, 1}));
  EXPECT_EQ(mechanism_groups(a, poses_of(a, frame.blocks), joints, 0.3), (std::vector{0, 0, 0, 0}));
}

// The two upper blocks lean over the edge at x = 1.2 m, where alone they touch the block below: its points do
// not move, and 0.1 rad lift the other end of the bed by 0.12 m.
TEST(Evaluation, AnOpenHingePartsTheBodiesThatTurnAboutIt) {
  const Assembly a = test::column(3);
  Frame frame = test::column_at_rest(a, kGravity, 0.0, 0.6, 0.4);
  const Eigen::AngleAxisd turn(0.1, Vec3::UnitY());
  const Vec3 hinge(1.2, 0.4, 0.5);
  const Eigen::Quaterniond q(turn);
  for (const size_t b : {2u, 3u}) {
    frame.blocks.position[b] = hinge + turn * (a.blocks[b].centroid - hinge);
    frame.blocks.quaternion_wxyz[b] = {q.w(), q.x(), q.y(), q.z()};
    frame.blocks.displacement[b] = frame.blocks.position[b] - a.blocks[b].centroid;
  }
  ContactTable& c = frame.contacts;
  for (int i = 0; i < c.size(); ++i)
    if (c.block_a[i] == 1 && c.point[i].x() == 0.0) c.point[i].x() = 1.2;
  const JointWrenches joints = joint_wrenches(a, c, shell_of(a, Vec3::UnitZ()));
  EXPECT_EQ(mechanism_groups(a, poses_of(a, frame.blocks), joints, 0.11), (std::vector{0, 0, 1, 1}));
  EXPECT_EQ(mechanism_groups(a, poses_of(a, frame.blocks), joints, 0.14), (std::vector{0, 0, 0, 0}));
}

TEST(Evaluation, LimitAnalysisEvaluatesTheEquilibriumAndDisplacesTheMechanism) {
  const Assembly a = test::column(3);
  Frame stable = test::column_at_rest(a, kGravity, 0.0, 0.6, 0.4), moving = stable;
  moving.time = 1.0;
  for (int i = 0; i < moving.contacts.size(); ++i) moving.contacts.force[i] *= 0.5;  // not in equilibrium
  moving.blocks.velocity[3] = Vec3(1.0, 0, 0);  // the top block slides off
  Summary summary = column_summary(a);
  summary.analysis = AnalysisType::limit;
  summary.critical = CriticalValue{"friction", 0.1, 0.101, 0.099};
  const std::string folder = test::fresh_folder("results");
  const Evaluation e = evaluated(a, {stable, moving}, summary, column_case(), folder);
  EXPECT_EQ(e.last.frame.time, 0.0);
  EXPECT_LT(e.rings[0].relative_difference, 1e-14);
  EXPECT_TRUE(e.warnings.empty());
  EXPECT_EQ(post_summary(e).critical_value, 0.1);
  EXPECT_NE(verdict_text(summary, e.last.frame.role).find("stands at a friction of 0.101 and moves at 0.099"),
            std::string::npos);

  const FrameEvaluation mechanism = evaluate_frame(e, ResultsReader(folder, content_hash(a)).read_frame(1));
  // 2.5 % of the model size: of the range of centroids, 0.25 to 1.25 m, or of the cube root of the first
  // block's volume.
  const double shown = 0.025 * std::max(1.0, std::cbrt(a.blocks[0].volume));
  EXPECT_NEAR(mechanism.frame.blocks.displacement[3].x(), shown, 1e-12);
  EXPECT_EQ(mechanism.frame.blocks.displacement[2].norm(), 0.0);
  for (const BlockRow& row : block_rows(e, mechanism))
    EXPECT_TRUE(row.displacement.isZero(0.0)) << "in tables";
  EXPECT_EQ(mechanism.groups, (std::vector{0, 0, 0, 1}));
}

// The two upper blocks turn as one about the edge at x = 1.2 m: by 0.5 rad if a stone 20 m away makes the
// model large, where the centroids have left their circles by more than bodies may part.
TEST(Evaluation, OneBodyTipsInALargeModelToo) {
  Assembly a = test::column(3);
  a.blocks.push_back(a.blocks[1]);
  test::add_box(&a, 4, 0, {20, 0, 0}, {21, 1, 1}, FaceKind::top);
  compute_mass_properties(&a);
  Frame frame = test::column_at_rest(a, kGravity, 0.0, 0.6, 0.4);
  const Vec3 hinge(1.2, 0.4, 0.5);
  for (const size_t b : {2u, 3u}) {
    frame.blocks.angular_velocity[b] = Vec3::UnitY();
    frame.blocks.velocity[b] = Vec3::UnitY().cross(a.blocks[b].centroid - hinge);
  }
  Summary summary = column_summary(a);
  summary.status = Status::moving;
  const Evaluation e = evaluated(a, {frame}, summary, column_case(), test::fresh_folder("results"));
  EXPECT_EQ(e.last.groups, (std::vector{0, 0, 1, 1, 2}));
  EXPECT_NEAR(e.last.frame.blocks.displacement[3].norm(), 0.025 * model_size(a), 1e-12) << "is shown";
}

// The forces of a limit analysis balance the loads at the stable end of its bracket, not those of the case.
TEST(Evaluation, LimitAnalysisIsEvaluatedUnderItsLoads) {
  const Assembly a = test::column_with_wythes();
  Case scene = column_case();
  scene.analysis.limit.parameter = LimitSearch::Parameter::acceleration;  // along x
  Frame frame = test::column_at_rest(a, kGravity, 0.0, 0.6, 0.4);
  for (Vec3& force : frame.contacts.force) force.x() -= 0.2 * force.z();  // friction on the block above
  Summary summary = column_summary(a);
  summary.analysis = AnalysisType::limit;
  summary.critical = CriticalValue{"acceleration", 0.2005, 0.2, 0.201};
  const Evaluation e = evaluated(a, {frame}, summary, scene, test::fresh_folder("results"));
  for (const RingSum& ring : e.rings) EXPECT_LT(ring.relative_difference, 1e-14);
  double weight = 0.0;
  for (const MemberSum& sum : e.members) weight += sum.weight;
  EXPECT_NEAR(weight, summary.weight_N, 1e-12 * weight) << "rounding; without the acceleration";
}

TEST(Evaluation, LimitAnalysisIsEvaluatedAtItsThickness) {
  const Assembly a = test::column(3);
  Case scene = column_case();
  scene.analysis.limit.parameter = LimitSearch::Parameter::thickness;
  Summary summary = column_summary(a);
  summary.analysis = AnalysisType::limit;
  summary.critical = CriticalValue{"thickness", 0.505, 0.5, 0.51};
  const Frame frame = test::column_at_rest(with_thickness(a, 0.5), kGravity, 0.0, 0.6, 0.4);
  const Evaluation e = evaluated(a, {frame}, summary, scene, test::fresh_folder("results"));
  EXPECT_NEAR(e.axes[2].thickness, 0.4, 1e-12);
  for (const RingSum& ring : e.rings) EXPECT_LT(ring.relative_difference, 1e-14);
  EXPECT_TRUE(e.warnings.empty()) << "the results belong to the assembly as generated";
}

Evaluation staged_column(const Assembly& a, Frame stage, double time, const Case& scene) {
  stage.time = time;
  Summary summary = column_summary(a);
  summary.analysis = AnalysisType::staged;
  return evaluated(a, {stage}, summary, scene, test::fresh_folder("results"));
}

// Springers of an arch on skewbacks have joints without an upper block.
TEST(Evaluation, AStageHasTheBlocksThatAreTheUpperOnesOfNoJoint) {
  const Assembly a = test::column(3);
  Case scene = column_case();
  scene.loads.forces = {{BlockRef{3}, a.blocks[3].centroid, Vec3(0, 0, -kBlockWeight), {}}};
  Frame frame = test::column_at_rest(a, kGravity, kBlockWeight, 0.6, 0.4);
  for (JointKind& kind : frame.contacts.kind) kind = JointKind::other;
  const Evaluation e = staged_column(a, frame, 2.0, scene);
  ASSERT_EQ(e.last.loads.size(), 1u) << "the structure is complete";
  EXPECT_NEAR(e.rings[0].load_above.z(), -4.0 * kBlockWeight, 1e-12 * kBlockWeight);
  for (const RingSum& ring : e.rings) EXPECT_LT(ring.relative_difference, 1e-14) << ring.ring;
}

// A mitre on which a springer leans has cut away its bed, and is no bed of the block above.
TEST(Evaluation, ASpringerOnASkewbackIsAtTheHeightOfItsJoint) {
  const Evaluation e = column_evaluation(0.6, 0.4);
  Assembly a = e.assembly;
  a.sheets = {{.name = "pier", .num_rings = 1}, {.name = "arch", .first_ring = 1, .num_rings = 2}};
  Shell shell = e.shell;
  shell.beds[1].clear();
  JointWrenches joints = e.last.joints;
  for (JointWrench& joint : joints.wrenches)
    if (std::max(joint.block_a, joint.block_b) == 2) joint.carried = -1;
  const std::vector<RingSum> rings =
      ring_sums(a, shell, joints, e.last.from_below, e.last.gravity, {}, {}, std::vector<bool>());
  EXPECT_NEAR(rings.at(1).height, 0.5, 1e-15) << "rounding";
}

// Of an arch of three stones the third is the springer of the other haunch, laid and held with the first.
TEST(Evaluation, AStageOfAnArchStandsOnBothHaunchesThatItHolds) {
  Assembly a = test::column(3);
  a.sheets = {{.name = "arch", .num_rings = 3, .thrust_lines = Sheet::ThrustLines::one}};
  Case scene = column_case();
  scene.analysis.staged.hold_below = 0;
  scene.loads.forces = {{BlockRef{2}, a.blocks[2].centroid, Vec3(0, 0, -kBlockWeight), {}}};
  Frame frame = test::column_at_rest(a, kGravity, 0.0, 0.6, 0.4);  // block 3 presses on block 2
  for (int i = 0; i < frame.contacts.size(); ++i)
    if (frame.contacts.block_b[i] == 2) frame.contacts.force[i].z() += 0.25 * kBlockWeight;
  const Evaluation e = staged_column(a, frame, 1.0, scene);
  ASSERT_EQ(e.last.loads.size(), 1u) << "the far haunch is laid";
  EXPECT_EQ(e.rings[0].blocks + e.rings[2].blocks, 0) << "held";
  EXPECT_NEAR(e.rings[1].load_above.z(), -2.0 * kBlockWeight, 1e-12 * kBlockWeight);
  EXPECT_LT(e.rings[1].relative_difference, 1e-14) << "the far haunch is a support";
}

// Stage of a construction: block 2 is laid on block 1, which is held; block 3 is not laid yet.
TEST(Evaluation, AStageLeavesOutHeldBlocksAndBlocksNotLaidYet) {
  const Assembly a = test::column(3);
  Frame frame = test::column_at_rest(a, kGravity, -a.blocks[3].mass * kGravity, 0.6, 0.4), stage = frame;
  stage.contacts = {};
  const ContactTable& all = frame.contacts;
  for (int i = 0; i < all.size(); ++i) {
    if (all.block_b[i] != 2) continue;
    ContactTable& c = stage.contacts;
    c.joint.push_back(0);
    c.block_a.push_back(1), c.block_b.push_back(2);
    c.kind.push_back(all.kind[i]), c.ring.push_back(1);
    c.point.push_back(all.point[i]), c.normal.push_back(all.normal[i]), c.force.push_back(all.force[i]);
    for (auto list : {&ContactTable::gap, &ContactTable::normal_force, &ContactTable::friction_use,
                      &ContactTable::area, &ContactTable::slip, &ContactTable::law_violation})
      (c.*list).push_back((all.*list)[i]);
  }
  Case scene = column_case();
  scene.analysis.staged.hold_below = 0;
  scene.loads.forces = {{BlockRef{2}, a.blocks[2].centroid, Vec3(0, 0, -500), {}}};
  scene.postproc.planes = {{"low", {0, 0, 0.2}, {0, 0, 1}}};
  const Evaluation e = staged_column(a, stage, 1.0, scene);
  EXPECT_TRUE(e.last.loads.empty()) << "loads act once all blocks are laid";
  EXPECT_EQ(e.rings[0].blocks, 0);
  EXPECT_EQ(e.rings[1].blocks, 1);
  EXPECT_EQ(e.rings[2].blocks, 0);
  EXPECT_NEAR(e.rings[1].load_above.z(), -kBlockWeight, 1e-9 * kBlockWeight) << "block 3 weighs nothing yet";
  for (const RingSum& ring : e.rings) EXPECT_LT(ring.relative_difference, 1e-14);
  EXPECT_EQ(ring_table(e).rows.size(), 1u);
  ASSERT_EQ(e.sections.size(), 1u) << "at 0.8 m, through block 2";
  EXPECT_EQ(e.sections[0].beds, std::vector{1}) << "the only bed with forces";
  ASSERT_EQ(e.planes.size(), 1u);
  EXPECT_NEAR(e.planes[0].load_beyond.z(), -kBlockWeight, 1e-9 * kBlockWeight);
  EXPECT_LT(e.planes[0].relative_difference, 1e-14);
  EXPECT_FALSE(post_summary(e).thrust_over_weight) << "nothing is known of the base";
}

TEST(Evaluation, CracksEncloseTheOpenPoints) {
  const Assembly a = test::column(2);
  Frame frame = test::column_at_rest(a, kGravity, 0.0, 1.2, 0.4);  // on the edge x = 1.2: x = 0 is unloaded
  for (int i = 0; i < frame.contacts.size(); ++i)
    if (frame.contacts.force[i].norm() == 0.0) frame.contacts.gap[i] = 0.002;
  const Evaluation e = evaluated(a, {frame}, column_summary(a), column_case(), test::fresh_folder("results"));
  const Mesh cracks = cracks_mesh(e);
  EXPECT_EQ(cracks.num_cells(), 2);
  EXPECT_EQ(cracks.array<double>(cracks.cell_data, "opening_m", 1), (std::vector{0.002, 0.002}));
  for (int i = 0; i < cracks.num_points(); ++i) EXPECT_NEAR(cracks.points[3 * i], 0.0, 1e-15);
  EXPECT_NEAR(e.last.joints.wrenches[0].open_share, 0.5, 1e-12);
}

// 32 blocks of three uprights: 96 steps make a turn, so each of 8 spirals reaches its neighbour's place after
// 12 rings.
TEST(RibRatio, BondRepeatsWhenEverySpiralStandsWhereItsNeighbourStood) {
  HerringboneBond spirals;
  EXPECT_EQ(bond_period(spirals), 12);
  spirals.refine = 2;
  EXPECT_EQ(bond_period(spirals), 24);
  spirals.spirals = 5;  // 5 and 96 have no common divisor: a full turn
  EXPECT_EQ(bond_period(spirals), 192);
  spirals.path = HerringboneBond::Path::meridian;
  EXPECT_EQ(bond_period(spirals), 1);
  EXPECT_EQ(bond_period(RunningBond{}), 2);
  EXPECT_EQ(bond_period(StackBond{}), 1);
}

TEST(Evaluation, SummaryReadsBackUnchanged) {
  const Evaluation e = column_evaluation(0.9, 0.4);
  const std::string folder = test::fresh_folder("post");
  write_text_atomically(folder + "/summary.json", post_summary_json(e));
  const PostSummary written = post_summary(e), read = read_post_summary(folder);
  EXPECT_EQ(read.title, written.title);
  EXPECT_EQ(read.mean_kern_use, written.mean_kern_use);
  EXPECT_NEAR(read.mean_kern_use.value(), 1.5, 1e-12);
  EXPECT_EQ(read.largest_ring_difference, written.largest_ring_difference);
  EXPECT_EQ(read.rib_over_mid_sail, std::nullopt);
  EXPECT_THROW(read_post_summary("/nowhere/at/all"), InputError);
}

}  // namespace
}  // namespace cupola::evaluation_test

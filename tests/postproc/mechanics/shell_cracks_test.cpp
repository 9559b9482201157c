#include "postproc/mechanics/shell_cracks.hpp"

#include <filesystem>
#include <fstream>
#include <map>
#include <numbers>

#include <gtest/gtest.h>

#include "postproc/figures/figures.hpp"
#include "postproc/report/answers.hpp"
#include "postproc/tables/observed_cracks.hpp"
#include "postproc/tables/post_summary.hpp"
#include "postproc/tables/shell_map.hpp"
#include "tests/postproc/models.hpp"

namespace cupola::shell_cracks_test {
namespace {

constexpr int kRings = 4, kBlocks = 8;
constexpr double kWidth = 2 * std::numbers::pi / kBlocks;

/// Gaps at the inner and the outer edge, m.
struct Gap {
  double inner = 0.0, outer = 0.0;
};

/// Head joints of ring_vault(4, 8, 0), of which those named (ring, slot) are open at the low side of that
/// block.
class Vault {
 public:
  explicit Vault(const std::map<std::pair<int, int>, Gap>& open)
      : assembly_(test::ring_vault(kRings, kBlocks, 0.0)) {
    for (int ring = 0; ring < kRings; ++ring)
      for (int slot = 0; slot < kBlocks; ++slot) {
        const auto found = open.find({ring, slot});
        add_head(ring, slot, found == open.end() ? Gap{} : found->second);
        if (ring > 0)
          for (const int below : {slot, (slot + (ring % 2 ? 1 : kBlocks - 1)) % kBlocks})
            add_bed(ring, slot, below);
      }
    evaluate();
  }
  void move(const Vec3& by) {
    for (Sheet& sheet : assembly_.sheets) sheet.origin += by;
    for (std::vector<Vec3>* points : {&assembly_.vertices, &contacts_.point})
      for (Vec3& point : *points) point += by;
    evaluate();
  }
  std::vector<ShellCrack> cracks() const {
    return shell_cracks(assembly_, contacts_, evaluation_.last.joints, evaluation_.axes);
  }
  Evaluation& evaluation() { return evaluation_; }

 private:
  void evaluate() {
    shell_ = shell_of(assembly_, Vec3::UnitZ());
    evaluation_.assembly = assembly_;
    evaluation_.shell = shell_;
    evaluation_.last.frame.contacts = contacts_;
    evaluation_.last.frame.role = FrameRole::path;
    evaluation_.last.joints = joint_wrenches(assembly_, contacts_, shell_);
    evaluation_.axes = shell_axes(assembly_, shell_);
  }
  static double angle_of(int ring, int slot) { return (slot + (ring % 2 ? 0.5 : 0.0)) * kWidth; }
  static Vec3 point(int ring, bool upper, double angle, bool outer) {
    const double r = outer ? 11.0 : 10.0, t = 0.02 * (upper ? ring + 1 : ring), rho = r * std::cos(t) - 3.0;
    return {rho * std::cos(angle), rho * std::sin(angle), r * std::sin(t)};
  }
  void add(int a, int b, JointKind kind, int ring, const Vec3& x, Vec3 normal, double gap) {
    if (a > b) {
      std::swap(a, b);
      normal = -normal;
    }
    const auto [joint, is_new] = numbers_.try_emplace({a, b}, static_cast<int>(numbers_.size()));
    ContactTable& c = contacts_;
    c.joint.push_back(joint->second);
    c.block_a.push_back(a);
    c.block_b.push_back(b);
    c.kind.push_back(kind);
    c.ring.push_back(ring);
    c.point.push_back(x);
    c.normal.push_back(normal);
    c.gap.push_back(gap);
    c.force.push_back(gap > 0.0 ? Vec3(Vec3::Zero()) : Vec3(1e3 * normal));
    c.normal_force.push_back(gap > 0.0 ? 0.0 : 1e3);
    c.area.push_back(0.05);
    for (std::vector<double>* zero : {&c.friction_use, &c.slip, &c.law_violation}) zero->push_back(0.0);
  }
  void add_head(int ring, int slot, const Gap& gap) {
    const double angle = angle_of(ring, slot);
    const int before = ring * kBlocks + (slot + kBlocks - 1) % kBlocks;
    for (const bool upper : {false, true})
      for (const bool outer : {false, true})
        add(before, ring * kBlocks + slot, JointKind::head, ring, point(ring, upper, angle, outer),
            Vec3(-std::sin(angle), std::cos(angle), 0), outer ? gap.outer : gap.inner);
  }
  void add_bed(int ring, int slot, int below) {
    const double from = std::max(angle_of(ring, slot), angle_of(ring - 1, below));
    for (const double angle : {from, from + 0.5 * kWidth})
      for (const bool outer : {false, true})
        add((ring - 1) * kBlocks + below, ring * kBlocks + slot, JointKind::bed, ring,
            point(ring, false, angle, outer), Vec3::UnitZ(), 0.0);
  }

  Assembly assembly_;
  std::map<std::pair<int, int>, int> numbers_;
  ContactTable contacts_;
  Shell shell_;
  Evaluation evaluation_;
};

/// Two toothed cracks: one through both faces of all four courses at 45 to 67.5 degrees, one at the outer
/// face of two.
std::map<std::pair<int, int>, Gap> two_cracks() {
  return {{{0, 1}, {2e-3, 4e-3}}, {{1, 1}, {2e-3, 5e-3}}, {{2, 1}, {1e-3, 4e-3}},
          {{3, 1}, {1e-3, 3e-3}}, {{1, 5}, {0.0, 1e-3}},  {{2, 5}, {0.0, 2e-3}}};
}

TEST(ShellCracks, FollowTheHeadJointsFromCourseToCourse) {
  const std::vector<ShellCrack> cracks = Vault(two_cracks()).cracks();
  ASSERT_EQ(cracks.size(), 2u);
  EXPECT_EQ(cracks[0].course, CrackCourse::meridional);
  EXPECT_EQ(cracks[0].joints.size(), 4u);
  EXPECT_EQ(cracks[1].joints.size(), 2u);
  EXPECT_EQ(cracks[0].width_inner, 2e-3);
  EXPECT_EQ(cracks[0].width_outer, 5e-3);
  EXPECT_TRUE(cracks[0].through);
  EXPECT_EQ(cracks[1].width_inner, 0.0);
  EXPECT_EQ(cracks[1].width_outer, 2e-3);
  EXPECT_FALSE(cracks[1].through);
  // Courses of 0.02 rad on the sphere of 10 to 11 m, open from bed to bed.
  EXPECT_NEAR(cracks[0].length, 4 * 0.02 * 10.5, 0.05);
  EXPECT_NEAR(cracks[0].rotation, 3e-3 / 1.0, 1e-4) << "outer less inner gap over the depth";
}

// A joint open at one corner, by as much as the next one along its trace is closed: open over half its length.
TEST(ShellCracks, OneOpenCornerOpensTheJointOverALength) {
  Vault vault({{{0, 1}, {1e-3, 1e-3}}});
  const Evaluation& e = vault.evaluation();
  ContactTable contacts = e.last.frame.contacts;
  std::vector<size_t> corners;
  for (size_t i = 0; i < contacts.gap.size(); ++i)
    if (contacts.gap[i] > 0.0) corners.push_back(i);
  ASSERT_EQ(corners.size(), 4u);
  const auto is_outer = [&](size_t i) { return contacts.point[i].norm() > 7.5; };  // of 10 and 11 m, less 3
  const auto is_upper = [&](size_t i) { return contacts.point[i].z() > 0.1; };
  for (const size_t i : corners) contacts.gap[i] = !is_outer(i) ? -1.0 : is_upper(i) ? -1e-3 : 1e-3;
  const std::vector<ShellCrack> cracks = shell_cracks(e.assembly, contacts, e.last.joints, e.axes);
  ASSERT_EQ(cracks.size(), 1u);
  EXPECT_NEAR(cracks[0].length, 0.5 * 0.02 * 11.0, 1e-3);  // the chord is not quite along the trace
}

// Joints next to each other in one course are two cracks, and what is below a fiftieth of the widest is left
// out.
TEST(ShellCracks, DoNotRunAlongACourse) {
  const std::vector<ShellCrack> cracks =
      Vault({{{0, 1}, {2e-3, 4e-3}}, {{0, 2}, {2e-3, 4e-3}}, {{3, 6}, {7e-5, 7e-5}}}).cracks();
  ASSERT_EQ(cracks.size(), 2u);
  EXPECT_EQ(cracks[0].joints.size(), 1u);
}

// A gap between two leaves is within the thickness: at neither face, nor through it.
TEST(ShellCracks, BetweenLayersReachNoFace) {
  Vault vault(two_cracks());
  for (JointWrench& joint : vault.evaluation().last.joints.wrenches)
    if (joint.kind == JointKind::head) joint.kind = JointKind::wythe;
  for (const ShellCrack& crack : vault.cracks()) {
    EXPECT_EQ(crack.course, CrackCourse::layers);
    EXPECT_GT(crack.width, 0.0);
    EXPECT_EQ(crack.width_inner, 0.0);
    EXPECT_EQ(crack.width_outer, 0.0);
    EXPECT_FALSE(crack.through);
  }
}

// One length of cracks: that of cracks.csv, of the first screen and of summary.json, along the shell. The
// largest distances between open points, with the depth of the joints, are 1.006 m of each joint here.
TEST(ShellCracks, HaveOneLengthEverywhere) {
  Vault vault(two_cracks());
  Evaluation& e = vault.evaluation();
  e.last.frame.role = FrameRole::equilibrium;
  e.summary.status = Status::stable;
  e.joint_cracks = cracks_of(e.last.frame.contacts, e.last.joints);
  e.cracks = vault.cracks();
  const PostSummary s = post_summary(e);
  EXPECT_EQ(s.crack_length_m.value(), e.cracks[0].length + e.cracks[1].length);
  EXPECT_EQ(s.widest_crack_m.value(), 5e-3);
  EXPECT_NEAR(s.crack_length_m.value(), 6 * 0.02 * 10.5, 0.1) << "the chords of the courses are longer";
  EXPECT_NE(crack_answer(e).value().detail().find(fmt::format("{:.3g} m long", *s.crack_length_m)),
            std::string::npos)
      << crack_answer(e).value().detail();
}

// Cracks and open joints are counted alike on the first screen: the hairline is in no crack.
TEST(ShellCracks, TheFirstScreenTellsHairlinesFromCracks) {
  std::map<std::pair<int, int>, Gap> gaps = two_cracks();
  std::optional<double> relative;
  const auto said = [&gaps, &relative] {
    Vault vault(gaps);
    Evaluation& e = vault.evaluation();
    e.last.frame.role = FrameRole::equilibrium;
    e.summary.status = Status::stable;
    e.joint_cracks = cracks_of(e.last.frame.contacts, e.last.joints);
    e.cracks = vault.cracks();
    e.scene.joints.compliance.relative = relative;
    return crack_answer(e).value().detail();
  };
  EXPECT_NE(said().find("; 6 joints are open; they form 2 cracks, 1"), std::string::npos) << said();
  EXPECT_EQ(said().find("default stiffness"), std::string::npos) << said();
  relative = Compliance::kRelative;
  EXPECT_NE(said().find("; by the default stiffness of the joints"), std::string::npos) << said();
  gaps[{3, 6}] = {7e-5, 7e-5};
  EXPECT_NE(said().find("; 7 joints are open; 6 of them, wider than 2 % of the widest, form 2 cracks, 1"),
            std::string::npos)
      << said();
}

/// The unrolled vault, each block as long as its head joints are apart.
ShellMap unrolled() {
  ShellMap map;
  map.vault = true;
  map.num_rings = kRings;
  for (int ring = 0; ring < kRings; ++ring)
    for (int slot = 0; slot < kBlocks; ++slot) {
      const double from = 45.0 * (slot + (ring % 2 ? 0.5 : 0.0));
      ShellBox& box = map.boxes.emplace_back();
      box.block = ring * kBlocks + slot;
      box.ring = ring;
      box.from = from;
      box.to = from + 45.0;
    }
  return map;
}

// Crack 0 is widest in ring 1, at 67.5 degrees, and crack 1 in ring 2, at 225 degrees.
TEST(ShellCracks, HaveTheirNumbersOnTheMap) {
  Vault vault(two_cracks());
  Evaluation& e = vault.evaluation();
  e.cracks = vault.cracks();
  e.joint_cracks = cracks_of(e.last.frame.contacts, e.last.joints);
  const std::string commands = crack_map(e, unrolled()).commands;
  EXPECT_NE(commands.find("$numbers << EOD\n67.5 1 0 1 0 \n225 2 0 1 1 \nEOD"), std::string::npos)
      << commands;
}

std::string written(const std::string& text) {
  const std::string path = test::fresh_folder("observed") + "/seen.csv";
  std::filesystem::create_directories(std::filesystem::path(path).parent_path());
  std::ofstream(path) << text;
  return path;
}

// Places at 45, 135, 225 and 315 degrees. The first crack has the volume (4 + 5 + 4 + 3 + 2 + 2 + 1 + 1) mm,
// the second 3 mm times the area of two points each; 60 and 40 % were seen.
TEST(ObservedCracks, AgreeByTheOverlapOfTheirShares) {
  Vault vault(two_cracks());
  vault.evaluation().scene.postproc.observed =
      written("azimuth_deg,width_m\n45,0.006\n135,0\n225,0.004\n315,0\n");
  const CrackAgreement found = crack_agreement(vault.evaluation()).value();
  ASSERT_EQ(found.places.size(), 4u);
  const double first = 22.0 / 25.0;
  EXPECT_NEAR(found.places[0].model_share, first, 1e-12);
  EXPECT_NEAR(found.agreement, 0.6 + (1.0 - first), 1e-12);
  EXPECT_NEAR(found.by_chance, 0.25 + 0.25, 1e-12);
  EXPECT_EQ(found.places[0].model_width, 5e-3);
}

// The vault as part of a building whose origin is elsewhere: azimuths are about the axis of the vault.
TEST(ObservedCracks, AreAboutTheAxisOfTheVault) {
  Vault vault(two_cracks());
  Evaluation& e = vault.evaluation();
  e.scene.postproc.observed = written("azimuth_deg,width_m\n45,0.006\n135,0\n225,0.004\n315,0\n");
  const double agreement = crack_agreement(e).value().agreement, azimuth = vault.cracks()[0].azimuth;
  EXPECT_NEAR(azimuth * kDegrees, 56.25, 5.0) << "between the head joints of even and odd courses";
  vault.move(Vec3(40.0, 25.0, 3.0));
  EXPECT_NEAR(crack_agreement(e).value().agreement, agreement, 1e-12);
  EXPECT_NEAR(vault.cracks()[0].azimuth, azimuth, 1e-12) << "rounding of coordinates of 50 m";
}

// A joint at 45 degrees is as near to the place at 0 as to that at 90, whatever the rounding of its azimuth.
TEST(ObservedCracks, BetweenTwoPlacesCountHalfForEach) {
  Vault vault({{{0, 1}, {2e-3, 4e-3}}});
  vault.evaluation().scene.postproc.observed = written("azimuth_deg,width_m\n0,0.006\n90,0\n180,0\n270,0\n");
  const CrackAgreement found = crack_agreement(vault.evaluation()).value();
  for (const int place : {0, 1}) {
    EXPECT_NEAR(found.places[place].model_share, 0.5, 1e-12);
    EXPECT_EQ(found.places[place].model_width, 4e-3);
  }
  EXPECT_NEAR(found.agreement, 0.5, 1e-12);
}

}  // namespace
}  // namespace cupola::shell_cracks_test

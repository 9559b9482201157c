#include "solver/analysis/statics/length_control.hpp"

#include <algorithm>
#include <cmath>

#include "assembly/base/error.hpp"
#include "tests/solver/analysis/path_run.hpp"

// Paths whose length is given and whose loads are found: descending branches under forces.

namespace cupola::length_control_test {
namespace {

using path_test::PathResult;
using path_test::run;

struct RootCase {
  const char* name;
  std::function<double(double)> f;
  double root;
};

TEST(FindRoot, OfElasticPlasticAndStepLikeFunctions) {
  const RootCase cases[] = {
      {"linear", [](double x) { return x - 0.3; }, 0.3},
      {"falls from the guess", [](double x) { return x - 0.003; }, 0.003},
      {"kink from slope 1 to 1e6", [](double x) { return x < 0.6 ? x - 0.6 - 1e-3 : 1e6 * (x - 0.6) - 1e-3; },
       0.6 + 1e-9},
      {"kink on the other side", [](double x) { return x < 0.6 ? 1e6 * (x - 0.6) + 0.01 : x - 0.59; },
       0.6 - 1e-8},
      {"jump", [](double x) { return x < 0.7 ? -1.0 : 2.0; }, 0.7},
  };
  for (const RootCase& c : cases) {
    int calls = 0;
    double last = 0.0;
    const std::optional<double> root = find_root({0.0, 1.0, 0.05, 0.01, 0.0, 1e-9}, [&](double x) {
      ++calls;
      last = x;
      return std::optional(c.f(x));
    });
    ASSERT_TRUE(root) << c.name;
    EXPECT_NEAR(*root, c.root, 1e-8) << c.name;
    EXPECT_EQ(*root, last) << c.name << ": the caller keeps what it computed last";
    EXPECT_LE(calls, 80) << c.name;
  }
}

TEST(FindRoot, StopsAtBoundsAndFailures) {
  const auto at = [](double guess, double root) {
    return find_root({0.0, 1.0, guess, 0.01, 0.0, 1e-9}, [=](double x) { return std::optional(x - root); });
  };
  EXPECT_EQ(at(0.5, 2.0), 1.0);
  EXPECT_EQ(at(0.5, -2.0), 0.0);
  EXPECT_EQ(at(3.0, 1.0), 1.0) << "a guess beyond the bounds";
  EXPECT_FALSE(find_root({0.0, 1.0, 0.5, 0.01, 0.0, 1e-9},
                         [](double x) { return x > 0.6 ? std::nullopt : std::optional(x - 2.0); }));
}

constexpr double kCohesion = 3.5e5, kEnergy = 100.0;   // Pa, N/m
constexpr double kBroken = 2.0 * kEnergy / kCohesion;  // m, slip
constexpr double kStiff = 1e-11, kSoft = 5e-9;  // m3/N, in shear, of the joint that breaks and of the base
constexpr double kFriction = 0.75, kFullLoad = 1.5e5;    // N
constexpr double kArea = 0.2;                            // m2
constexpr double kWeight = 0.04 * 1000.0 * testing::kG;  // N, of a block

Case softening_case(int steps, double length) {
  Case scene = testing::make_case(kFriction, 0.0, 0.01);
  scene.joints.compliance = {kStiff, kStiff, Compliance::Per::area};
  scene.joints.strength = {2.5e5, kCohesion};
  scene.joints.failure = JointFailure::softening;
  scene.joints.fracture_energy = {20.0, kEnergy};
  scene.analysis.type = AnalysisType::path;
  scene.analysis.friction_law = FrictionLaw::coulomb;
  scene.analysis.tolerance = 1e-6;
  scene.analysis.path.steps = steps;
  scene.analysis.path.length = length;
  return scene;
}

/// A force in the plane of their bed pushes the upper of two blocks, of which the lower stands on a base that
/// is soft in shear. The bed softens. Blocks: floor, lower, upper.
Assembly soft_couplet() {
  return testing::make_boxes({{.center = {0, 0, -0.5}, .size = {3, 3, 1}, .fixed = true},
                              {.center = {0, 0, 0.1}, .size = {1, 0.2, 0.2}, .ring = 0},
                              {.center = {0, 0, 0.3}, .size = {1, 0.2, 0.2}, .ring = 1}});
}

Case soft_couplet_case(int steps) {
  Case scene = softening_case(steps, 1.25 * kBroken);
  scene.joints.base.emplace();
  scene.joints.base->tension = scene.joints.base->cohesion = 1e9;
  scene.joints.base->normal = 1e-13;
  scene.joints.base->tangential = kSoft;
  scene.loads.forces.push_back({BlockRef{2}, Vec3(0, 0, 0.2), Vec3(kFullLoad, 0, 0), RampInTime{}});
  scene.analysis.path.control = LoadPath::Control{BlockRef{2}, BlockRef{1}, Vec3::UnitX()};
  return scene;
}

/// Cohesive force of a bed whose slip grows from `before` to `slip`, m: the mean over the step of c A (1 - s
/// / s_c), which is 0 from s_c on.
double softened(double before, double slip) {
  const auto work = [](double s) {
    const double share = std::min(1.0, s / kBroken);
    return kEnergy * kArea * share * (2.0 - share);
  };
  return (work(slip) - work(before)) / (slip - before);
}

// The lower block springs back farther than the bed slips while it softens: c_soft c > s_c. Under growing
// forces it would break suddenly, and under a growing displacement of the upper block as well. Relative to
// the lower block, slip = displacement - c_stiff tau.
TEST(LengthControl, FollowsTheSnapBackOfASofteningBedOnASoftBase) {
  const Assembly assembly = soft_couplet();
  const double friction = kFriction * kWeight, peak = kCohesion * kArea;
  for (const int steps : {7, 20, 50}) {
    const PathResult result = run(soft_couplet_case(steps), assembly);
    ASSERT_TRUE(stands(result.summary.status)) << result.summary.message;
    ASSERT_EQ(result.rows.size(), static_cast<size_t>(steps) + 1);
    double slipped = 0.0, upper = 0.0, farthest = 0.0;
    for (size_t k = 1; k < result.rows.size(); ++k) {
      const double force = kFullLoad * result.rows[k][0];
      EXPECT_NEAR(result.rows[k][2], force, 1e-6 * force);
      const double slip = result.rows[k][1] - kStiff * force / kArea;
      EXPECT_NEAR(force, friction + softened(slipped, slip), 1e-3 * peak) << steps << " row " << k;
      EXPECT_NEAR(result.rows[k][1], static_cast<double>(k) * 1.25 * kBroken / steps, 0.1 * kBroken / steps);
      slipped = slip;
      upper = result.frames[k].blocks.displacement[2].x();
      farthest = std::max(farthest, upper);
      // The shear of the base, and that of the bed.
      EXPECT_NEAR(upper, kSoft * force / kArea + result.rows[k][1], 0.01 * kSoft * peak / kArea);
    }
    EXPECT_LT(upper, 0.6 * farthest) << "the upper block has come back";
    EXPECT_NEAR(kFullLoad * result.rows.back()[0], friction, 1e-3 * peak);
    EXPECT_NEAR(result.rows.back()[3] - friction * slipped, kEnergy * kArea, 0.01 * kEnergy * kArea) << steps;
  }
}

// Coulomb's law: the shear falls from c A + mu N to mu N along the slip, and the work beyond friction is the
// fracture energy.
Case pushed_case(int steps, double pressure, double length) {
  Case scene = softening_case(steps, length);
  scene.loads.forces.push_back({BlockRef{1}, Vec3(0, 0, 0.1), Vec3(0, 0, -pressure * kArea), {}});
  scene.loads.forces.push_back({BlockRef{1}, Vec3(0, 0, 0), Vec3(kFullLoad, 0, 0), RampInTime{}});
  scene.analysis.path.control = LoadPath::Control{BlockRef{1}, {}, Vec3::UnitX()};
  return scene;
}

TEST(LengthControl, FollowsTheSofteningOfAShearedBedUnderItsOwnForce) {
  const Assembly assembly = testing::box_on_floor({1.0, 0.2, 0.2});
  const double peak = kCohesion * kArea;
  for (const double pressure : {0.0, 2e5}) {
    const double friction = kFriction * (pressure * kArea + kWeight);
    for (const int steps : {7, 20, 50}) {
      const PathResult result = run(pushed_case(steps, pressure, 1.2 * kBroken), assembly);
      ASSERT_TRUE(stands(result.summary.status)) << result.summary.message;
      double slipped = 0.0;
      for (size_t k = 1; k < result.rows.size(); ++k) {
        const double force = kFullLoad * result.rows[k][0];
        const double slip = result.rows[k][1] - kStiff * force / kArea;
        EXPECT_NEAR(force, friction + softened(slipped, slip), 1e-3 * peak) << steps << " row " << k;
        slipped = slip;
      }
      EXPECT_NEAR(kFullLoad * result.rows.back()[0], friction, 1e-3 * peak);
      EXPECT_NEAR(result.rows.back()[3] - friction * slipped, kEnergy * kArea, 0.01 * kEnergy * kArea);
    }
  }
}

/// A dry block that a horizontal force at its centre tilts about its edge.
Case tilting_case(double weight, int steps, double length) {
  Case scene = testing::make_case(0.8, 1e-10, 0.01);
  scene.loads.forces.push_back({BlockRef{1}, Vec3(0, 0, 0.5), Vec3(weight, 0, 0), RampInTime{}});
  scene.analysis.type = AnalysisType::path;
  scene.analysis.tolerance = 1e-6;
  scene.analysis.path.steps = steps;
  scene.analysis.path.length = length;
  scene.analysis.path.control = LoadPath::Control{BlockRef{1}, {}, Vec3::UnitX()};
  return scene;
}

// F = W tan(asin(x_c / R)) with x_c the distance of the centre from the edge, which falls from the first
// moment on. Force and displacement of a row belong to one geometry: that at the start of a step of a fortieth
// has a force that is 0.01 W larger. 5e-4: the joint shortens, and turns of a step are added to first order.
TEST(LengthControl, FollowsABlockThatTiltsToItsUnstableBalance) {
  const Vec3 size(0.5, 0.4, 1.0);
  const double radius = 0.5 * std::hypot(size.x(), size.z());
  const Assembly assembly = testing::box_on_floor(size);
  const double weight = assembly.blocks[1].mass * testing::kG;
  const PathResult result = run(tilting_case(weight, 40, 0.2), assembly);
  ASSERT_TRUE(stands(result.summary.status)) << result.summary.message;
  double latest = 0.0;
  for (const auto& row : result.rows) latest = std::max(latest, row[0]);
  EXPECT_NEAR(result.summary.bears_loads_until_s.value_or(0.0), latest, 1e-9 * latest);  // nine digits
  for (size_t k = 1; k < result.rows.size(); ++k) {
    const double arm = 0.25 - result.rows[k][1];
    EXPECT_NEAR(result.rows[k][2], weight * arm / std::sqrt(radius * radius - arm * arm), 5e-4 * weight) << k;
  }
}

// At 0.25 m it balances by itself, and falls beyond: no force is left to hold it. 1 mm: its last step is a
// 64th of 20 mm, and the joint shortens.
TEST(LengthControl, EndsWhereTheLoadComesBackToNothing) {
  const Assembly assembly = testing::box_on_floor({0.5, 0.4, 1.0});
  const PathResult result = run(tilting_case(assembly.blocks[1].mass * testing::kG, 20, 0.4), assembly);
  EXPECT_TRUE(stands(result.summary.status)) << result.summary.message;
  EXPECT_NEAR(result.rows.back()[1], 0.25, 1e-3);
  EXPECT_TRUE(result.summary.bears_loads_until_s);
  EXPECT_NE(result.summary.message.find("the loads came back to those at 0 s"), std::string::npos)
      << result.summary.message;
}

TEST(LengthControl, EndsAtTheLatestTimeAndSaysSo) {
  Case scene = pushed_case(10, 2e5, 1.0);
  scene.loads.forces[1].force = Vec3(5e4, 0, 0);
  const PathResult result = run(scene, testing::box_on_floor({1.0, 0.2, 0.2}));
  EXPECT_EQ(result.summary.status, Status::stable);
  EXPECT_EQ(result.rows.back()[0], 1.0);
  EXPECT_FALSE(result.summary.bears_loads_until_s);
  EXPECT_NE(result.summary.message.find("the latest time, 1 s, came before the length of the path"),
            std::string::npos)
      << result.summary.message;
}

TEST(LengthControl, SaysThatTheControlMovesAgainstItsDirection) {
  Case scene = pushed_case(10, 2e5, 1e-3);
  scene.analysis.path.control->direction = -Vec3::UnitX();
  const PathResult result = run(scene, testing::box_on_floor({1.0, 0.2, 0.2}));
  EXPECT_EQ(result.summary.status, Status::unconverged);
  EXPECT_NE(result.summary.message.find("no time from 0 to 1 s gives the control displacement"),
            std::string::npos)
      << result.summary.message;
}

TEST(LengthControl, RefusesTheBlockItselfAsReference) {
  Case scene = soft_couplet_case(5);
  scene.analysis.path.control->relative_to = BlockRef{2};
  EXPECT_THROW(run(scene, soft_couplet()), InputError);
}

/// Interrupts at the `query`-th step, resumes from the checkpoint and compares all that was written.
void interrupt_and_resume(const Case& scene, const Assembly& assembly, int query) {
  std::string table, checkpoint;
  std::vector<Frame> frames;
  size_t frames_at_checkpoint = 0;
  AnalysisSinks sinks;
  sinks.frame = [&](const Frame& frame) { frames.push_back(frame); };
  sinks.table = [&](const std::string&, const std::string& text) { table = text; };
  const Summary whole = run_path(scene, assembly, sinks).value();
  const std::string whole_table = table;
  const std::vector<Frame> whole_frames = frames;

  frames.clear();
  int seen = 0;
  sinks.interrupted = [&] { return ++seen >= query; };
  sinks.checkpoint = [&](const std::string& bytes) {
    checkpoint = bytes;
    frames_at_checkpoint = frames.size();
  };
  ASSERT_FALSE(run_path(scene, assembly, sinks));
  frames.resize(frames_at_checkpoint);
  sinks.interrupted = [] { return false; };
  sinks.resume_from = checkpoint;
  const Summary resumed = run_path(scene, assembly, sinks).value();
  EXPECT_EQ(table, whole_table);
  EXPECT_EQ(resumed.message, whole.message);
  EXPECT_EQ(resumed.steps, whole.steps);
  EXPECT_EQ(resumed.accuracy.worst_over_run, whole.accuracy.worst_over_run);
  ASSERT_EQ(frames.size(), whole_frames.size());
  for (size_t i = 0; i < frames.size(); ++i) {
    ASSERT_EQ(frames[i].contacts.size(), whole_frames[i].contacts.size());
    for (int k = 0; k < frames[i].contacts.size(); ++k) {
      ASSERT_EQ(frames[i].contacts.force[k], whole_frames[i].contacts.force[k]) << "frame " << i;
      ASSERT_EQ(frames[i].contacts.damage[k], whole_frames[i].contacts.damage[k]) << "frame " << i;
    }
    for (int k = 0; k < frames[i].blocks.size(); ++k)
      ASSERT_EQ(frames[i].blocks.position[k], whole_frames[i].blocks.position[k]) << "frame " << i;
  }
}

TEST(Path, ResumesWithTheSameBits) {
  for (const int query : {1, 4, 10}) interrupt_and_resume(soft_couplet_case(10), soft_couplet(), query);
  Case by_time = soft_couplet_case(10);  // ends where the joint breaks
  by_time.analysis.path.length.reset();
  for (const int query : {2, 5}) interrupt_and_resume(by_time, soft_couplet(), query);
}

}  // namespace
}  // namespace cupola::length_control_test

#include "assembly/model/applied_loads.hpp"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include "assembly/base/error.hpp"
#include "assembly/case/limit_parameter.hpp"
#include "assembly/model/loads_on_top.hpp"
#include "tests/assembly/scene.hpp"

namespace cupola::applied_loads_test {
namespace {

std::string refusal_of(const Loads& loads, const Assembly& assembly) {
  try {
    applied_loads(loads, assembly);
  } catch (const InputError& error) {
    return error.what();
  }
  return "";
}

TEST(AppliedLoads, TopLoadIsDistributedByArea) {
  const Assembly assembly = test::two_block_assembly();
  Loads loads;
  loads.gravity = {0.0, 3.0, -4.0};
  loads.top_load = TopLoad{2.0};
  const std::vector<PointForce> forces = applied_loads(loads, assembly);
  ASSERT_EQ(forces.size(), 1u) << "one top face";
  EXPECT_EQ(forces[0].block, 1);
  // Twice the free block's weight, along gravity.
  const Vec3 expected = 2.0 * assembly.blocks[1].mass * loads.gravity;
  EXPECT_LE((forces[0].force - expected).norm(), 1e-15 * expected.norm());
}

TEST(AppliedLoads, ALanternWeighsItsNewtonsOrItsMass) {
  const Assembly assembly = test::two_block_assembly();
  Loads loads;
  loads.gravity = {0.0, 0.0, -5.0};
  loads.lantern = TopLoad{.weight = 120.0};
  EXPECT_EQ(applied_loads(loads, assembly).at(0).force.z(), -120.0);
  loads.lantern = TopLoad{.mass = 120.0};
  EXPECT_EQ(applied_loads(loads, assembly).at(0).force.z(), -600.0);
}

// A ramp of the dead load that left a fill out would lay all of it on stones without weight. A fill with a
// time of its own is laid on the finished vault. In a limit both keep their factors at the time 0.
TEST(AppliedLoads, AFillIsDeadLoadUnlessItHasATimeOfItsOwn) {
  Case scene;
  scene.loads.dead_load_time = RampInTime{0.2, 1.0, 0.0, 1.0};
  scene.loads.faces.resize(3);
  scene.loads.faces[0].fill = scene.loads.faces[1].fill = Fill{2.0, {}, 16000.0};
  scene.loads.faces[1].time = RampInTime{0.0, 1.0, 1.0, 1.0};
  const auto factors = [](const Loads& loads, double time) {
    std::vector<double> at;
    const std::vector<TimeFunction> times = load_times(loads);
    for (int i = 0; i < 3; ++i) at.push_back(load_factor(i, loads.dead_load_time, times, time));
    return at;
  };
  EXPECT_EQ(factors(scene.loads, 0.0), (std::vector{0.2, 0.0, 1.0}));
  EXPECT_EQ(factors(scene.loads, 1.0), (std::vector{1.0, 0.0, 1.0}));
  scene.analysis.limit.parameter = LimitSearch::Parameter::friction;
  EXPECT_EQ(factors(case_at(scene, 0.5).loads, 1.0), (std::vector{0.2, 0.0, 1.0}));
}

// Pushed sidewards by its own weight, a lantern of 120 N weighs as much downwards as before. Where 0.8 of the
// weight acts, the mass stays: inertia is that of all.
TEST(AppliedLoads, ALanternOfNewtonsIsAcceleratedWithTheRest) {
  Case scene;
  scene.loads.gravity = {0.0, 0.0, -5.0};
  scene.loads.lantern = TopLoad{.weight = 120.0};
  scene.analysis.limit.parameter = LimitSearch::Parameter::acceleration;
  scene.analysis.limit.direction = {1.0, 0.0, 0.0};
  for (const double share : {1.0, 0.8})
    for (const double g : {0.5, 1.0}) {
      scene.loads.dead_load_time = RampInTime{share, share, 0.0, 1.0};
      const Loads at = case_at(scene, g).loads;
      Vec3 force = Vec3::Zero();
      for (const PointForce& f : applied_loads(at, test::two_block_assembly()))
        force += load_factor(f.time, at.dead_load_time, load_times(at), 0.0) * f.force;
      EXPECT_LE((force - Vec3(g * 120.0, 0.0, -share * 120.0)).norm(), 1e-13) << "rounding of 120 N";
      const Vec3 of_blocks = factor_at(at.dead_load_time, 0.0) * at.gravity + at.pull;
      EXPECT_LE((of_blocks - Vec3(g * 5.0, 0.0, -share * 5.0)).norm(), 1e-14) << "of 5 m/s2";
    }
  scene.loads.dead_load_time = RampInTime{};
  EXPECT_THROW(case_at(scene, 1.0), InputError);
}

// A moment must move no centroid, and have no symmetric part: the mean stress of a block is the symmetric
// part of sum x f^T.
TEST(AppliedLoads, AMomentIsAPureCouple) {
  const Assembly assembly = test::two_block_assembly();
  Loads loads;
  loads.forces.push_back(
      {.block = 1, .point = {}, .force = {0, 0, 0}, .time = {}, .moment = Vec3(3.0, -4.0, 12.0)});
  Vec3 force = Vec3::Zero(), moment = Vec3::Zero();
  Mat3 virial = Mat3::Zero();
  for (const PointForce& f : applied_loads(loads, assembly)) {
    const Vec3 arm = f.point - assembly.blocks[1].centroid;
    force += f.force;
    moment += arm.cross(f.force);
    virial += arm * f.force.transpose();
  }
  EXPECT_LE(force.norm(), 1e-14);
  EXPECT_LE((moment - Vec3(3.0, -4.0, 12.0)).norm(), 1e-14);
  EXPECT_LE((virial + virial.transpose()).norm(), 1e-14);
}

TEST(AppliedLoads, PressureActsIntoTheBlock) {
  const Assembly assembly = test::two_block_assembly();
  Loads loads;
  FaceLoad& load = loads.faces.emplace_back();
  load.faces = FaceKind::top;
  load.traction = {0.0, 7.0, 0.0};
  load.pressure = 5.0;
  const std::vector<PointForce> forces = applied_loads(loads, assembly);
  ASSERT_EQ(forces.size(), 1u);
  const double area = 0.1 / 3.0;  // of the face from x = 0.1 to 0.2 and y = 0 to 1/3
  EXPECT_LE((forces[0].force - area * Vec3(0.0, 7.0, -5.0)).norm(), 1e-15);
  EXPECT_EQ(forces[0].time, 0);
}

TEST(AppliedLoads, LoadsWithoutABlockOrFaceAreRefused) {
  Assembly assembly = test::two_block_assembly();
  Loads loads;
  loads.forces.emplace_back().block = 2;
  EXPECT_EQ(refusal_of(loads, assembly),
            "error: loads.forces[0].block: block 2 does not exist: the assembly has blocks 0 to 1");
  loads.forces[0].block = 0;
  EXPECT_EQ(refusal_of(loads, assembly),
            "error: loads.forces[0].block: block 0 is fixed; apply the force to a free block");
  loads.forces.clear();
  loads.faces.emplace_back().faces = FaceKind::extrados;
  loads.faces[0].to_ring = 2;
  EXPECT_EQ(refusal_of(loads, assembly),
            "error: loads.faces[0]: no free block in rings 0 to 2 has faces of kind extrados; the model has: "
            "intrados (rings 0 to 0), top (rings 0 to 0)");
  loads.faces.clear();
  for (FaceKind& kind : assembly.face_kinds)
    if (kind == FaceKind::top) kind = FaceKind::free;
  loads.lantern = TopLoad{0.1};
  EXPECT_EQ(refusal_of(loads, assembly),
            fmt::format("error: loads.lantern: the assembly has no faces of kind top to carry it; give it to "
                        "the highest block as loads.forces: [{{block: 1, force: [0, 0, {:.6g}]}}]",
                        -0.1 * free_weight(assembly, 9.81)));
  loads.lantern = TopLoad{.mass = 100.0};
  loads.gravity.setZero();
  EXPECT_EQ(
      refusal_of(loads, assembly),
      "error: loads.lantern: the assembly has no faces of kind top to carry it, and no force stands for "
      "a mass without gravity");
}

// A limit seeks the lantern of an arch, which has no such key: the advice is another limit of the same number.
TEST(AppliedLoads, ALimitOfALanternRequiresATop) {
  Assembly assembly = test::two_block_assembly();
  EXPECT_NO_THROW(require_top_for_lantern(assembly, 10.0));
  for (FaceKind& kind : assembly.face_kinds)
    if (kind == FaceKind::top) kind = FaceKind::free;
  try {
    require_top_for_lantern(assembly, 10.0);
    ADD_FAILURE();
  } catch (const InputError& error) {
    EXPECT_NE(std::string(error.what()).find("analysis.limit.parameter: lantern requires faces of kind top"),
              std::string::npos)
        << error.what();
    EXPECT_NE(
        std::string(error.what())
            .find(fmt::format("loads.forces: [{{block: 1, force: [0, 0, {:.6g}]}}] and limit.parameter: load",
                              -free_weight(assembly, 10.0))),
        std::string::npos)
        << error.what();
  }
}

}  // namespace
}  // namespace cupola::applied_loads_test

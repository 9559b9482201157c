// Time of contact detection: from scratch, with nothing moved, with contacts updated, and detected again
// after a motion.

#include <benchmark/benchmark.h>

#include "assembly/program/program.hpp"
#include "generators/generate.hpp"
#include "solver/collision/contact_detector.hpp"

namespace cupola {
namespace {

Assembly herringbone_dome() {
  Case scene;
  scene.geometry.bond = HerringboneBond{};
  return cut_assembly(scene);  // 1,296 blocks in 3,840 cells
}

/// A wall of rings x blocks_per_ring blocks of 0.24 x 1 x 0.06 m.
Assembly wall(int rings, int blocks_per_ring) {
  Case scene;
  RunningBond bond;
  bond.rings = rings;
  bond.blocks_per_ring = blocks_per_ring;
  bond.slices_per_block = 2;
  scene.geometry.surface = WallSurface{0.24 * blocks_per_ring, 0.06 * rings, 1.0};
  scene.geometry.bond = bond;
  return cut_assembly(scene);
}

/// All rows of the table need the same counters.
void set_counters(const Assembly& assembly, std::size_t contacts, benchmark::State* state) {
  state->counters["blocks"] = static_cast<double>(assembly.blocks.size());
  state->counters["contacts"] = static_cast<double>(contacts);
}

void from_scratch(benchmark::State& state, const Assembly& assembly) {
  const auto poses = initial_poses(assembly);
  std::size_t contacts = 0;
  for (auto _ : state) contacts = ContactDetector(assembly, {}).update(poses).points.size();
  set_counters(assembly, contacts, &state);
}

void DomeFromScratch(benchmark::State& state) {
  from_scratch(state, herringbone_dome());
}
void WallFromScratch(benchmark::State& state) {
  const int rings = static_cast<int>(state.range(0));
  from_scratch(state, wall(rings, rings));
}

void DomeUnmoved(benchmark::State& state) {
  const Assembly assembly = herringbone_dome();
  const auto poses = initial_poses(assembly);
  ContactDetector detector(assembly, {});
  const std::size_t contacts = detector.update(poses).points.size();
  for (auto _ : state) benchmark::DoNotOptimize(detector.update(poses).points.data());
  set_counters(assembly, contacts, &state);
}

/// All blocks move up and down in turn by `step` times the margin. Below a quarter of the margin the contacts
/// are updated without a new detection.
void dome_moving(benchmark::State& state, double step) {
  const Assembly assembly = herringbone_dome();
  const auto rest = initial_poses(assembly);
  ContactDetector detector(assembly, {});
  const std::size_t contacts = detector.update(rest).points.size();
  auto moved = rest;
  bool up = true;
  for (auto _ : state) {
    for (std::size_t b = 0; b < moved.size(); ++b)
      moved[b].p_WB.z() = rest[b].p_WB.z() + (up ? step * detector.margin() : 0.0);
    up = !up;
    benchmark::DoNotOptimize(detector.update(moved).points.data());
  }
  set_counters(assembly, contacts, &state);
}

void DomeContactsUpdated(benchmark::State& state) {
  dome_moving(state, 0.1);
}
void DomeDetectedAgain(benchmark::State& state) {
  dome_moving(state, 0.5);
}

BENCHMARK(DomeFromScratch)->Unit(benchmark::kMillisecond);
BENCHMARK(DomeUnmoved)->Unit(benchmark::kMillisecond);
BENCHMARK(DomeContactsUpdated)->Unit(benchmark::kMillisecond);
BENCHMARK(DomeDetectedAgain)->Unit(benchmark::kMillisecond);
BENCHMARK(WallFromScratch)->Arg(71)->Arg(316)->Unit(benchmark::kMillisecond);  // 5,000 and 100,000 blocks

}  // namespace
}  // namespace cupola

int main(int argc, char** argv) {
  cupola::keep_freed_memory();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
}

// Time of generation with all its checks, which grows linearly with the number of blocks, and of splitting
// non-convex blocks.

#include <benchmark/benchmark.h>

#include "assembly/base/process.hpp"
#include "assembly/program/program.hpp"
#include "generators/decomposition/decompose.hpp"
#include "generators/generate.hpp"
#include "tests/generators/meshes.hpp"

namespace cupola {
namespace {

void generate_and_check(benchmark::State& state, const Case& scene) {
  std::size_t blocks = 0;
  for (auto _ : state) blocks = generate(scene).blocks.size();
  state.counters["blocks"] = static_cast<double>(blocks);
  state.counters["peak_MB"] = static_cast<double>(peak_memory_bytes()) / 1e6;
}

void HerringboneDome(benchmark::State& state) {
  Case scene;
  scene.geometry.bond = HerringboneBond{};
  generate_and_check(state, scene);
}

/// The final model of the paper with every course divided into n = `state.range` courses: 1,296 x n^2 blocks.
void Brunelleschi(benchmark::State& state) {
  Case scene;
  scene.geometry.surface = OctagonalVault{};
  HerringboneBond bond;
  bond.refine = static_cast<int>(state.range(0));
  scene.geometry.bond = bond;
  generate_and_check(state, scene);
}

/// A dome with n = `state.range` rings of n blocks, two cells each.
void RunningDome(benchmark::State& state) {
  Case scene;
  const int n = static_cast<int>(state.range(0));
  scene.geometry.bond = RunningBond{n, n, 2, {}};
  generate_and_check(state, scene);
}

void Wall(benchmark::State& state) {
  Case scene;
  const int n = static_cast<int>(state.range(0));
  scene.geometry.surface = WallSurface{0.24 * n, 0.06 * n, 1.0};
  scene.geometry.bond = RunningBond{n, n, 2, {}};
  generate_and_check(state, scene);
}

void SplitCross(benchmark::State& state) {
  const TriangleMesh mesh = repair_mesh(prism(cross_shape(), 1.0), 1e-6);
  for (auto _ : state) benchmark::DoNotOptimize(decompose(mesh, "cross").parts.data());
}

void SplitCrossByNef(benchmark::State& state) {
  const TriangleMesh mesh = repair_mesh(prism(cross_shape(), 1.0), 1e-6);
  for (auto _ : state) benchmark::DoNotOptimize(decompose_by_nef(mesh).data());
}

BENCHMARK(HerringboneDome)->Unit(benchmark::kMillisecond);
BENCHMARK(Brunelleschi)->Arg(1)->Arg(3)->Arg(8)->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK(RunningDome)->Arg(36)->Arg(100)->Arg(317)->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK(Wall)->Arg(100)->Arg(317)->Unit(benchmark::kMillisecond)->Iterations(1);
BENCHMARK(SplitCross)->Unit(benchmark::kMicrosecond);
BENCHMARK(SplitCrossByNef)->Unit(benchmark::kMicrosecond);

}  // namespace
}  // namespace cupola

int main(int argc, char** argv) {
  cupola::keep_freed_memory();
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv)) return 1;
  benchmark::RunSpecifiedBenchmarks();
}

// SPDX-License-Identifier: BSD-3-Clause
// Rays per second of scans of the built-in scenes.
#include <pcl6d/scanner/driven_scanner.h>
#include <pcl6d/simulation/simulator.h>

#include <benchmark/benchmark.h>

#include <string>

namespace {
using pcl6d::Simulator;

void
BM_Scan(benchmark::State& state, const char* name) // one scan, with all its errors
{
  const auto scene = pcl6d::builtInScene(name);
  pcl6d::SimulationOptions options;
  options.num_scans = 16;
  options.range.max_range = scene.max_range;
  options.range.num_threads = static_cast<unsigned>(state.range(0));
  const Simulator simulator(scene, options);
  std::size_t scan = 0;
  std::int64_t rays = 0;
  for (auto _ : state) {
    const auto samples = simulator.rangeScan(scan++ % simulator.size());
    rays += static_cast<std::int64_t>(samples.samples.size());
    benchmark::DoNotOptimize(samples.samples.data());
  }
  state.SetItemsProcessed(rays);
  state.counters["triangles"] = static_cast<double>(scene.geometry.triangles.size());
}

void
BM_Build(benchmark::State& state, const char* name) // scene, search tree, path
{
  for (auto _ : state) {
    const Simulator simulator(pcl6d::builtInScene(name), {});
    benchmark::DoNotOptimize(&simulator);
  }
}

void
addAll()
{
  for (const char* name : {"corridor", "rooms", "multilevel", "mine", "campus"}) {
    benchmark::RegisterBenchmark(
        (std::string("scan/") + name).c_str(),
        [name](benchmark::State& state) { BM_Scan(state, name); })
        ->ArgName("threads")
        ->Arg(1)
        ->Arg(2)
        ->UseRealTime()
        ->Unit(benchmark::kMillisecond);
    benchmark::RegisterBenchmark(
        (std::string("build/") + name).c_str(),
        [name](benchmark::State& state) { BM_Build(state, name); })
        ->Unit(benchmark::kMillisecond);
  }
}
} // namespace

int
main(int argc, char** argv)
{
  benchmark::Initialize(&argc, argv);
  if (benchmark::ReportUnrecognizedArguments(argc, argv))
    return 1;
  addAll();
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

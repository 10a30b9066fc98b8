// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/pose.h>
#include <pcl6d/common/random.h>
#include <pcl6d/graph_relaxation/error_diffusion.h>

#include <benchmark/benchmark.h>

namespace pcl6d::benchmarks {

namespace {
/** Closes a loop over a chain of poses with further links between any two of them. */
void
closeLoopByElch(benchmark::State& state)
{
  const auto num_poses = static_cast<std::size_t>(state.range(0));
  Random random(1);
  const auto any = [&] {
    return static_cast<std::size_t>(random.uniform() * num_poses);
  };
  std::vector<Eigen::Isometry3d> poses;
  std::vector<LoopEdge> edges;
  const auto link = [&](std::size_t a, std::size_t b) {
    edges.push_back({a, b, PerDimension::Constant(random.uniform(0.5, 2))});
  };
  for (std::size_t i = 0; i < num_poses; ++i) {
    poses.push_back(poseFromEuler({1.0 * i, 0, 0}, {0, 0, 0.001 * i}));
    if (i > 0)
      link(i - 1, i);
  }
  while (edges.size() < num_poses - 1 + state.range(1))
    if (const std::size_t a = any(), b = any(); a != b)
      link(a, b);
  const Loop loop{0,
                  num_poses - 1,
                  poses.back() * poseFromEuler({1, 2, 3}, {0.1, 0.1, 0.1}),
                  PerDimension::Ones()};
  for (auto _ : state)
    benchmark::DoNotOptimize(closeLoop(poses, edges, loop).poses.data());
}
BENCHMARK(closeLoopByElch)
    ->ArgNames({"poses", "links"})
    ->Args({1000, 0})
    ->Args({1000, 2000})
    ->Args({10000, 0})
    ->Args({10000, 20000})
    ->Args({10000, 90000})
    ->Unit(benchmark::kMillisecond);
} // namespace

} // namespace pcl6d::benchmarks

BENCHMARK_MAIN();

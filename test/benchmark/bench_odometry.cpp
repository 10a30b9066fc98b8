// SPDX-License-Identifier: BSD-3-Clause
// Tracking of simulated sweeps with motion inside: processor time per sweep, one thread.
#include <pcl6d/common/pose.h>
#include <pcl6d/odometry/sweep_tracker.h>
#include <pcl6d/scanner/scanner_presets.h>
#include <pcl6d/simulation/simulator.h>

#include <benchmark/benchmark.h>

#include <string>
#include <vector>

namespace {
constexpr int kSweeps = 60;

struct Drive {
  std::vector<pcl6d::Sweep> sweeps;
  std::vector<Eigen::Isometry3d> truth;
};

Drive
makeDrive(const std::string& world, const std::string& scanner, double speed)
{
  const pcl6d::ScannerPreset preset = pcl6d::scannerByName(scanner);
  pcl6d::SimulationOptions options;
  options.num_scans = kSweeps;
  options.scanner = preset.scanner;
  options.range = preset.range;
  options.motion = pcl6d::ScanMotion::kContinuous;
  options.speed = speed;
  options.period = preset.scanner->duration();
  const pcl6d::Simulator simulator(pcl6d::builtInScene(world), options);
  Drive drive;
  drive.truth = simulator.truth().poses;
  for (std::size_t i = 0; i < simulator.size(); ++i) {
    pcl6d::Sweep sweep;
    sweep.points = pcl6d::toPoints(simulator.scan(i));
    for (int line = 0; line < preset.scanner->numLines(); ++line)
      for (int sample = 0; sample < preset.scanner->samplesPerLine(); ++sample)
        sweep.times.push_back(preset.scanner->time(line, sample));
    sweep.stamp = simulator.truth().stamps[i];
    drive.sweeps.push_back(std::move(sweep));
  }
  return drive;
}

void
BM_TrackSweeps(benchmark::State& state, const Drive& drive)
{
  pcl6d::SweepTrackerOptions options;
  options.num_threads = 1;
  double error = 0;
  std::size_t bytes = 0;
  for (auto _ : state) {
    pcl6d::SweepTracker tracker(options);
    Eigen::Isometry3d last;
    for (const pcl6d::Sweep& sweep : drive.sweeps)
      last = tracker.track(sweep).T_world_sweep;
    const auto way = drive.truth.front().inverse() * drive.truth.back();
    error = pcl6d::distanceBetween(way, last).translation;
    bytes = tracker.mapBytes();
  }
  state.SetItemsProcessed(state.iterations() * kSweeps); // sweeps per second
  state.counters["error_mm"] = 1000 * error;             // at the end of the drive
  state.counters["map_MB"] = static_cast<double>(bytes) / 1e6;
}
} // namespace

int
main(int argc, char** argv)
{
  benchmark::Initialize(&argc, argv);
  std::vector<Drive> drives;
  drives.reserve(4); // kept by reference
  for (const std::string world : {"corridor", "campus"})
    for (const std::string scanner : {"vlp16", "ouster"}) {
      drives.push_back(makeDrive(world, scanner, world == "campus" ? 8 : 1.5));
      benchmark::RegisterBenchmark(
          ("track/" + world + "/" + scanner).c_str(), BM_TrackSweeps, drives.back())
          ->Unit(benchmark::kMillisecond);
    }
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}

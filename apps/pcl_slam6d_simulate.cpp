// SPDX-License-Identifier: BSD-3-Clause
// Scans of a built-in scene with drifting odometry and exact truth.
#include "common/app.h"
#include "common/process/interrupt.h"
#include "common/progress_bar.h"
#include "simulate/body_words.h"
#include "simulate/intrude.h"
#include "simulate/settings.h"
#include "simulate/simulated_folder.h"
#include "simulate/truth_files.h"

#include <pcl6d/io/json_numbers.h>
#include <pcl6d/io/pcd_io.h>
#include <pcl6d/io/scan_name.h>
#include <pcl6d/io/trajectory_io.h>
#include <pcl6d/scanner/scanner_presets.h>
#include <pcl6d/simulation/simulator.h>

#include <pcl/conversions.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdio>
#include <filesystem>
#include <iostream>

namespace {
namespace fs = std::filesystem;
using namespace pcl6d;

using app::kSimulate;
using app::SimulateSettings;

void
writeSceneFile(const fs::path& path,
               const SimulateSettings& s,
               const SimulationScene& scene,
               const Simulator& simulator)
{
  nlohmann::ordered_json json = {{"schema_version", 1},
                                 {"generator", kSimulate},
                                 {"scene", s.scene.name},
                                 {"seed", s.simulation.seed},
                                 {"scans", s.simulation.num_scans},
                                 {"scanner", s.scanner},
                                 {"noise", s.simulation.range.noise}};
  if (s.simulation.last)
    json["last"] = *s.simulation.last;
  if (s.simulation.motion == ScanMotion::kContinuous)
    json["motion"] = app::describeMotion(s, simulator.speed());
  if (s.odometry != SimulateSettings().odometry)
    json["odometry"] = s.odometry;
  if (s.resolution)
    json["resolution"] = *s.resolution;
  if (s.exact)
    json["exact"] = true;
  if (s.simulation.range.max_range != RangeOptions().max_range)
    json["max_range"] = s.simulation.range.max_range;
  if (s.traffic.people + s.traffic.cars > 0)
    json["traffic"] = {{"people", s.traffic.people}, {"cars", s.traffic.cars}};
  app::describeScene(s.scene, scene, json);
  if (!scene.moving.empty())
    json["bodies"] =
        app::describeBodies(scene.moving, simulator.sceneFromWorld().inverse());
  writeJson(path, json, 2);
}

/** \return T_world_scan every 10 ms of each scan, with its begin and end; less often
 * beyond a million poses */
Trajectory
motionWithinScans(const Simulator& simulator)
{
  constexpr double kStep = 0.01; // [s]
  constexpr double kMostRows = 1e6;
  constexpr double kSame = 1e-6; // [s]
  const double duration = simulator.scanner().duration();
  const double most = kMostRows / static_cast<double>(simulator.size());
  const auto steps = static_cast<int>(std::ceil(std::min(duration / kStep, most)));
  Trajectory motion;
  for (std::size_t i = 0; i < simulator.size(); ++i)
    for (int k = 0; k <= steps; ++k) {
      const double time = duration * k / steps;
      const double stamp = simulator.truth().stamps[i] + time;
      if (!motion.stamps.empty() && stamp < motion.stamps.back() + kSame)
        continue; // the end of one sweep is the begin of the next
      motion.stamps.push_back(stamp);
      motion.poses.push_back(simulator.scanPose(i, time));
    }
  return motion;
}

/** \brief A scan in output format, counted on the way. */
pcl::PCLPointCloud2
cloudOf(const SimulateSettings& s,
        const Simulator& simulator,
        std::size_t i,
        TruthCounts& counts)
{
  pcl::PCLPointCloud2 cloud;
  const RangeScan scan = simulator.rangeScan(i);
  pcl::toPCLPointCloud2(toPointCloud(scan, simulator.scanner()), cloud);
  if (s.simulation.motion == ScanMotion::kContinuous)
    addTimeField(cloud, simulator.scanner());
  if (app::wantsLabels(s.scene)) {
    addTruthFields(cloud, scan, simulator.scene().scene());
    counts.add(scan, simulator.scene().scene());
  }
  if (simulator.scene().bodies().size() > 0 && s.scene.labels.value_or(true))
    addDynamicField(cloud, scan, simulator.scene());
  return cloud;
}

void
writeTrajectories(const app::OutputFolder& folder, const Simulator& simulator)
{
  writeTrajectoryKitti(folder / "odometry.txt", simulator.odometry());
  writeTrajectoryKitti(folder / "groundtruth.txt", simulator.truth());
  if (simulator.options().motion != ScanMotion::kContinuous)
    return;
  writeStamps(folder / "times.txt", simulator.truth().stamps);
  writeTrajectoryTum(folder / "groundtruth_motion.txt", motionWithinScans(simulator));
}

/** \return false when a signal came in before the last scan */
bool
writeFiles(const app::OutputFolder& folder,
           const SimulateSettings& s,
           const SimulationScene& scene,
           const Simulator& simulator,
           app::ProgressBar& progress)
{
  const app::Interrupt interrupt;
  TruthCounts counts;
  for (std::size_t i = 0; i < simulator.size(); ++i) {
    if (interrupt.requested())
      return false;
    writePcd(folder / (scanName(static_cast<int>(i)) + ".pcd"),
             cloudOf(s, simulator, i, counts),
             simulator.odometry().poses[i]);
    progress.show({"simulating", i + 1, simulator.size()});
  }
  writeTrajectories(folder, simulator);
  if (app::wantsLabels(s.scene))
    app::writeTruthFiles(folder, scene, simulator, counts);
  writeSceneFile(folder / app::kSceneFile, s, scene, simulator);
  return true;
}

void
printSummary(const SimulateSettings& s, const Simulator& simulator)
{
  double sum_sq = 0;
  double largest = 0;
  for (std::size_t i = 0; i < simulator.size(); ++i) {
    const double error = (simulator.odometry().poses[i].translation() -
                          simulator.truth().poses[i].translation())
                             .norm();
    sum_sq += error * error;
    largest = std::max(largest, error);
  }
  std::printf("%s: %zu scans, seed %lld; odometry off by %.3f m rms, %.3f m at most\n"
              "written to %s: scan*.pcd odometry.txt groundtruth.txt %s%s%s\n",
              s.scene.name.c_str(),
              simulator.size(),
              static_cast<long long>(s.simulation.seed),
              std::sqrt(sum_sq / static_cast<double>(simulator.size())),
              largest,
              s.out.c_str(),
              s.simulation.motion == ScanMotion::kContinuous
                  ? "groundtruth_motion.txt times.txt "
                  : "",
              app::wantsLabels(s.scene) ? "planes_truth.json objects_truth.json " : "",
              app::kSceneFile);
}

int
run(const std::vector<std::string>& arguments)
{
  if (!arguments.empty() && arguments.front() == app::kIntrude)
    return app::runIntrude({arguments.begin() + 1, arguments.end()});
  SimulateSettings s;
  if (!app::parseSettings(arguments, s))
    return app::kDone;
  SimulationScene scene = app::sceneOf(s);
  std::optional<Simulator> drive;
  SimulationOptions whole = s.simulation; // traffic goes about the whole way
  whole.last.reset();
  const bool has_traffic = s.traffic.people + s.traffic.cars > 0;
  app::checkOptions([&] { drive.emplace(scene, has_traffic ? whole : s.simulation); });
  if (has_traffic) {
    addTraffic(scene, *drive, s.traffic);
    drive.emplace(scene, s.simulation);
  }
  const Simulator& simulator = *drive;
  app::OutputFolder out(app::simulatedFolder(s.out, s.force));
  app::requireNoOtherScans(out);
  app::ProgressBar progress(s.quiet);
  if (!writeFiles(out, s, scene, simulator, progress)) {
    progress.say("interrupted: nothing written");
    return app::kInterrupted;
  }
  out.publish();
  if (!s.quiet)
    printSummary(s, simulator);
  return app::kDone;
}
} // namespace

int
main(int argc, char** argv)
{
  return pcl6d::app::runMain(kSimulate, argc, argv, run);
}

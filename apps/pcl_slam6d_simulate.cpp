// SPDX-License-Identifier: BSD-3-Clause
// Scans of a built-in scene with drifting odometry and exact truth.
#include "common/app.h"
#include "common/command_line.h"
#include "common/interrupt.h"
#include "common/output_folder.h"
#include "common/progress_bar.h"
#include "simulate/drive_options.h"
#include "simulate/scanner_options.h"
#include "simulate/scene_options.h"
#include "simulate/truth_files.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/require.h>
#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/pcd_io.h>
#include <pcl6d/io/scan_name.h>
#include <pcl6d/io/trajectory_io.h>
#include <pcl6d/scanner/scanner_presets.h>
#include <pcl6d/scanner/simulator.h>

#include <pcl/conversions.h>

#include <nlohmann/json.hpp>

#include <cstdio>
#include <filesystem>
#include <iostream>
#include <regex>

namespace {
namespace fs = std::filesystem;
namespace po = boost::program_options;
using namespace pcl6d;

constexpr const char* kName = "pcl_slam6d_simulate";
constexpr const char* kMarker = "scene.json"; // only simulated folders have it

struct Settings {
  app::SceneWords scene;
  app::ScannerWords scanner;
  app::DriveWords drive;
  std::string out;
  bool has_scans = false; // given by the user
  std::int64_t seed = 1;  // signed, as boost takes -1 for a large unsigned number
  int threads = 0;
  bool force = false;
  bool quiet = false;
  SimulationOptions simulation;
};

bool
parse(const std::vector<std::string>& arguments, Settings& s)
{
  app::CommandLine line(
      std::string("usage: ") + kName +
      " SCENE -o DIR [options]\nSimulates a robot that drives through "
      "a scene and scans it.\nSCENE is a scene description FILE.json, "
      "a mesh FILE.ply|obj|stl with --path, or one of:" +
      app::sceneList() + "\nScanners:" + app::scannerList());
  line.positional("SCENE", &s.scene.name);
  line.group("Simulation")
      .add_options() //
      ("scans",
       po::value(&s.simulation.num_scans),
       "number of scans, evenly along the way; by default what suits the scene") //
      ("seed",
       app::valueOf(s.seed),
       "same seed, same bytes; also of what is random in a scene");
  app::describeScene(line, s.scene);
  app::describeScanner(line, s.scanner);
  app::describeDrive(line, s.drive);
  line.group("Run").add_options() //
      ("output,o",
       po::value(&s.out)->value_name("DIR")->required(),
       "folder to write; made if missing") //
      ("force",
       po::bool_switch(&s.force),
       "write into a folder that holds other files, but no scans") //
      ("threads",
       app::valueOf(s.threads),
       "0: one per core; never changes results") //
      ("quiet", po::bool_switch(&s.quiet), "print errors only");
  const bool is_run = line.parse(arguments);
  s.has_scans = is_run && line.given("scans");
  return is_run;
}

/** Moves what has no field of its own into the simulator's options. */
void
applySettings(Settings& s)
{
  app::checkOptions([&] {
    require(s.seed >= 0, "seed", s.seed, ">= 0");
    require(s.threads >= 0, "threads", s.threads, ">= 0");
  });
  s.simulation.seed = static_cast<std::uint64_t>(s.seed);
  s.simulation.range.num_threads = static_cast<unsigned>(s.threads);
  app::applyDrive(s.drive, s.simulation);
}

/** Reads the scene and fills in what the user left to it. */
SimulationScene
sceneOf(Settings& s)
{
  SimulationScene scene = app::loadScene(s.scene, s.simulation.seed);
  if (!s.has_scans)
    s.simulation.num_scans = scene.num_scans;
  app::applyScanner(s.scanner, scene.max_range, s.simulation);
  app::checkOptions([&] { s.simulation.validate(); }, {{"num_scans", "scans"}});
  return scene;
}

/** \return whether a folder holds scans */
bool
holdsScans(const fs::path& folder)
{
  std::error_code error;
  for (const auto& entry : fs::directory_iterator(folder, error))
    if (entry.path().extension() == ".pcd")
      return true;
  return false;
}

app::OutputRules
outputRules(const Settings& s)
{
  app::OutputRules rules;
  rules.folder = s.out;
  rules.program = kName;
  rules.marker = kMarker;
  rules.files = std::regex("scan[0-9]+\\.pcd|odometry\\.txt|groundtruth\\.txt|"
                           "(planes|objects)_truth\\.json|times\\.txt|scene\\.json");
  rules.force = s.force;
  return rules;
}

void
writeSceneFile(const fs::path& path,
               const Settings& s,
               const SimulationScene& scene,
               const Simulator& simulator)
{
  nlohmann::ordered_json json = {{"schema_version", 1},
                                 {"generator", kName},
                                 {"scene", s.scene.name},
                                 {"seed", s.seed},
                                 {"scans", s.simulation.num_scans},
                                 {"scanner", s.scanner.name},
                                 {"noise", s.simulation.range.noise}};
  json.update(app::describedDrive(s.drive, simulator));
  if (!s.scanner.resolution.is_auto)
    json["resolution"] = s.scanner.resolution.value;
  if (s.scanner.exact)
    json["exact"] = true;
  if (s.simulation.range.max_range != RangeOptions().max_range)
    json["max_range"] = s.simulation.range.max_range;
  app::describeScene(s.scene, scene, json);
  writeFileAtomically(path,
                      [&](std::ostream& stream) { stream << json.dump(2) << '\n'; });
}

/** \return false when a signal came in before the last scan */
bool
writeFiles(const app::OutputFolder& folder,
           const Settings& s,
           const SimulationScene& scene,
           const Simulator& simulator,
           app::ProgressBar& progress)
{
  const app::Interrupt interrupt;
  const TriangleScene& surfaces = simulator.scene().scene();
  const bool has_labels = app::wantsLabels(s.scene);
  TruthCounts counts;
  const bool on_the_move = s.simulation.motion == ScanMotion::kContinuous;
  for (std::size_t i = 0; i < simulator.size(); ++i) {
    if (interrupt.requested())
      return false;
    pcl::PCLPointCloud2 cloud;
    const RangeScan scan = simulator.rangeScan(i);
    pcl::toPCLPointCloud2(toPointCloud(scan, simulator.scanner()), cloud);
    if (on_the_move)
      addTimeField(cloud, simulator.scanner());
    if (has_labels) {
      addTruthFields(cloud, scan, surfaces);
      counts.add(scan, surfaces);
    }
    writePcd(folder / (scanName(static_cast<int>(i)) + ".pcd"),
             cloud,
             simulator.odometry().poses[i]);
    progress.show({"simulating", i + 1, simulator.size()});
  }
  writeTrajectoryKitti(folder / "odometry.txt", simulator.odometry());
  writeTrajectoryKitti(folder / "groundtruth.txt", simulator.truth());
  if (on_the_move)
    writeStamps(folder / "times.txt", simulator.truth().stamps);
  if (has_labels)
    app::writeTruthFiles(folder, scene, simulator, counts);
  writeSceneFile(folder / kMarker, s, scene, simulator);
  return true;
}

void
printSummary(const Settings& s, const Simulator& simulator)
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
              static_cast<long long>(s.seed),
              std::sqrt(sum_sq / static_cast<double>(simulator.size())),
              largest,
              s.out.c_str(),
              s.simulation.motion == ScanMotion::kContinuous ? "times.txt " : "",
              app::wantsLabels(s.scene) ? "planes_truth.json objects_truth.json " : "",
              kMarker);
}

int
run(const std::vector<std::string>& arguments)
{
  Settings s;
  if (!parse(arguments, s))
    return app::kDone;
  applySettings(s);
  const SimulationScene scene = sceneOf(s);
  const Simulator simulator = app::startDrive(scene, s.simulation);
  app::OutputFolder out(outputRules(s));
  if (!out.holdsEarlierRun() && holdsScans(s.out))
    throw IoFailed(s.out + ": holds scans that were not simulated; use another folder");
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
  return pcl6d::app::runMain(kName, argc, argv, run);
}

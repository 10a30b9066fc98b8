// SPDX-License-Identifier: BSD-3-Clause
// Scans of a built-in scene with drifting odometry and exact truth.
#include "common/app.h"
#include "common/command_line.h"
#include "common/interrupt.h"
#include "common/output_folder.h"
#include "common/progress_bar.h"

#include <pcl6d/common/error.h>
#include <pcl6d/common/require.h>
#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/pcd_io.h>
#include <pcl6d/io/scan_name.h>
#include <pcl6d/io/trajectory_io.h>
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
  std::string scene;
  std::string out;
  std::string scanner = "rotating";
  std::int64_t seed = 1; // signed, as boost takes -1 for a large unsigned number
  int threads = 0;
  bool force = false;
  bool quiet = false;
  SimulationOptions simulation;
};

std::string
sceneList()
{
  std::string list;
  for (const auto& name : builtInSceneNames())
    list += (list.empty() ? "" : ", ") + name;
  return list;
}

bool
parse(const std::vector<std::string>& arguments, Settings& s)
{
  app::CommandLine line(
      std::string("usage: ") + kName +
      " SCENE -o DIR [options]\nSimulates a robot that drives through "
      "a scene and scans it.\nScenes: " +
      sceneList());
  line.positional("SCENE", &s.scene);
  RangeOptions& range = s.simulation.range;
  line.group("Simulation")
      .add_options() //
      ("scans",
       app::valueOf(s.simulation.num_scans),
       "number of scans, evenly along the way") //
      ("scanner",
       app::valueOf(s.scanner),
       "rotating (360 x 120 deg) or pitching (180 x 120 deg)") //
      ("noise",
       app::valueOf(range.noise),
       "[m] standard deviation of the ranges") //
      ("seed", app::valueOf(s.seed), "same seed, same bytes");
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
  return line.parse(arguments);
}

/** Moves what has no field of its own into the simulator's options. */
void
applySettings(Settings& s)
{
  app::checkOptions([&] {
    require(s.seed >= 0, "seed", s.seed, ">= 0");
    require(s.threads >= 0, "threads", s.threads, ">= 0");
  });
  if (s.scanner != "rotating" && s.scanner != "pitching")
    throw app::UsageError("--scanner = " + s.scanner +
                          ", but must be rotating or pitching");
  s.simulation.seed = static_cast<std::uint64_t>(s.seed);
  s.simulation.range.num_threads = static_cast<unsigned>(s.threads);
  s.simulation.scanner = std::make_shared<DrivenScanner>(
      s.scanner == "pitching" ? pitchingScanner() : rotatingScanner());
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
                           "scene\\.json");
  rules.force = s.force;
  return rules;
}

void
writeSceneFile(const fs::path& path, const Settings& s)
{
  const nlohmann::ordered_json json = {{"schema_version", 1},
                                       {"generator", kName},
                                       {"scene", s.scene},
                                       {"seed", s.seed},
                                       {"scans", s.simulation.num_scans},
                                       {"scanner", s.scanner},
                                       {"noise", s.simulation.range.noise}};
  writeFileAtomically(path,
                      [&](std::ostream& stream) { stream << json.dump(2) << '\n'; });
}

/** \return false when a signal came in before the last scan */
bool
writeFiles(const app::OutputFolder& folder,
           const Settings& s,
           const Simulator& simulator,
           app::ProgressBar& progress)
{
  const app::Interrupt interrupt;
  for (std::size_t i = 0; i < simulator.size(); ++i) {
    if (interrupt.requested())
      return false;
    pcl::PCLPointCloud2 cloud;
    pcl::toPCLPointCloud2(simulator.scan(i), cloud);
    writePcd(folder / (scanName(static_cast<int>(i)) + ".pcd"),
             cloud,
             simulator.odometry().poses[i]);
    progress.show({"simulating", i + 1, simulator.size()});
  }
  writeTrajectoryKitti(folder / "odometry.txt", simulator.odometry());
  writeTrajectoryKitti(folder / "groundtruth.txt", simulator.truth());
  writeSceneFile(folder / kMarker, s);
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
              "written to %s: scan*.pcd odometry.txt groundtruth.txt %s\n",
              s.scene.c_str(),
              simulator.size(),
              static_cast<long long>(s.seed),
              std::sqrt(sum_sq / static_cast<double>(simulator.size())),
              largest,
              s.out.c_str(),
              kMarker);
}

int
run(const std::vector<std::string>& arguments)
{
  Settings s;
  if (!parse(arguments, s))
    return app::kDone;
  applySettings(s);
  SimulationScene scene;
  app::checkOptions(
      [&] {
        scene = builtInScene(s.scene);
        s.simulation.validate();
      },
      {{"num_scans", "scans"}});
  const Simulator simulator(scene, s.simulation);
  app::OutputFolder out(outputRules(s));
  if (!out.holdsEarlierRun() && holdsScans(s.out))
    throw IoFailed(s.out + ": holds scans that were not simulated; use another folder");
  app::ProgressBar progress(s.quiet);
  if (!writeFiles(out, s, simulator, progress)) {
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

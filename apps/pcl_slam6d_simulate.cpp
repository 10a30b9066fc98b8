// SPDX-License-Identifier: BSD-3-Clause
// Scans of a built-in scene with drifting odometry and exact truth.
#include "common/app.h"
#include "common/command_line.h"
#include "common/interrupt.h"
#include "common/output_folder.h"
#include "common/progress_bar.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/pcd_io.h>
#include <pcl6d/io/trajectory_io.h>
#include <pcl6d/scanner/simulator.h>

#include <pcl/conversions.h>

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <regex>
#include <unistd.h>

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
  if (s.seed < 0)
    throw app::UsageError("--seed = " + std::to_string(s.seed) + ", but must be >= 0");
  if (s.threads < 0)
    throw app::UsageError("--threads = " + std::to_string(s.threads) +
                          ", but must be >= 0");
  if (s.scanner != "rotating" && s.scanner != "pitching")
    throw app::UsageError("--scanner = " + s.scanner +
                          ", but must be rotating or pitching");
  s.simulation.seed = static_cast<std::uint64_t>(s.seed);
  s.simulation.range.num_threads = static_cast<unsigned>(s.threads);
  s.simulation.scanner = std::make_shared<DrivenScanner>(
      s.scanner == "pitching" ? pitchingScanner() : rotatingScanner());
}

/** \return the scans of an earlier run in a folder */
std::vector<fs::path>
scansIn(const fs::path& folder)
{
  const std::regex scan_file("scan[0-9]+\\.pcd");
  std::vector<fs::path> scans;
  for (const auto& entry : fs::directory_iterator(folder))
    if (std::regex_match(entry.path().filename().string(), scan_file))
      scans.push_back(entry.path());
  return scans;
}

/** \brief A folder inside the output that holds all files until the last is written. */
class StagingFolder {
public:
  explicit StagingFolder(const fs::path& folder) : folder_(folder)
  {
    fs::create_directory(folder_);
  }
  ~StagingFolder()
  {
    std::error_code ignored;
    fs::remove_all(folder_, ignored);
  }
  StagingFolder(const StagingFolder&) = delete;
  StagingFolder&
  operator=(const StagingFolder&) = delete;

  fs::path
  operator/(const std::string& name) const
  {
    return folder_ / name;
  }

  /** \brief Replaces an earlier run in the folder above by the staged files. The marker
   * comes first, so that whatever stops it there, the folder is still known as ours. */
  void
  publish() const
  {
    const fs::path target = folder_.parent_path();
    fs::rename(folder_ / kMarker, target / kMarker);
    for (const auto& file : scansIn(target))
      fs::remove(file);
    for (const auto& entry : fs::directory_iterator(folder_))
      fs::rename(entry.path(), target / entry.path().filename());
  }

private:
  fs::path folder_;
};

std::string
scanName(std::size_t i)
{
  char name[32];
  std::snprintf(name, sizeof name, "scan%03zu.pcd", i);
  return name;
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
writeFiles(const StagingFolder& folder,
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
    writePcd(folder / scanName(i), cloud, simulator.odometry().poses[i]);
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
  app::checkOptions([&] {
    scene = builtInScene(s.scene);
    s.simulation.validate();
  });
  const Simulator simulator(scene, s.simulation);
  app::OutputFolder out(s.out, {}, kMarker, s.force);
  if (!out.holdsEarlierRun() && !scansIn(out / "").empty())
    throw IoFailed(s.out + ": holds scans that were not simulated; use another folder");
  {
    const StagingFolder staging(out / (".simulating-" + std::to_string(::getpid())));
    app::ProgressBar progress(s.quiet);
    if (!writeFiles(staging, s, simulator, progress)) {
      progress.say("interrupted: nothing written");
      return app::kInterrupted;
    }
    staging.publish();
  }
  out.commit();
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

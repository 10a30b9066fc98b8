// SPDX-License-Identifier: BSD-3-Clause
// Whole runs over the first scans of one drive, more and more of them: processor time, memory and links of each,
// and the powers of the number of scans that they grow with (share/doc/scaling.md).
// usage: bench_scaling FOLDER [scene=campus] [threads=1] [scans=50,100,200,500,1000,2000]
//        [option=value ...]   further options go to pcl_slam6d
#include <pcl6d/common/error.h>
#include <pcl6d/run/run_folder.h>

#include <algorithm>
#include <cmath>
#include <common/process/child_process.h>
#include <filesystem>
#include <iomanip>
#include <iostream>
#include <sstream>
#include <thread>

namespace pcl6d::bench {

namespace {
namespace fs = std::filesystem;

struct Knobs {
  fs::path folder;
  std::string scene = "campus";
  std::vector<std::size_t> scans{50, 100, 200, 500, 1000, 2000};
  std::vector<std::string> options{"--threads=1", "--no-picture", "--quiet"};
};

/** A run: what it took, and what it did. */
struct ScaledRun {
  std::size_t scans;
  app::ProcessEnd process;
  RunResult result;

  /** \return [s] of the clock of a stage of the graph */
  double
  secondsOf(StageKind kind) const
  {
    for (const StageResult& stage : result.graph_stages)
      if (stage.kind == kind)
        return stage.seconds;
    return 0;
  }
};

Knobs
knobsOf(const std::vector<std::string>& arguments)
{
  Knobs knobs;
  for (const std::string& argument : arguments) {
    const auto equals = argument.find('=');
    const std::string name = argument.substr(0, equals),
                      value = equals == std::string::npos ? ""
                                                          : argument.substr(equals + 1);
    if (name == "scene")
      knobs.scene = value;
    else if (name == "threads")
      knobs.options[0] = "--threads=" + value;
    else if (name == "scans") {
      knobs.scans.clear();
      std::istringstream list(value);
      for (std::string one; std::getline(list, one, ',');)
        knobs.scans.push_back(std::stoul(one));
    }
    else if (argument.rfind("--", 0) == 0)
      knobs.options.push_back(argument);
    else
      knobs.folder = argument;
  }
  if (knobs.folder.empty())
    throw BadArgument("usage: bench_scaling FOLDER [scene=NAME] [threads=N] "
                      "[scans=N,N,...] [--option=value ...]");
  return knobs;
}

app::ProcessEnd
endOf(const app::ProcessStart& start)
{
  app::ChildProcess process(start);
  for (;;) {
    if (const auto end = process.poll()) {
      // 3: a map in doubt takes as long as a good one.
      if (end->signal != 0 || (end->exit_code != 0 && end->exit_code != 3))
        throw IoFailed(start.program.string() + ": failed, see " + start.log.string());
      return *end;
    }
    std::this_thread::sleep_for(std::chrono::milliseconds(20));
  }
}

/** \return the folder of the whole drive, simulated if it is not there */
fs::path
driveOf(const Knobs& knobs, const fs::path& programs)
{
  const std::string scans =
      std::to_string(*std::max_element(knobs.scans.begin(), knobs.scans.end()));
  const fs::path drive = knobs.folder / (knobs.scene + scans);
  if (!fs::exists(drive / "odometry.txt"))
    endOf({programs / "pcl_slam6d_simulate",
           {knobs.scene, "-o", drive, "--scans", scans, "--quiet"},
           knobs.folder / "simulate.log",
           0});
  return drive;
}

ScaledRun
run(const Knobs& knobs,
    const fs::path& programs,
    const fs::path& drive,
    std::size_t scans)
{
  const std::string name = knobs.scene + std::to_string(scans);
  const fs::path out = knobs.folder / (name + "_out");
  fs::remove_all(out);
  std::vector<std::string> arguments{
      drive, "-o", out, "--last", std::to_string(scans - 1)};
  arguments.insert(arguments.end(), knobs.options.begin(), knobs.options.end());
  const app::ProcessEnd end =
      endOf({programs / "pcl_slam6d", arguments, knobs.folder / (name + ".log"), 0});
  ScaledRun scaled{scans, end, RunFolder(out).summary()};
  fs::remove_all(out);
  return scaled;
}

/** \return the power of x that y grows with: the slope of a line through the logarithms */
double
powerOf(const std::vector<std::pair<double, double>>& xy)
{
  double n = 0, x = 0, y = 0, xx = 0, xY = 0;
  for (const auto& [a, b] : xy) {
    if (!(a > 0 && b > 0))
      continue;
    ++n;
    x += std::log(a);
    y += std::log(b);
    xx += std::log(a) * std::log(a);
    xY += std::log(a) * std::log(b);
  }
  return n > 1 ? (n * xY - x * y) / (n * xx - x * x) : 0;
}

void
print(const ScaledRun& run)
{
  const auto scans = static_cast<double>(run.scans);
  std::cout << "| " << run.scans << " | " << std::fixed << std::setprecision(1)
            << run.process.cpu_seconds << " | " << std::setprecision(3)
            << run.process.cpu_seconds / scans << " | "
            << run.secondsOf(StageKind::kMatching) / scans << " | "
            << run.secondsOf(StageKind::kRelaxation) / scans << " | "
            << run.result.links_used << " | " << std::setprecision(0)
            << run.process.peak_memory_mb << " | " << std::setprecision(2)
            << run.process.peak_memory_mb / scans << " |\n"
            << std::flush;
}

int
runAll(const std::vector<std::string>& arguments, const fs::path& programs)
{
  const Knobs knobs = knobsOf(arguments);
  fs::create_directories(knobs.folder);
  const fs::path drive = driveOf(knobs, programs);
  std::cout
      << "| scans | processor [s] | a scan [s] | matching a scan [s] | relaxation a "
         "scan [s] | links | peak [MB] | a scan [MB] |\n"
         "|---|---|---|---|---|---|---|---|\n";
  std::vector<std::pair<double, double>> time, memory, relaxation;
  for (const std::size_t scans : knobs.scans) {
    const ScaledRun one = run(knobs, programs, drive, scans);
    print(one);
    const auto n = static_cast<double>(scans);
    time.emplace_back(n, one.process.cpu_seconds);
    memory.emplace_back(n, one.process.peak_memory_mb);
    relaxation.emplace_back(static_cast<double>(one.result.links_used),
                            one.secondsOf(StageKind::kRelaxation));
  }
  std::cout << std::setprecision(2) << "\nprocessor time grows with scans ^ "
            << powerOf(time) << ", memory with scans ^ " << powerOf(memory)
            << ", relaxation with links ^ " << powerOf(relaxation) << '\n';
  return 0;
}
} // namespace

} // namespace pcl6d::bench

int
main(int argc, char** argv)
{
  try {
    return pcl6d::bench::runAll({argv + 1, argv + argc},
                                std::filesystem::path(argv[0]).parent_path());
  } catch (const std::exception& e) {
    std::cerr << "bench_scaling: " << e.what() << '\n';
    return 1;
  }
}

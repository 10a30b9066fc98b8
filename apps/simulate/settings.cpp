// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "simulate/settings.h"

#include <pcl6d/scanner/scanner_presets.h>
#include <pcl6d/simulation/body_ways.h>

#include <cmath>

namespace pcl6d::app {

namespace {
/** \return the known scanners, a line each, for --help */
std::string
scannerList()
{
  std::string list;
  for (const auto& name : scannerNames())
    list += "\n  " + name + ": " + scannerDescription(name);
  return list;
}

void
addScanner(OptionTable& table, SimulateSettings& s)
{
  table.group("Scanner");
  table.add("scanner", &s.scanner).help("name of the scanner, see above");
  table.addAuto("resolution", &s.resolution)
      .help("[deg] between samples and lines; auto: the scanner's");
  table.addAuto("noise", &s.noise)
      .help("[m] standard deviation of the ranges, without the parts growing with "
            "range or angle; auto: from the scanner");
  table.addAuto("max-range", &s.max_range)
      .help("[m] largest range; auto: suited to the scene for rotating, else from the "
            "scanner");
  table.add("exact", &s.exact)
      .help("one ideal ray per sample and true ranges; with --noise: only this noise, "
            "no further error");
}

void
addDrive(OptionTable& table, SimulateSettings& s)
{
  table.group("Drive");
  table.add("motion", &s.simulation.motion, scanMotionFromName, "stop")
      .help("stop|continuous: stop for each scan, or drive on meanwhile; then points "
            "have the field t, and times.txt has the stamps");
  table.addAuto("speed", &s.simulation.speed)
      .above(0, "in (0, 50]", 50)
      .help("[m/s] or auto: 1, slower if a scan takes longer than the way to the next");
  table.add("turns-in-place", &s.simulation.turns_in_place)
      .help("drive straight from waypoint to waypoint, stop and turn; like every "
            "option below, with --motion continuous");
  table.addAuto("turn-rate", &s.simulation.turn_rate, M_PI / 180)
      .within(0.1, 570, "in [0.1, 570]")
      .help("[deg/s] never turn faster: slow down in bends; auto: any rate, 30 with "
            "--turns-in-place");
  table.add("vibration", &s.simulation.vibration)
      .within(0, 0.1, "in [0, 0.1]")
      .help("[m] rms of the shaking of the sensor, at 1 to 10 Hz, in six degrees of "
            "freedom");
  table.addAuto("period", &s.simulation.period)
      .above(0, "> 0")
      .help("[s] from scan to scan; auto: evenly along the way. The duration of a "
            "scan, 0.1 for ouster, gives successive sweeps");
  const auto takeOdometry = [&s](const std::string& name) {
    s.simulation.odometry_kind = odometryKindFromName(name);
    s.odometry = name;
  };
  table.addWord("odometry", s.odometry, takeOdometry)
      .help(
          "wheel|visual-inertial|exact: planar with drift, six degrees of freedom with "
          "little drift, the truth");
}

void
addMoving(OptionTable& table, SimulateSettings& s)
{
  table.group("What moves");
  table.add("people", &s.traffic.people)
      .within(0, kMostBodies, "in [0, 200]")
      .help("walk about the robot, on free floor, never nearer than 1.2 m; points then "
            "have the field dynamic: 1 on moving bodies, else 0");
  table.add("traffic", &s.traffic.cars)
      .within(0, kMostBodies, "in [0, 200]")
      .help("cars driving about the robot, never nearer than 3.5 m");
}

void
addOptions(OptionTable& table, SimulateSettings& s)
{
  table.positional("SCENE", &s.scene.name);
  table.group("Simulation");
  table.add("scans", &s.scans)
      .help("number of scans, evenly along the way; by default suited to the scene");
  table.add("last", &s.simulation.last)
      .within(0, kNoBound, ">= 0")
      .help("index of the last scan of the way to simulate, for example 19 of --scans "
            "300; "
            "the scans before it stay the same");
  table.addAs<std::int64_t>("seed", &s.simulation.seed)
      .within(0, kNoBound, ">= 0")
      .help("equal seeds give equal bytes; also seed of the random parts of a scene");
  addScene(table, s.scene);
  addMoving(table, s);
  addScanner(table, s);
  addDrive(table, s);
  table.group("Run");
  table.add("output,o DIR", &s.out).required().help("folder to write; made if missing");
  table.add("force", &s.force)
      .help("write into a folder that is not empty, but holds no scans");
  table.addAs<int>("threads", &s.simulation.range.num_threads)
      .within(0, kNoBound, ">= 0")
      .help("0: a thread per core; never changes results");
  table.add("quiet", &s.quiet).help("print errors only");
}

/** Sets the scanner and its measurement options. */
void
applyScanner(const SimulateSettings& s, double scene_range, SimulationOptions& options)
{
  checkOptions([&] {
    const auto resolution =
        s.resolution ? std::make_optional(*s.resolution * M_PI / 180) : std::nullopt;
    const ScannerPreset preset = scannerByName(s.scanner, resolution);
    const unsigned num_threads = options.range.num_threads;
    options.scanner = preset.scanner;
    options.range = s.exact ? preset.range.withoutErrors() : preset.range;
    options.range.num_threads = num_threads;
  });
  options.range.noise = s.noise.value_or(options.range.noise);
  if (s.max_range)
    options.range.max_range = *s.max_range;
  else if (s.scanner == SimulateSettings().scanner)
    options.range.max_range = scene_range;
}
} // namespace

bool
parseSettings(const std::vector<std::string>& arguments, SimulateSettings& s)
{
  OptionTable table(
      std::string("usage: ") + kSimulate + " SCENE -o DIR [options]\n       " +
      kSimulate +
      " intrude RUN -o DIR [options]\nSimulates a robot that drives "
      "through a scene and scans it.\nSCENE is a scene description FILE.json, "
      "a mesh FILE.ply|obj|stl with --path, or one of:" +
      sceneList() + "\nScanners:" + scannerList() +
      "\nJobs:\n  intrude RUN -o DIR  lets people and cars move through "
      "recorded scans; " +
      kSimulate + " intrude --help tells the options");
  addOptions(table, s);
  return table.parse(arguments);
}

SimulationScene
sceneOf(SimulateSettings& s)
{
  SimulationScene scene = loadScene(s.scene, s.simulation.seed);
  s.traffic.seed = s.simulation.seed;
  s.simulation.num_scans = s.scans.value_or(scene.num_scans);
  applyScanner(s, scene.max_range, s.simulation);
  checkOptions([&] { s.simulation.validate(); }, {{"num_scans", "scans"}});
  return scene;
}

} // namespace pcl6d::app

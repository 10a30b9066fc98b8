// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "simulate/settings.h"

#include <pcl6d/common/require.h>

namespace pcl6d::app {

namespace {
namespace po = boost::program_options;

void
describeOptions(CommandLine& line, SimulateSettings& s)
{
  line.positional("SCENE", &s.scene.name);
  line.group("Simulation")
      .add_options() //
      ("scans",
       po::value(&s.simulation.num_scans),
       "number of scans, evenly along the way; by default what suits the scene") //
      ("seed",
       valueOf(s.seed),
       "same seed, same bytes; also of what is random in a scene");
  describeScene(line, s.scene);
  describeScanner(line, s.scanner);
  describeDrive(line, s.drive);
  line.group("Run").add_options() //
      ("output,o",
       po::value(&s.out)->value_name("DIR")->required(),
       "folder to write; made if missing") //
      ("force",
       po::bool_switch(&s.force),
       "write into a folder that holds other files, but no scans") //
      ("threads",
       valueOf(s.threads),
       "0: one per core; never changes results") //
      ("quiet", po::bool_switch(&s.quiet), "print errors only");
}
} // namespace

bool
parseSettings(const std::vector<std::string>& arguments, SimulateSettings& s)
{
  CommandLine line(std::string("usage: ") + kSimulate +
                   " SCENE -o DIR [options]\nSimulates a robot that drives through "
                   "a scene and scans it.\nSCENE is a scene description FILE.json, "
                   "a mesh FILE.ply|obj|stl with --path, or one of:" +
                   sceneList() + "\nScanners:" + scannerList());
  describeOptions(line, s);
  if (!line.parse(arguments))
    return false;
  s.has_scans = line.given("scans");
  checkOptions([&] {
    require(s.seed >= 0, "seed", s.seed, ">= 0");
    require(s.threads >= 0, "threads", s.threads, ">= 0");
  });
  s.simulation.seed = static_cast<std::uint64_t>(s.seed);
  s.simulation.range.num_threads = static_cast<unsigned>(s.threads);
  applyDrive(s.drive, s.simulation);
  return true;
}

SimulationScene
sceneOf(SimulateSettings& s)
{
  SimulationScene scene = loadScene(s.scene, s.simulation.seed);
  if (!s.has_scans)
    s.simulation.num_scans = scene.num_scans;
  applyScanner(s.scanner, scene.max_range, s.simulation);
  checkOptions([&] { s.simulation.validate(); }, {{"num_scans", "scans"}});
  return scene;
}

} // namespace pcl6d::app

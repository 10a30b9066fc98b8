// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/options/option_table.h"
#include "evaluate/mcl/mcl_settings.h"
#include "evaluate/verbs.h"

#include <pcl6d/common/angle.h>
#include <pcl6d/common/require.h>
#include <pcl6d/common/rotation.h>

#include <cmath>
#include <sstream>

namespace pcl6d::app {

namespace {
constexpr int kMostParticles = 10000000;
constexpr const char* kMoreThanParticles = "in [--particles, 10000000]";

std::string
usageOfMcl()
{
  return std::string("usage: ") + kEvaluate +
         R"( mcl SCAN_DIR --map FILE [-o OUT_DIR] [options]
A reference path for a drive through a place with a known plan: Monte Carlo
localisation of virtual 2D scans in a map of walls. Scans with a doubtful pose
are marked, and no pose is invented.

MAP is a plan (.csv rows x1,y1,x2,y2; .geojson in a planar system; .svg of
straight lines), the planes of a scene or run (.json: its walls), a cloud
(.pcd, .ply: upright surfaces between two heights), or a mesh (.obj, .stl,
.ply: cut half way between the heights). The map is in the world of the poses
unless --start gives the pose of the first scan in the map.

Roll and pitch of a scan come from the walls in view; z is carried along
by odometry and slope. Distances are in metres, angles of options in degrees,
angles in files in radians.
Exit code 3: part of the way is doubtful.
)";
}

/** \return the numbers of an option's text \throws UsageError not exactly count numbers */
std::vector<double>
numbersOf(const std::string& option, const std::string& text, std::size_t count)
{
  std::istringstream stream(text);
  std::vector<double> values(count);
  bool good = true;
  for (double& value : values)
    good = good && stream >> value && std::isfinite(value);
  if (!good || !(stream >> std::ws).eof())
    throw UsageError("--" + option + " \"" + text + "\": expected " +
                     std::to_string(count) + " finite numbers");
  return values;
}

void
takeStart(const std::string& text, MclSettings& s)
{
  if (text == "poses" || text == "anywhere") {
    s.start = text == "poses" ? MclStart::kPoses : MclStart::kAnywhere;
    return;
  }
  const auto v = numbersOf("start", text, 3);
  s.start = MclStart::kGiven;
  s.start_pose = {v[0], v[1], wrapAngle(radians(v[2]))};
}

void
addInput(OptionTable& table, MclSettings& s)
{
  const auto takeSlice = [&s](const std::string& text) {
    const auto v = numbersOf("map-slice", text, 2);
    s.slice.low = v[0];
    s.slice.high = v[1];
  };
  table.positional("SCAN_DIR", &s.folder);
  table.group("Input");
  table.add("map FILE", &s.map).required().help("the walls");
  table.add("map-scale", &s.map_scale)
      .above(0, "finite and > 0", kFinite)
      .help("[m] per unit of a plan or mesh");
  table.addWord("map-slice \"LOW HIGH\"", "", takeSlice)
      .help("[m] lowest and highest z of the map for walls cut from a cloud or mesh; "
            "by default 0.5 to 2");
  table
      .addWord("start poses|anywhere|\"X Y YAW\"",
               "poses",
               [&s](const auto& text) { takeStart(text, s); })
      .help("of the first scan in the map, [m] and [deg]; poses: from the poses; "
            "anywhere: searched in the whole map, needs --max-particles of about 50 "
            "per m^2");
  table.add("poses FILE", &s.scans.poses_file)
      .help("odometry, KITTI or TUM; by default the odometry of the folder");
  table.add("format", &s.scans.format, scanFormatFromName)
      .help("auto|pcd|ply|uos|kitti|xyz|las|laz");
  table.add("first", &s.scans.first).help("index of the first scan");
  table.add("last", &s.scans.last).help("index of the last scan");
  table.add("every", &s.scans.every).help("take each n-th scan");
  table.addAuto("min-range", &s.gate.min_range).help("[m] or auto: range gate");
  table.addAuto("max-range", &s.gate.max_range).help("[m] or auto: range gate");
}

void
addLocalisation(OptionTable& table, MclSettings& s)
{
  table.group("Localisation");
  table.add("level", &s.level_by_walls, {{"walls", true}, {"poses", false}})
      .help("walls|poses: where roll and pitch come from");
  table.addAs<std::int64_t>("particles", &s.mcl.num_particles)
      .within(1, kMostParticles, "in [1, " + std::to_string(kMostParticles) + "]")
      .help("while the particles are close together");
  table.addAs<std::int64_t>("max-particles", &s.mcl.max_particles)
      .within(1, kMostParticles, kMoreThanParticles)
      .help("while they are spread");
  table.add("hit-sigma", &s.mcl.hit_sigma)
      .help("[m] standard deviation of a point about the wall");
  table.add("odometry-turn", &s.mcl.rotation_per_metre)
      .help("[rad/m] standard deviation of the odometry's heading");
  table.add("odometry-way", &s.mcl.translation_per_metre)
      .help("[m/m] standard deviation of the odometry's way");
  table.add("min-walls", &s.mcl.min_walls)
      .help("fewer columns with a wall are not trusted");
  table.add("min-agreement", &s.mcl.min_agreement)
      .help("least share of the wall points on the map");
  table.add("max-spread", &s.mcl.max_spread)
      .help("[m] largest standard deviation of a trusted position");
}

void
addRun(OptionTable& table, MclSettings& s)
{
  table.group("Run");
  table.add("reference FILE", &s.reference)
      .help("poses of the scans (KITTI or TUM) in the world of the poses; print the "
            "errors in the plan");
  table.add("justify", &s.justify)
      .help("match the scans by ICP against the map extruded to 3D and print the "
            "distance from the localisation (book 6.4.4)");
  table.add("output,o OUT_DIR", &s.out)
      .help("folder for reference.kitti (all scans), reference.tum (reliable scans, "
            "stamps of the poses or the indices of the scans), mcl.csv, mcl.json, "
            "mcl.png; made if missing");
  table.addAs<std::int64_t>("seed", &s.mcl.seed)
      .within(0, kNoBound, ">= 0")
      .help("same seed, same bits");
  table.addAs<int>("threads", &s.mcl.num_threads)
      .within(0, 1024, "in [0, 1024]")
      .help("0: a thread per core; never changes the result");
  table.add("force", &s.force).help("write into a folder that is not empty");
  table.add("quiet", &s.quiet).help("print results, warnings and errors only");
}
} // namespace

bool
parseMclSettings(const std::vector<std::string>& arguments, MclSettings& settings)
{
  OptionTable table(usageOfMcl());
  addInput(table, settings);
  addLocalisation(table, settings);
  addRun(table, settings);
  if (!table.parse(arguments))
    return false;
  table.check(
      [&] {
        require(settings.mcl.max_particles >= settings.mcl.num_particles,
                "max_particles",
                settings.mcl.max_particles,
                kMoreThanParticles);
        settings.scans.validate();
        settings.gate.validate();
        settings.slice.validate();
        settings.mcl.validate();
      },
      {{"num_particles", "particles"},
       {"rotation_per_metre", "odometry-turn"},
       {"translation_per_metre", "odometry-way"},
       {"low", "map-slice LOW"},
       {"high", "map-slice HIGH"}});
  settings.without_effect =
      table.withoutEffect({{"force", !settings.out.empty(), "with --output"}});
  return true;
}

} // namespace pcl6d::app

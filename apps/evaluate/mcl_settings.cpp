// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/command_line.h"
#include "evaluate/mcl_settings.h"
#include "evaluate/verbs.h"

#include <pcl6d/common/angle.h>
#include <pcl6d/common/require.h>
#include <pcl6d/common/rotation.h>

#include <cmath>
#include <sstream>

namespace pcl6d::app {

namespace {
namespace po = boost::program_options;

constexpr int kMostThreads = 1024;
/** Values that the command line knows in another form than the library. */
struct Raw {
  std::string format = "auto";
  std::string start = "poses";
  std::string level = "walls";
  std::string slice;
  AutoDouble min_range, max_range;
  int last = -1;
  std::int64_t particles = 200, max_particles = 20000, seed = 1;
  int threads = 0;
};

std::string
usage()
{
  return std::string("usage: ") + kEvaluate +
         " mcl SCAN_DIR --map FILE [-o OUT_DIR] [options]\n"
         "A reference path for a drive through a place whose plan is known: Monte "
         "Carlo\n"
         "localisation of virtual 2D scans in a map of walls. Marks the scans whose\n"
         "pose is not to be trusted, and invents nothing there.\n"
         "\n"
         "MAP is a plan (.csv rows x1,y1,x2,y2; .geojson in a planar system; .svg of\n"
         "straight lines), the planes of a scene or run (.json: its walls), a cloud\n"
         "(.pcd, .ply: what stands upright between two heights), or a mesh (.obj, "
         ".stl,\n"
         ".ply: cut half way between them). It is in the world of the poses unless\n"
         "--start says where in it the first scan was taken.\n"
         "\n"
         "Roll and pitch of a scan come from the walls that it sees; z is carried "
         "along\n"
         "by odometry and slope. Distances are in metres, angles of options in "
         "degrees,\n"
         "angles in files in radians.\n"
         "Exit code 3: part of the way is not to be trusted.\n";
}

void
describeInput(CommandLine& line, MclSettings& s, Raw& raw)
{
  line.group("Input").add_options()                                           //
      ("map", po::value(&s.map)->value_name("FILE")->required(), "the walls") //
      ("map-scale", valueOf(s.map_scale), "[m] per unit of a plan or mesh")   //
      ("map-slice",
       po::value(&raw.slice)->value_name("\"LOW HIGH\""),
       "[m] heights in the map's own z between which walls are cut from a cloud or "
       "mesh; "
       "by default 0.5 to 2") //
      ("start",
       po::value(&raw.start)
           ->value_name("poses|anywhere|\"X Y YAW\"")
           ->default_value(raw.start),
       "of the first scan in the map, [m] and [deg]; poses: as the poses say; "
       "anywhere: "
       "it is looked for, which takes --max-particles of about 50 per m^2") //
      ("poses",
       po::value(&s.scans.poses_file)->value_name("FILE"),
       "odometry, KITTI or TUM; by default that of the folder")        //
      ("format", valueOf(raw.format), "auto|pcd|ply|uos|kitti|xyz")    //
      ("first", valueOf(s.scans.first), "index of the first scan")     //
      ("last", po::value(&raw.last), "index of the last scan")         //
      ("every", valueOf(s.scans.every), "take each n-th scan")         //
      ("min-range", valueOf(raw.min_range), "[m] or auto: range gate") //
      ("max-range", valueOf(raw.max_range), "[m] or auto: range gate");
}

void
describeLocalisation(CommandLine& line, MclSettings& s, Raw& raw)
{
  line.group("Localisation")
      .add_options() //
      ("level",
       valueOf(raw.level),
       "walls|poses: where roll and pitch come from")                        //
      ("particles", valueOf(raw.particles), "while they are close together") //
      ("max-particles", valueOf(raw.max_particles), "while they are spread") //
      ("hit-sigma",
       valueOf(s.mcl.hit_sigma),
       "[m] standard deviation of a point about its wall") //
      ("odometry-turn",
       valueOf(s.mcl.rotation_per_metre),
       "[rad/m] standard deviation of the odometry's heading") //
      ("odometry-way",
       valueOf(s.mcl.translation_per_metre),
       "[m/m] standard deviation of the odometry's way") //
      ("min-walls",
       valueOf(s.mcl.min_walls),
       "fewer columns with a wall are not trusted") //
      ("min-agreement",
       valueOf(s.mcl.min_agreement),
       "share of the wall points that must be on the map") //
      ("max-spread",
       valueOf(s.mcl.max_spread),
       "[m] largest standard deviation of a trusted position");
}

void
describeRun(CommandLine& line, MclSettings& s, Raw& raw)
{
  line.group("Run").add_options() //
      ("reference",
       po::value(&s.reference)->value_name("FILE"),
       "poses of the scans (KITTI or TUM) in the world of the poses; print the errors "
       "in the plan") //
      ("justify",
       po::bool_switch(&s.justify),
       "match the scans by ICP against the map extruded to 3D and print how far that "
       "is "
       "from the localisation (book 6.4.4)") //
      ("output,o",
       po::value(&s.out)->value_name("OUT_DIR"),
       "folder for reference.kitti (all scans), reference.tum (trusted ones, stamps "
       "as "
       "the poses or the scans' indices), mcl.csv, mcl.json, mcl.png; made if "
       "missing")                                         //
      ("seed", valueOf(raw.seed), "same seed, same bits") //
      ("threads",
       valueOf(raw.threads),
       "0: one per core; never changes the result") //
      ("force",
       po::bool_switch(&s.force),
       "write into a folder that holds other files") //
      ("quiet", po::bool_switch(&s.quiet), "print results, warnings and errors only");
}

/** \return the numbers of an option's text \throws UsageError it holds others */
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
interpretStart(const Raw& raw, MclSettings& s)
{
  if (raw.start == "poses" || raw.start == "anywhere") {
    s.start = raw.start == "poses" ? MclStart::kPoses : MclStart::kAnywhere;
    return;
  }
  const auto v = numbersOf("start", raw.start, 3);
  s.start = MclStart::kGiven;
  s.start_pose = {v[0], v[1], wrapAngle(radians(v[2]))};
}

std::optional<double>
toOptional(const AutoDouble& value)
{
  return value.is_auto ? std::nullopt : std::optional<double>(value.value);
}

/** Checks what has no validate() of its own, and fills in the rest. */
void
interpretNumbers(const CommandLine& line, const Raw& raw, MclSettings& s)
{
  require(raw.threads >= 0 && raw.threads <= kMostThreads,
          "threads",
          raw.threads,
          "in [0, " + std::to_string(kMostThreads) + "]");
  require(raw.seed >= 0, "seed", raw.seed, ">= 0");
  constexpr std::int64_t kMostParticles = 10000000;
  require(raw.particles > 0 && raw.particles <= kMostParticles,
          "particles",
          raw.particles,
          "in [1, " + std::to_string(kMostParticles) + "]");
  require(raw.max_particles >= raw.particles && raw.max_particles <= kMostParticles,
          "max_particles",
          raw.max_particles,
          "in [--particles, " + std::to_string(kMostParticles) + "]");
  require(raw.level == "walls" || raw.level == "poses",
          "level",
          raw.level,
          "walls or poses");
  require(std::isfinite(s.map_scale) && s.map_scale > 0,
          "map_scale",
          s.map_scale,
          "finite and > 0");
  s.mcl.num_threads = static_cast<unsigned int>(raw.threads);
  s.mcl.seed = static_cast<std::uint64_t>(raw.seed);
  s.mcl.num_particles = static_cast<std::size_t>(raw.particles);
  s.mcl.max_particles = static_cast<std::size_t>(raw.max_particles);
  s.level_by_walls = raw.level == "walls";
  s.scans.format = scanFormatFromName(raw.format);
  if (line.given("last"))
    s.scans.last = raw.last;
  s.gate.min_range = toOptional(raw.min_range);
  s.gate.max_range = toOptional(raw.max_range);
}

void
interpret(const CommandLine& line, const Raw& raw, MclSettings& s)
{
  interpretStart(raw, s);
  if (line.given("map-slice")) {
    const auto v = numbersOf("map-slice", raw.slice, 2);
    s.slice.low = v[0];
    s.slice.high = v[1];
  }
  checkOptions(
      [&] {
        interpretNumbers(line, raw, s);
        s.scans.validate();
        s.gate.validate();
        s.slice.validate();
        s.mcl.validate();
      },
      {{"num_particles", "particles"},
       {"rotation_per_metre", "odometry-turn"},
       {"translation_per_metre", "odometry-way"},
       {"low", "map-slice LOW"},
       {"high", "map-slice HIGH"}});
}
} // namespace

bool
parseMclSettings(const std::vector<std::string>& arguments, MclSettings& settings)
{
  CommandLine line(usage());
  Raw raw;
  line.positional("SCAN_DIR", &settings.folder);
  describeInput(line, settings, raw);
  describeLocalisation(line, settings, raw);
  describeRun(line, settings, raw);
  if (!line.parse(arguments))
    return false;
  interpret(line, raw, settings);
  settings.without_effect =
      line.withoutEffect({{"force", !settings.out.empty(), "with --output"}});
  return true;
}

} // namespace pcl6d::app

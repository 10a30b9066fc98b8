// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/command_line.h"
#include "slam6d/settings.h"

#include <pcl6d/common/require.h>
#include <pcl6d/registration/minimisers.h>

#include <sstream>

namespace po = boost::program_options;

namespace pcl6d::app {

namespace {
constexpr int kMostThreads = 1024;

constexpr const char* kUsageText =
    "usage: pcl_slam6d SCAN_DIR -o OUT_DIR [options]\n"
    "Registers the 3D scans of a folder (PCD, PLY, 3DTK uos, KITTI bin, xyz) into one "
    "map\n"
    "and writes poses, map, picture and summary. Distances are in metres.\n";

/** Values that the command line knows in another form than the library. */
struct Raw {
  std::string format = "auto";
  std::string metascan = "all";
  std::string metric = toString(Slam6DOptions().metric);
  std::string minimiser = "quaternion";
  std::string plane_minimiser = "helix";
  std::string search = toString(Slam6DOptions().search);
  std::string robust = toString(Slam6DOptions().robust);
  std::string initial_guess = "auto";
  AutoDouble min_range, max_range, voxel, max_distance, max_distance_start;
  int last = -1;
  int threads = 0;
};

void
describeInput(CommandLine& line, Settings& s, Raw& raw)
{
  line.group("Input").add_options()(
      "first",
      valueOf(s.folder.first),
      "index of the first scan to take, in the order of the folder")(
      "last",
      po::value(&raw.last),
      "index of the last scan to take (default: the end)")(
      "every", valueOf(s.folder.every), "take each n-th scan")(
      "poses",
      po::value<std::string>()->value_name("FILE")->notifier(
          [&s](const std::string& file) { s.folder.poses_file = file; }),
      "initial poses, KITTI or TUM rows, one per scan of the folder (default: *.pose, "
      "odometry.txt, poses.txt, PCD VIEWPOINT or identity, the first that is there)")(
      "format", valueOf(raw.format), "auto|pcd|ply|uos|kitti|xyz");
}

std::string
joined(const std::vector<std::string>& names)
{
  std::string text;
  for (const auto& name : names)
    text += (text.empty() ? "" : "|") + name;
  return text;
}

void
describeMetric(CommandLine& line, Raw& raw)
{
  line.group("Matching")
      .add_options()("metric",
                     valueOf(raw.metric),
                     (joined(metricNames()) +
                      ": distance between points, of points to planes, of planes")
                         .c_str())(
          "minimiser",
          valueOf(raw.minimiser),
          (joined(minimiserNames()) + ", of the metric point").c_str())(
          "plane-minimiser",
          valueOf(raw.plane_minimiser),
          (joined(planeMinimiserNames()) + ", of the metrics plane and gicp").c_str())(
          "search",
          valueOf(raw.search),
          (joined(searchMethodNames()) + ": how closest points are found; all but "
                                         "approximate give the same result")
              .c_str())(
          "robust",
          valueOf(raw.robust),
          (joined(robustKernelNames()) + ": less weight for pairs that are far apart")
              .c_str())(
          "initial-guess",
          valueOf(raw.initial_guess),
          ("auto|" + joined(initialGuessNames()) +
           ": where matching starts; auto: odometry, features if there are no poses")
              .c_str());
}

void
describeMatching(CommandLine& line, Settings& s, Raw& raw)
{
  line.group("Range gate and reduction")
      .add_options()("min-range",
                     valueOf(raw.min_range),
                     "[m] or auto: nearer points are dropped")(
          "max-range",
          valueOf(raw.max_range),
          "[m] or auto: farther points are dropped; auto drops no-return codes")(
          "voxel",
          valueOf(raw.voxel),
          "[m] or auto: edge length of the octree reduction");
  describeMetric(line, raw);
  line.group("Limits of matching")
      .add_options()("max-distance",
                     valueOf(raw.max_distance),
                     "[m] or auto: largest pair distance")(
          "max-distance-start",
          valueOf(raw.max_distance_start),
          "[m] or auto: largest pair distance of the first iteration, which then "
          "shrinks to "
          "--max-distance")(
          "metascan",
          po::value(&raw.metascan)->value_name("N|all")->default_value("all"),
          "match against the union of the last N scans; 1 is pairwise")(
          "iterations",
          valueOf(s.slam.max_iterations),
          "most iterations of one ICP; a scan that needs more is not converged")(
          "min-overlap",
          valueOf(s.slam.min_overlap),
          "share of points with a partner below which a match is not believed") //
      ("max-correction",
       valueOf(s.slam.max_correction),
       "share of the odometry's step by which a match may move a scan; beyond, it is "
       "not believed (inf: always). 1.5 x max-distance is always allowed; not applied "
       "to "
       "--initial-guess overlap and features");
}

void
describeRun(CommandLine& line, Settings& s, Raw& raw)
{
  line.group("Run").add_options()("output,o",
                                  po::value(&s.out)->value_name("OUT_DIR"),
                                  "folder to write; made if missing")(
      "threads",
      po::value(&raw.threads)->default_value(0),
      "0: one per core; never changes the result")(
      "seed", valueOf(s.seed), "of random choices (those of --initial-guess features)")(
      "force", po::bool_switch(&s.force), "write into a folder that holds other files")(
      "quiet", po::bool_switch(&s.quiet), "print warnings and errors only")(
      "verbose", po::bool_switch(&s.verbose), "print a line per scan");
}

std::optional<double>
toOptional(const AutoDouble& value)
{
  return value.is_auto ? std::nullopt : std::optional<double>(value.value);
}

int
metascanFromText(const std::string& text)
{
  if (text == "all")
    return 0;
  std::istringstream stream(text);
  int count = 0;
  if (!(stream >> count) || !stream.eof() || count < 1)
    throw UsageError("--metascan " + text + ": expected a number >= 1 or all");
  return count;
}

void
interpret(const CommandLine& line, const Raw& raw, Settings& s)
{
  if (s.out.empty())
    throw UsageError("-o OUT_DIR is missing");
  if (line.given("last"))
    s.folder.last = raw.last;
  s.slam.num_threads = static_cast<unsigned int>(raw.threads);
  s.slam.metascan = metascanFromText(raw.metascan);
  s.slam.min_range = toOptional(raw.min_range);
  s.slam.max_range = toOptional(raw.max_range);
  s.slam.voxel = toOptional(raw.voxel);
  s.slam.max_distance = toOptional(raw.max_distance);
  s.slam.max_distance_start = toOptional(raw.max_distance_start);
  checkOptions(
      [&] {
        require(raw.threads >= 0 && raw.threads <= kMostThreads,
                "threads",
                raw.threads,
                "in [0, " + std::to_string(kMostThreads) + "]");
        require(s.seed >= 0, "seed", s.seed, ">= 0");
        s.slam.metric = metricFromName(raw.metric);
        s.slam.minimiser = minimiserFromName(raw.minimiser);
        s.slam.plane_minimiser = planeMinimiserFromName(raw.plane_minimiser);
        s.slam.search = searchMethodFromName(raw.search);
        s.slam.robust = robustKernelFromName(raw.robust);
        s.auto_guess = raw.initial_guess == "auto";
        if (!s.auto_guess)
          s.slam.initial_guess = initialGuessFromName(raw.initial_guess);
        s.slam.seed = static_cast<std::uint64_t>(s.seed);
        s.folder.format = scanFormatFromName(raw.format);
        s.folder.validate();
        s.slam.validate();
      },
      {{"max_iterations", "iterations"},
       {"plane minimiser", "plane-minimiser"},
       {"initial guess", "initial-guess"}});
}

template <typename T>
Settings::Word
word(const CommandLine& line, const std::string& name, const T& value)
{
  std::ostringstream text;
  text << value;
  return {name, text.str(), line.given(name)};
}

/** The words that go into the summary; lengths go there as parameters. */
std::vector<Settings::Word>
wordsOf(const CommandLine& line, const Raw& raw, const Settings& s)
{
  return {word(line, "first", s.folder.first),
          word(line, "last", s.folder.last ? std::to_string(*s.folder.last) : "end"),
          word(line, "every", s.folder.every),
          word(line, "poses", s.folder.poses_file.string()),
          word(line, "format", raw.format),
          word(line, "metric", raw.metric),
          word(line, "minimiser", raw.minimiser),
          word(line, "plane-minimiser", raw.plane_minimiser),
          word(line, "search", raw.search),
          word(line, "robust", raw.robust),
          word(line, "initial-guess", raw.initial_guess),
          word(line, "metascan", raw.metascan),
          word(line, "iterations", s.slam.max_iterations),
          word(line, "min-overlap", s.slam.min_overlap),
          word(line, "max-correction", s.slam.max_correction),
          word(line, "threads", raw.threads),
          word(line, "seed", s.seed)};
}
} // namespace

void
Settings::resolveGuess(bool has_poses)
{
  if (!auto_guess)
    return;
  slam.initial_guess = has_poses ? InitialGuess::kOdometry : InitialGuess::kFeatures;
  for (auto& word : words)
    if (word.name == "initial-guess")
      word.value = toString(slam.initial_guess);
}

bool
parseSettings(const std::vector<std::string>& arguments, Settings& settings)
{
  CommandLine line(kUsageText);
  Raw raw;
  line.positional("SCAN_DIR", &settings.input);
  describeInput(line, settings, raw);
  describeMatching(line, settings, raw);
  describeRun(line, settings, raw);
  if (!line.parse(arguments))
    return false;
  interpret(line, raw, settings);
  settings.words = wordsOf(line, raw, settings);
  const bool planes = settings.slam.metric != Metric::kPoint;
  settings.without_effect =
      line.withoutEffect({{"minimiser", !planes, "of the metric point"},
                          {"plane-minimiser", planes, "of the metrics plane and gicp"}});
  return true;
}

std::vector<std::pair<std::string, Parameter>>
named(const Slam6DParameters& parameters)
{
  return {{"min-range", parameters.min_range},
          {"max-range", parameters.max_range},
          {"voxel", parameters.voxel},
          {"max-distance", parameters.max_distance},
          {"max-distance-start", parameters.max_distance_start}};
}

} // namespace pcl6d::app

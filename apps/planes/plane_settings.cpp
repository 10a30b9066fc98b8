// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/command_line.h"
#include "planes/plane_settings.h"

#include <pcl6d/common/require.h>

#include <cmath>
#include <filesystem>

namespace pcl6d::app {

namespace {
namespace po = boost::program_options;

constexpr int kMostThreads = 1024;

/** Options as they are typed. */
struct Words {
  std::string format = "auto";
  std::string poses;
  int last = 0;
  AutoDouble min_range, max_range, voxel, noise;
  std::string method = toString(PlaneMethod::kRegionGrowing);
  std::string up = "z";
  std::string rules = "book";
  bool no_labels = false;
  bool keep_noise = false;
  int threads = 0;
};

void
describeInput(CommandLine& line, PlaneSettings& s, Words& words)
{
  line.group("Input").add_options()(
      "format", valueOf(words.format), "auto|pcd|ply|uos|kitti|xyz")(
      "poses",
      po::value(&words.poses)->value_name("FILE"),
      "poses of the scans of a folder, KITTI or TUM rows (default: those of the run, "
      "or "
      "*.pose, odometry.txt, poses.txt, PCD VIEWPOINT)")(
      "first", valueOf(s.folder.first), "index of the first scan to take")(
      "last",
      po::value(&words.last),
      "index of the last scan to take (default: the end)")(
      "every", valueOf(s.folder.every), "take each n-th scan")(
      "min-range", valueOf(words.min_range), "[m] nearer points are dropped")(
      "max-range", valueOf(words.max_range), "[m] farther points are dropped")(
      "voxel",
      valueOf(words.voxel),
      "[m] scans of a folder are joined with one point per voxel of this size");
}

void
describePlanes(CommandLine& line, PlaneSettings& s, Words& words)
{
  PlaneOptions& planes = s.step.segmentation.planes;
  line.group("Planes").add_options()(
      "method", valueOf(words.method), "region-growing|ransac|hough")(
      "min-area", valueOf(planes.min_area), "[m^2] smaller planes are dropped")(
      "min-points", valueOf(planes.min_points), "planes of fewer points are dropped")(
      "noise",
      valueOf(words.noise),
      "[m] standard deviation of a point's distance to its surface");
}

void
describeLabels(CommandLine& line, PlaneSettings& s, Words& words)
{
  line.group("Labels and refinement")
      .add_options()("no-labels",
                     po::bool_switch(&words.no_labels),
                     "only find planes, do not say what they are")(
          "rules",
          valueOf(words.rules)->value_name("FILE"),
          "book (floor, ceiling, wall, door), or a JSON file of rules")(
          "up",
          valueOf(words.up),
          "z|auto: which way is up; auto: found from the planes, for tilted maps")(
          "refine",
          po::bool_switch(&s.step.refine),
          "make labelled planes exactly parallel, orthogonal, level and upright, and "
          "put their points onto them")("keep-noise",
                                        po::bool_switch(&words.keep_noise),
                                        "turn and shift their points with them only, "
                                        "noise and all");
}

void
describe(CommandLine& line, PlaneSettings& s, Words& words)
{
  line.group("Output").add_options()(
      "output,o",
      po::value(&s.out)->value_name("OUT_DIR")->required(),
      "folder to write")(
      "force", po::bool_switch(&s.force), "accept an OUT_DIR that holds other things");
  describeInput(line, s, words);
  describePlanes(line, s, words);
  describeLabels(line, s, words);
  line.group("Run").add_options()(
      "threads", valueOf(words.threads), "0: one per core; never changes the result")(
      "quiet", po::bool_switch(&s.quiet), "print warnings and errors only")(
      "verbose", po::bool_switch(&s.verbose), "explain each label");
}

std::optional<double>
lengthOf(const AutoDouble& word)
{
  return word.is_auto ? std::nullopt : std::make_optional(word.value);
}

/** Options that count only for folders, or only with labels. */
void
judgeUse(const CommandLine& line, const Words& words, PlaneSettings& s)
{
  const bool folder = std::filesystem::is_directory(s.input);
  if (!folder)
    for (const char* const option : {"poses", "first", "last", "every", "voxel"})
      if (line.given(option))
        throw UsageError(std::string("--") + option + " needs a folder, but " +
                         s.input + " is none");
  if (words.no_labels && s.step.refine)
    throw UsageError("--refine needs labels, but --no-labels is given");
  s.without_effect =
      line.withoutEffect({{"rules", s.step.labels, "with labels"},
                          {"up", s.step.labels, "with labels"},
                          {"keep-noise", s.step.refine, "with --refine"}});
}

void
interpret(const CommandLine& line, const Words& words, PlaneSettings& s)
{
  s.folder.format = scanFormatFromName(words.format);
  s.folder.poses_file = words.poses;
  if (line.given("last"))
    s.folder.last = words.last;
  s.folder.validate();
  s.min_range = lengthOf(words.min_range);
  s.max_range = lengthOf(words.max_range);
  s.voxel = lengthOf(words.voxel);
  require(!s.voxel || *s.voxel > 0, "voxel", words.voxel.value, "> 0");
  require(words.threads >= 0 && words.threads <= kMostThreads,
          "threads",
          words.threads,
          "0 to 1024");
  s.step.num_threads = static_cast<unsigned int>(words.threads);
  PlaneFinderOptions& step = s.step;
  step.method = planeMethodFromName(words.method);
  step.noise = lengthOf(words.noise);
  require(!step.noise || *step.noise > 0, "noise", words.noise.value, "> 0");
  step.segmentation.validate();
  step.labels = !words.no_labels;
  require(words.up == "z" || words.up == "auto", "up", words.up, "z or auto");
  if (words.up == "auto")
    step.interpretation.up.reset();
  step.interpretation.validate();
  step.refinement.project = !words.keep_noise;
  step.refinement.validate();
}
} // namespace

bool
parsePlaneSettings(const std::vector<std::string>& arguments, PlaneSettings& settings)
{
  CommandLine line(
      std::string("usage: ") + kPlanes +
      " INPUT -o OUT_DIR [options]\n"
      "Finds the planes in a scan, in a folder of scans with poses, or in a run of\n"
      "pcl_slam6d, and says what they are: floor, ceiling, wall, door. Writes\n"
      "planes.json, planes.pcd (points with plane_id and label), hulls.ply and a "
      "picture.\n"
      "A scan is taken in its own frame, a folder in that of its poses.\n");
  Words words;
  line.positional("INPUT", &settings.input);
  describe(line, settings, words);
  if (!line.parse(arguments))
    return false;
  checkOptions([&] { interpret(line, words, settings); }, {{"poses_file", "poses"}});
  judgeUse(line, words, settings);
  if (settings.step.labels && words.rules != "book")
    settings.step.rules = readLabelRules(words.rules);
  return true;
}

} // namespace pcl6d::app

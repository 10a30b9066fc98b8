// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/options/option_table.h"
#include "planes/plane_settings.h"

#include <pcl6d/common/require.h>

#include <cmath>

namespace pcl6d::app {

namespace {
/** Options that are words here and are converted for the settings. */
struct Words {
  std::string up = "z";
  std::string rules = "book";
};

void
addInput(OptionTable& table, PlaneSettings& s)
{
  table.group("Input");
  table.add("format", &s.folder.format, scanFormatFromName)
      .help("auto|pcd|ply|uos|kitti|xyz|las|laz");
  table.add("poses FILE", &s.folder.poses_file)
      .help("poses of the scans of a folder, KITTI or TUM rows (default: poses of the "
            "run, or *.pose, odometry.txt, poses.txt, PCD VIEWPOINT)");
  table.add("first", &s.folder.first).help("index of the first scan to take");
  table.add("last", &s.folder.last)
      .help("index of the last scan to take (default: the end)");
  table.add("every", &s.folder.every).help("take each n-th scan");
  table.addAuto("min-range", &s.min_range).help("[m] nearer points are dropped");
  table.addAuto("max-range", &s.max_range).help("[m] farther points are dropped");
  table.addAuto("voxel", &s.voxel)
      .above(0, "> 0")
      .help("[m] voxel: scans of a folder are joined with a point per voxel");
}

void
addPlanes(OptionTable& table, PlaneSettings& s, Words& words)
{
  PlaneFinderOptions& step = s.step;
  table.group("Planes");
  const auto takeMethod = [&step](const std::string& word) {
    step.method = choosePlaneMethod(word, step.segmentation);
  };
  table.addWord("method", toString(step.method), takeMethod)
      .help(joined(planeMethodWords()) +
            ": method of plane detection; hough is hough-randomized");
  table.add("min-area", &step.segmentation.planes.min_area)
      .help("[m^2] smaller planes are dropped");
  table.add("min-points", &step.segmentation.planes.min_points)
      .help("planes of fewer points are dropped");
  table.addAuto("noise", &step.noise)
      .above(0, "> 0")
      .help("[m] standard deviation of a point's distance to the surface");
  table.group("Labels and refinement");
  table.add("no-labels", &step.labels).help("only find planes, do not label planes");
  table.add("rules FILE", &words.rules)
      .help("book (floor, ceiling, wall, door), or a JSON file of rules");
  const auto takeUp = [&step](const std::string& word) {
    require(word == "z" || word == "auto", "up", word, "z or auto");
    if (word == "auto")
      step.interpretation.up.reset();
  };
  table.addWord("up", "z", takeUp)
      .help("z|auto: upward direction; auto: found from the planes, for tilted maps");
  table.add("refine", &step.refine)
      .help("make labelled planes exactly parallel, orthogonal, level and upright, and "
            "move the points onto the planes");
  table.add("keep-noise", &step.refinement.project)
      .help("turn and shift the points with the planes only, noise included");
}

void
addOptions(OptionTable& table, PlaneSettings& s, Words& words)
{
  table.positional("INPUT", &s.input);
  table.group("Output");
  table.add("output,o OUT_DIR", &s.out).required().help("folder to write");
  table.add("force", &s.force).help("accept an OUT_DIR that is not empty");
  addInput(table, s);
  addPlanes(table, s, words);
  table.group("Run");
  table.addAs<int>("threads", &s.step.num_threads)
      .within(0, 1024, "0 to 1024")
      .help("0: a thread per core; never changes the result");
  s.memory.addTo(table);
  table.add("quiet", &s.quiet).help("print warnings and errors only");
  table.add("verbose", &s.verbose).help("explain each label");
}

/** Checks options that need a folder, or labels. */
void
checkUse(const OptionTable& table, PlaneSettings& s)
{
  table.needFolder(s.input, {"poses", "first", "last", "every", "voxel"});
  if (!s.step.labels && s.step.refine)
    throw UsageError("--refine needs labels, but --no-labels is given");
  s.without_effect =
      table.withoutEffect({{"rules", s.step.labels, "with labels"},
                           {"up", s.step.labels, "with labels"},
                           {"keep-noise", s.step.refine, "with --refine"}});
}
} // namespace

bool
parsePlaneSettings(const std::vector<std::string>& arguments, PlaneSettings& settings)
{
  OptionTable table(std::string("usage: ") + kPlanes +
                    R"( INPUT -o OUT_DIR [options]
Finds the planes in a scan, in a folder of scans with poses, or in a run of
pcl_slam6d, and labels the planes: floor, ceiling, wall, door. Writes
planes.json, planes.pcd (points with plane_id and label), hulls.ply and a picture.
The planes of a scan are in the frame of the scan, of a folder in the frame of the poses.
)");
  Words words;
  addOptions(table, settings, words);
  if (!table.parse(arguments))
    return false;
  table.check([&] {
    settings.folder.validate();
    settings.step.segmentation.validate();
    settings.step.interpretation.validate();
    settings.step.refinement.validate();
  });
  checkUse(table, settings);
  if (settings.step.labels && words.rules != "book") {
    settings.rules_file = words.rules;
    settings.step.rules = readLabelRules(words.rules);
  }
  return true;
}

} // namespace pcl6d::app

// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/options/option_table.h"
#include "objects/locate_settings.h"
#include "objects/verbs.h"

#include <pcl6d/common/require.h>

namespace pcl6d::app {
namespace {
std::string
usageOfLocate()
{
  return std::string("usage: ") + kObjects +
         R"( locate INPUT --model MODEL... -o OUT_DIR [options]
Finds objects of known shape in a scan, in each scan of a folder with poses, or of a
run of pcl_slam6d, and their poses in six degrees of freedom. A MODEL is a mesh (.ply,
.obj, .stl), a cloud (.pcd, ...) or a folder of the model store (share/models); a single
model and no training are enough. Writes objects.json and the scans with object_id.
)";
}

void
addFiles(OptionTable& table, LocateSettings& s)
{
  table.group("Files");
  table.add("output,o OUT_DIR", &s.out).required().help("folder to write");
  table.add("force", &s.force).help("accept an OUT_DIR that is not empty");
  table.add("model MODEL", &s.models)
      .composing()
      .multitoken()
      .help("model to search for; several may follow, and the option may be repeated");
  table.add("store DIR", &s.store)
      .help("the models of a store, for example share/models");
  table.add("scale", &s.file.units.scale)
      .above(0, "> 0")
      .help("[m] per unit of model files: 0.001 for mm");
  table.add("up", &s.file.units.up, {{"y", UpAxis::kY}, {"z", UpAxis::kZ}})
      .help("y|z: upward axis of model files");
  const auto takeClass = [&s](const std::string& name) {
    checkObjectClass(name);
    s.file.object_class = name;
  };
  table.addWord("class NAME", "", takeClass)
      .help("of a model file (default: the file name)");
}

void
addInput(OptionTable& table, LocateSettings& s)
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
  table.add("min-range", &s.min_range)
      .within(0, kNoBound, ">= 0")
      .help("[m] nearer points are dropped");
  table.add("max-range", &s.max_range)
      .help(
          "[m] farther points are dropped; 0: drop only the points dropped by the run");
}

/** Chooses the cascades of a model, and the rule that joins them. */
void
takeRule(const std::string& rule, ObjectFinderOptions& finder)
{
  finder.use_range = rule != "reflectance";
  finder.use_reflectance = rule != "range";
  if (!finder.use_range || !finder.use_reflectance)
    return;
  require(rule == "and" || rule == "or", "rule", rule, "and, or, range or reflectance");
  finder.detector.rule = detectionRuleFromName(rule);
}

void
addSearch(OptionTable& table, LocateSettings& s)
{
  LocalizerOptions& o = s.finder.localizer;
  table.group("Search");
  table.add("proposals", &s.finder.proposals, proposalMethodFromName, "auto")
      .help("auto|clusters|features|cascade: candidates: clusters of points on planes, "
            "pairs of points anywhere, or detections by the cascades of the model; "
            "auto: clusters, then features if no object is found");
  table.addWord("rule", "and", [&s](const auto& rule) { takeRule(rule, s.finder); })
      .help("and|or|range|reflectance: of the two cascades of a model, both must "
            "detect, either, or only the given channel is used");
  table.add("min-visible", &o.min_visible)
      .help("least share seen of the surface facing the scanner");
  table.add("min-agreement", &o.min_agreement)
      .help("least share that fits of the surface seen");
  table.add("max-violation", &o.max_violation)
      .help("largest share of the surface with rays passing through");
  table.add("min-support", &o.min_support)
      .help("least number of surface patches of the scan on an object");
  table.add("separate", &s.fuse)
      .help("keep the object of each scan, do not merge detections of one object by "
            "several scans");
  table.group("Run");
  table.addAs<int>("threads", &o.num_threads)
      .within(0, 1024, "0 to 1024")
      .help("0: a thread per core; never changes the result");
  table.add("quiet", &s.quiet).help("print warnings and errors only");
}

void
checkUse(const OptionTable& table, LocateSettings& s)
{
  if (s.models.empty() && s.store.empty())
    throw UsageError("give the objects to search for: --model MODEL, or --store DIR");
  if (table.given("class") && s.models.size() != 1)
    throw UsageError("--class names one model, but " + std::to_string(s.models.size()) +
                     " are given");
  table.needFolder(s.input, {"poses", "first", "last", "every", "separate"});
  s.without_effect =
      table.withoutEffect({{"rule",
                            s.finder.proposals == ProposalMethod::kCascade,
                            "with --proposals cascade"}});
}
} // namespace

bool
parseLocate(const std::vector<std::string>& arguments, LocateSettings& settings)
{
  OptionTable table(usageOfLocate());
  table.positional("INPUT", &settings.input);
  addFiles(table, settings);
  addInput(table, settings);
  addSearch(table, settings);
  if (!table.parse(arguments))
    return false;
  table.check([&] {
    settings.folder.validate();
    require(settings.max_range == 0 || settings.max_range > settings.min_range,
            "max_range",
            settings.max_range,
            "0 or > --min-range");
    settings.finder.localizer.validate();
  });
  checkUse(table, settings);
  return true;
}

} // namespace pcl6d::app

// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/option_table.h"
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
  table.add("force", &s.force).help("accept an OUT_DIR that holds other things");
  table.add("model MODEL", &s.models)
      .composing()
      .multitoken()
      .help("what to look for; several may follow, and it may be repeated");
  table.add("store DIR", &s.store).help("all models of a store, such as share/models");
  table.add("scale", &s.file.units.scale)
      .above(0, "> 0")
      .help("[m] per unit of model files: 0.001 if they are in mm");
  table.add("up", &s.file.units.up, {{"y", UpAxis::kY}, {"z", UpAxis::kZ}})
      .help("y|z: axis of model files that points up");
  const auto takeClass = [&s](const std::string& name) {
    checkObjectClass(name);
    s.file.object_class = name;
  };
  table.addWord("class NAME", "", takeClass)
      .help("of a model file (default: its name)");
}

void
addInput(OptionTable& table, LocateSettings& s)
{
  table.group("Input");
  table.add("format", &s.folder.format, scanFormatFromName)
      .help("auto|pcd|ply|uos|kitti|xyz");
  table.add("poses FILE", &s.folder.poses_file)
      .help("poses of the scans of a folder, KITTI or TUM rows (default: those of the "
            "run, or *.pose, odometry.txt, poses.txt, PCD VIEWPOINT)");
  table.add("first", &s.folder.first).help("index of the first scan to take");
  table.add("last", &s.folder.last)
      .help("index of the last scan to take (default: the end)");
  table.add("every", &s.folder.every).help("take each n-th scan");
  table.add("min-range", &s.min_range)
      .within(0, kNoBound, ">= 0")
      .help("[m] nearer points are dropped");
  table.add("max-range", &s.max_range)
      .help("[m] farther points are dropped; 0: none, but of a run what it dropped");
}

/** Which of a model's cascades are asked, and how their answers are joined. */
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
      .help("auto|clusters|features|cascade: where to look: at what stands on planes, "
            "anywhere by pairs of points, where the model's cascades see one; auto: "
            "clusters, and features if that finds none");
  table.addWord("rule", "and", [&s](const auto& rule) { takeRule(rule, s.finder); })
      .help(
          "and|or|range|reflectance: of the two cascades of a model, both must see it, "
          "either, or only this one is asked");
  table.add("min-visible", &o.min_visible)
      .help("share of the surface that faces the scanner which must be seen");
  table.add("min-agreement", &o.min_agreement)
      .help("share of the surface seen there which must fit");
  table.add("max-violation", &o.max_violation)
      .help("share of it where the scanner may have seen through");
  table.add("min-support", &o.min_support)
      .help("pieces of the scan's surface that must be on an object");
  table.add("separate", &s.fuse)
      .help(
          "keep what each scan saw, do not join what several scans saw of one object");
  table.group("Run");
  table.addAs<int>("threads", &o.num_threads)
      .within(0, 1024, "0 to 1024")
      .help("0: one per core; never changes the result");
  table.add("quiet", &s.quiet).help("print warnings and errors only");
}

void
judgeUse(const OptionTable& table, LocateSettings& s)
{
  if (s.models.empty() && s.store.empty())
    throw UsageError("give what to look for: --model MODEL, or --store DIR");
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
  judgeUse(table, settings);
  return true;
}

} // namespace pcl6d::app

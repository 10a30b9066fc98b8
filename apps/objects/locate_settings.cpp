// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/command_line.h"
#include "objects/locate_settings.h"
#include "objects/verbs.h"

#include <pcl6d/common/require.h>

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
  std::string up = "z";
  std::string object_class;
  std::string proposals = "auto";
  std::string rule = "and";
  int threads = 0;
};

std::string
usage()
{
  return std::string("usage: ") + kObjects +
         " locate INPUT --model MODEL... -o OUT_DIR [options]\n"
         "Finds objects of known shape in a scan, in each scan of a folder with poses, "
         "or of a\nrun of pcl_slam6d, and their poses in six degrees of freedom. A "
         "MODEL "
         "is a mesh (.ply,\n.obj, .stl), a cloud (.pcd, ...) or a folder of the model "
         "store (share/models); a single\nmodel and no training are enough. Writes "
         "objects.json and the scans with object_id.\n";
}

void
describeFiles(LocateSettings& s, Words& words, CommandLine& line)
{
  line.group("Files").add_options() //
      ("output,o",
       po::value(&s.out)->value_name("OUT_DIR")->required(),
       "folder to write") //
      ("force",
       po::bool_switch(&s.force),
       "accept an OUT_DIR that holds other things") //
      ("model",
       po::value(&s.models)->value_name("MODEL")->composing()->multitoken(),
       "what to look for; several may follow, and it may be repeated") //
      ("store",
       po::value(&s.store)->value_name("DIR"),
       "all models of a store, such as share/models") //
      ("scale",
       valueOf(s.file.units.scale),
       "[m] per unit of model files: 0.001 if they are in mm")             //
      ("up", valueOf(words.up), "y|z: axis of model files that points up") //
      ("class",
       po::value(&words.object_class)->value_name("NAME"),
       "of a model file (default: its name)");
}

void
describeInput(LocateSettings& s, Words& words, CommandLine& line)
{
  line.group("Input").add_options()                                   //
      ("format", valueOf(words.format), "auto|pcd|ply|uos|kitti|xyz") //
      ("poses",
       po::value(&words.poses)->value_name("FILE"),
       "poses of the scans of a folder, KITTI or TUM rows (default: those of the run, "
       "or "
       "*.pose, odometry.txt, poses.txt, PCD VIEWPOINT)")                   //
      ("first", valueOf(s.folder.first), "index of the first scan to take") //
      ("last",
       po::value(&words.last),
       "index of the last scan to take (default: the end)")                //
      ("every", valueOf(s.folder.every), "take each n-th scan")            //
      ("min-range", valueOf(s.min_range), "[m] nearer points are dropped") //
      ("max-range",
       valueOf(s.max_range),
       "[m] farther points are dropped; 0: none, but of a run what it dropped");
}

void
describeSearch(LocateSettings& s, Words& words, CommandLine& line)
{
  LocalizerOptions& o = s.finder.localizer;
  line.group("Search").add_options() //
      ("proposals",
       valueOf(words.proposals),
       "auto|clusters|features|cascade: where to look: at what stands on planes, "
       "anywhere by pairs of points, where the model's cascades see one; auto: "
       "clusters, "
       "and features if that finds none") //
      ("rule",
       valueOf(words.rule),
       "and|or|range|reflectance: of the two cascades of a model, both must see it, "
       "either, or only this one is asked") //
      ("min-visible",
       valueOf(o.min_visible),
       "share of the surface that faces the scanner which must be seen") //
      ("min-agreement",
       valueOf(o.min_agreement),
       "share of the surface seen there which must fit") //
      ("max-violation",
       valueOf(o.max_violation),
       "share of it where the scanner may have seen through") //
      ("min-support",
       valueOf(o.min_support),
       "pieces of the scan's surface that must be on an object") //
      ("separate",
       po::bool_switch()->notifier([&s](bool given) { s.fuse = !given; }),
       "keep what each scan saw, do not join what several scans saw of one object");
  line.group("Run").add_options()(
      "threads", valueOf(words.threads), "0: one per core; never changes the result")(
      "quiet", po::bool_switch(&s.quiet), "print warnings and errors only");
}

void
interpret(const CommandLine& line, const Words& words, LocateSettings& s)
{
  s.folder.format = scanFormatFromName(words.format);
  s.folder.poses_file = words.poses;
  if (line.given("last"))
    s.folder.last = words.last;
  s.folder.validate();
  require(words.up == "y" || words.up == "z", "up", words.up, "y or z");
  s.file.units.up = words.up == "y" ? UpAxis::kY : UpAxis::kZ;
  require(s.file.units.scale > 0, "scale", s.file.units.scale, "> 0");
  if (line.given("class")) {
    checkObjectClass(words.object_class);
    s.file.object_class = words.object_class;
  }
  require(s.min_range >= 0, "min_range", s.min_range, ">= 0");
  require(s.max_range == 0 || s.max_range > s.min_range,
          "max_range",
          s.max_range,
          "0 or > --min-range");
  require(words.threads >= 0 && words.threads <= kMostThreads,
          "threads",
          words.threads,
          "0 to 1024");
  s.finder.localizer.num_threads = static_cast<unsigned int>(words.threads);
  s.finder.localizer.validate();
  s.finder.proposals = proposalMethodFromName(words.proposals);
  s.finder.use_range = words.rule != "reflectance";
  s.finder.use_reflectance = words.rule != "range";
  if (s.finder.use_range && s.finder.use_reflectance) {
    require(words.rule == "and" || words.rule == "or",
            "rule",
            words.rule,
            "and, or, range or reflectance");
    s.finder.detector.rule = detectionRuleFromName(words.rule);
  }
}

void
judgeUse(const CommandLine& line, LocateSettings& s)
{
  if (s.models.empty() && s.store.empty())
    throw UsageError("give what to look for: --model MODEL, or --store DIR");
  if (line.given("class") && s.models.size() != 1)
    throw UsageError("--class names one model, but " + std::to_string(s.models.size()) +
                     " are given");
  if (!std::filesystem::is_directory(s.input))
    for (const char* const option : {"poses", "first", "last", "every", "separate"})
      if (line.given(option))
        throw UsageError(std::string("--") + option + " needs a folder, but " +
                         s.input + " is none");
  s.without_effect =
      line.withoutEffect({{"rule",
                           s.finder.proposals == ProposalMethod::kCascade,
                           "with --proposals cascade"}});
}
} // namespace

bool
parseLocate(const std::vector<std::string>& arguments, LocateSettings& settings)
{
  CommandLine line(usage());
  Words words;
  line.positional("INPUT", &settings.input);
  describeFiles(settings, words, line);
  describeInput(settings, words, line);
  describeSearch(settings, words, line);
  if (!line.parse(arguments))
    return false;
  checkOptions([&] { interpret(line, words, settings); },
               {{"poses_file", "poses"},
                {"min_visible", "min-visible"},
                {"min_agreement", "min-agreement"},
                {"max_violation", "max-violation"},
                {"min_support", "min-support"}});
  judgeUse(line, settings);
  return true;
}

} // namespace pcl6d::app

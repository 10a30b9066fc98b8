// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "common/options/option_table.h"
#include "objects/train_settings.h"
#include "objects/verbs.h"

#include <cmath>
#include <filesystem>

namespace pcl6d::app {
namespace {
/** Options that are converted for the settings. */
struct Words {
  std::string scanner = "rotating";
  std::optional<double> resolution; // [deg]
  std::optional<double> pixel;      // [deg]
};

std::optional<double>
radians(const std::optional<double>& degrees)
{
  return degrees ? std::make_optional(*degrees * M_PI / 180) : std::nullopt;
}

std::string
usageOfTrain()
{
  return std::string("usage: ") + kObjects +
         R"( train MODEL... --background SCANS -o CASCADE.xml [options]
Trains a detector for one class of objects. The models (meshes .ply, .obj, .stl,
clouds, or folders of a model store) stand upright in free places of the background
scans and are measured there by a simulated scanner; the background must not hold the
object. CASCADE.xml is read by the job locate and by OpenCV 4 (cv::CascadeClassifier).
The work done is kept in the state folder: the same command goes on after a stop.
)";
}

void
addFiles(OptionTable& table, TrainSettings& s)
{
  table.positionals("MODEL", &s.models);
  table.group("Files");
  table.add("output,o FILE", &s.output).required().help("the cascade");
  table.add("background SCANS", &s.backgrounds)
      .composing()
      .required()
      .help("folder of scans, or a scan, without the object; may be repeated");
  table.add("every N", &s.every)
      .within(1, kNoBound, ">= 1")
      .help("take each n-th scan of a folder");
  table.add("state DIR", &s.state)
      .help("where to keep finished stages; else the output's name with .training");
  table.add("scale", &s.mesh.scale)
      .above(0, "> 0", kFinite)
      .help("[m] per unit of the models: 0.001 for mm");
  table.add("up", &s.mesh.up, {{"y", UpAxis::kY}, {"z", UpAxis::kZ}})
      .help("upward axis of the models: y or z");
}

void
addPictures(OptionTable& table, TrainSettings& s, Words& words)
{
  TrainingImageOptions& i = s.images;
  table.group("Pictures");
  table.add("scanner", &words.scanner)
      .help("simulated scanner, see pcl_slam6d_simulate --help");
  table.addAuto("resolution", &words.resolution)
      .help("[deg] between samples of the scanner; auto: from the scanner");
  table
      .add("channel",
           &i.channel,
           {{"range", ImageChannel::kRange},
            {"reflectance", ImageChannel::kReflectance}})
      .help("channel of the detector: range or reflectance");
  table.addAuto("pixel", &words.pixel)
      .help("[deg] of the pictures; auto: at most 0.5, with the object in the window "
            "up to --max-distance");
  table.add("slice-depth", &s.views.slice_depth).help("[m] of a picture of ranges");
  table.add("max-range", &s.views.max_range).help("[m] of the scans");
  table.add("positives N", &i.positives).help("pictures of the object");
  table.add("min-distance", &i.min_distance).help("[m] of the object in plan");
  table.add("max-distance", &i.max_distance).help("[m]");
  table.add("min-visible", &i.min_visible).help("least visible share of the object");
  table.add("min-reflectance", &i.min_reflectance).help("of the object, 0 to 1");
  table.add("max-reflectance", &i.max_reflectance).help("drawn between both");
}

void
addTraining(OptionTable& table, TrainSettings& s)
{
  CascadeTrainingOptions& t = s.training;
  table.group("Training");
  table.add("stages N", &t.stages).help("at most");
  table.add("negatives N", &t.negatives)
      .help("for each stage, false alarms of the stages before");
  table.add("min-hit-rate", &t.min_hit_rate).help("of each stage");
  table.add("max-false-alarm", &t.max_false_alarm).help("of each stage");
  table.add("target-false-alarm", &t.target_false_alarm)
      .help("on the backgrounds; training then ends");
  table.add("splits", &t.splits).help("of each tree; 1: stumps");
  table.add("max-trees", &t.max_trees).help("of a stage");
  table.add("features", &t.features, haarFeatureSetFromName, "all")
      .help("upright|all: only upright features, or tilted features too");
  table.add("features-per-stage", &t.features_per_stage)
      .help("features drawn for each stage");
  table.add("features-per-tree", &t.features_per_tree)
      .help("features of a stage drawn for each tree");
  table.add("seed", &t.seed).help("same seed, same cascade");
  table.add("threads N", &t.num_threads)
      .help("0: a thread per core; never changes the result");
  table.add("quiet", &s.quiet).help("no progress");
}

void
apply(const Words& words, TrainSettings& s)
{
  s.scanner = scannerByName(words.scanner, radians(words.resolution));
  s.views.pixel = radians(words.pixel).value_or(DetectionViewOptions().pixel);
  s.views.num_threads = s.training.num_threads;
  s.images.seed = s.training.seed;
  s.views.validate();
  if (!words.pixel)
    s.views.pixel = 0; // chosen for the models
  s.images.validate();
  s.training.validate();
}
} // namespace

bool
parseTrain(const std::vector<std::string>& arguments, TrainSettings& s)
{
  OptionTable table(usageOfTrain());
  Words words;
  addFiles(table, s);
  addPictures(table, s, words);
  addTraining(table, s);
  if (!table.parse(arguments))
    return false;
  table.check([&] { apply(words, s); });
  refuseInputs(s.output, s.models);
  refuseInputs(s.output, s.backgrounds);
  if (s.state.empty())
    s.state = std::filesystem::path(s.output).replace_extension(".training").string();
  s.training.state = s.state;
  return true;
}

} // namespace pcl6d::app

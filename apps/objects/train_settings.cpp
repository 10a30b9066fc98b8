// SPDX-License-Identifier: BSD-3-Clause
#include "common/app.h"
#include "objects/train_settings.h"
#include "objects/verbs.h"

#include <pcl6d/common/require.h>

#include <cmath>
#include <filesystem>

namespace pcl6d::app {
namespace {
namespace po = boost::program_options;

/** Options that are words or degrees on the command line. */
struct Words {
  std::string up = "z";
  std::string scanner = "rotating";
  std::string channel = "range";
  std::string features = "all";
  AutoDouble resolution; // [deg]
  AutoDouble pixel;      // [deg]
};

std::string
usage()
{
  return std::string("usage: ") + kObjects +
         " train MODEL... --background SCANS -o CASCADE.xml [options]\n"
         "Trains a detector for one class of objects. The models (meshes .ply, .obj, "
         ".stl,\nclouds, or folders of a model store) stand upright in free places of "
         "the background scans, "
         "which "
         "must not hold\nthe object, and are measured there by a simulated scanner. "
         "CASCADE.xml is read by\nthe job locate and by OpenCV 4 "
         "(cv::CascadeClassifier). "
         "What is done is kept in the\nstate folder: the same command goes on where it "
         "was stopped.\n";
}

void
describeFiles(TrainSettings& s, Words& words, CommandLine& line)
{
  line.group("Files").add_options() //
      ("output,o",
       po::value(&s.output)->value_name("FILE")->required(),
       "the cascade") //
      ("background",
       po::value(&s.backgrounds)->value_name("SCANS")->composing()->required(),
       "folder of scans, or a scan, without the object; may be repeated")             //
      ("every", valueOf(s.every)->value_name("N"), "take each n-th scan of a folder") //
      ("state",
       po::value(&s.state)->value_name("DIR"),
       "where to keep finished stages; else the output's name with .training") //
      ("scale",
       valueOf(s.mesh.scale),
       "[m] per unit of the models: 0.001 if they are in mm") //
      ("up", valueOf(words.up), "axis of the models that points up: y or z");
}

void
describePictures(TrainSettings& s, Words& words, CommandLine& line)
{
  TrainingImageOptions& i = s.images;
  line.group("Pictures")
      .add_options() //
      ("scanner",
       valueOf(words.scanner),
       "that measures, see pcl_slam6d_simulate --help") //
      ("resolution",
       valueOf(words.resolution),
       "[deg] between its samples; auto: its own") //
      ("channel",
       valueOf(words.channel),
       "what the detector looks at: range or reflectance") //
      ("pixel",
       valueOf(words.pixel),
       "[deg] of the pictures; auto: at most 0.5, so that the window holds the object "
       "up "
       "to --max-distance")                                                          //
      ("slice-depth", valueOf(s.views.slice_depth), "[m] of a picture of ranges")    //
      ("max-range", valueOf(s.views.max_range), "[m] of the scans")                  //
      ("positives", valueOf(i.positives)->value_name("N"), "pictures of the object") //
      ("min-distance", valueOf(i.min_distance), "[m] of the object in plan")         //
      ("max-distance", valueOf(i.max_distance), "[m]")                               //
      ("min-visible",
       valueOf(i.min_visible),
       "share of the object that is not hidden")                               //
      ("min-reflectance", valueOf(i.min_reflectance), "of the object, 0 to 1") //
      ("max-reflectance", valueOf(i.max_reflectance), "drawn between both");
}

void
describeTraining(TrainSettings& s, Words& words, CommandLine& line)
{
  CascadeTrainingOptions& t = s.training;
  line.group("Training")
      .add_options()                                            //
      ("stages", valueOf(t.stages)->value_name("N"), "at most") //
      ("negatives",
       valueOf(t.negatives)->value_name("N"),
       "for each stage, false alarms of those before")                 //
      ("min-hit-rate", valueOf(t.min_hit_rate), "of each stage")       //
      ("max-false-alarm", valueOf(t.max_false_alarm), "of each stage") //
      ("target-false-alarm",
       valueOf(t.target_false_alarm),
       "on the backgrounds; then it ends")                                            //
      ("splits", valueOf(t.splits), "of each tree; 1: stumps")                        //
      ("max-trees", valueOf(t.max_trees), "of a stage")                               //
      ("features", valueOf(words.features), "upright|all: with all, tilted ones too") //
      ("features-per-stage",
       valueOf(t.features_per_stage),
       "drawn from them for each stage") //
      ("features-per-tree",
       valueOf(t.features_per_tree),
       "drawn from those for each tree")                   //
      ("seed", valueOf(t.seed), "same seed, same cascade") //
      ("threads",
       valueOf(t.num_threads)->value_name("N"),
       "0: one per core; never changes the result") //
      ("quiet", po::bool_switch(&s.quiet), "no progress");
}

void
apply(const Words& words, TrainSettings& s)
{
  require(words.up == "y" || words.up == "z", "up", words.up, "y or z");
  s.mesh.up = words.up == "y" ? UpAxis::kY : UpAxis::kZ;
  require(
      s.mesh.scale > 0 && std::isfinite(s.mesh.scale), "scale", s.mesh.scale, "> 0");
  require(s.every >= 1, "every", s.every, ">= 1");
  require(words.channel == "range" || words.channel == "reflectance",
          "channel",
          words.channel,
          "range or reflectance");
  s.images.channel =
      words.channel == "range" ? ImageChannel::kRange : ImageChannel::kReflectance;
  std::optional<double> resolution;
  if (!words.resolution.is_auto)
    resolution = words.resolution.value * M_PI / 180;
  s.scanner = scannerByName(words.scanner, resolution);
  s.training.features = haarFeatureSetFromName(words.features);
  s.views.pixel = DetectionViewOptions().pixel;
  if (!words.pixel.is_auto)
    s.views.pixel = words.pixel.value * M_PI / 180;
  s.views.num_threads = s.training.num_threads;
  s.images.seed = s.training.seed;
  s.views.validate();
  if (words.pixel.is_auto)
    s.views.pixel = 0; // the models tell
  s.images.validate();
  s.training.validate();
}
} // namespace

bool
parseTrain(const std::vector<std::string>& arguments, TrainSettings& s)
{
  CommandLine line(usage());
  Words words;
  line.positionals("MODEL", &s.models);
  describeFiles(s, words, line);
  describePictures(s, words, line);
  describeTraining(s, words, line);
  if (!line.parse(arguments))
    return false;
  checkOptions([&] { apply(words, s); });
  std::error_code missing; // a missing file is no input
  for (const auto& inputs : {s.models, s.backgrounds})
    for (const auto& input : inputs)
      if (std::filesystem::equivalent(s.output, input, missing))
        throw UsageError("--output = " + s.output + ", but that is an input");
  if (s.state.empty())
    s.state = std::filesystem::path(s.output).replace_extension(".training").string();
  s.training.state = s.state;
  return true;
}

} // namespace pcl6d::app

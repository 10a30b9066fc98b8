// SPDX-License-Identifier: BSD-3-Clause
#include "cascade/negative_windows.h"
#include "cascade/stage_training.h"
#include "cascade/training_state.h"

#include <pcl6d/common/random.h>
#include <pcl6d/common/require.h>
#include <pcl6d/object_localization/boosting.h>
#include <pcl6d/object_localization/cascade_evaluator.h>

#include <algorithm>

namespace pcl6d {
using namespace object_localization;

namespace {
constexpr std::size_t kFewestPositives = 10;
constexpr std::size_t kFewestNegatives = 10; // fewer are not representative

/** \return a share of the features, drawn by the seed, in their order */
std::vector<HaarFeature>
drawFeatures(const std::vector<HaarFeature>& all, std::size_t count, std::uint64_t seed)
{
  std::vector<HaarFeature> some;
  for (const std::size_t place : drawn(all.size(), count, seed))
    some.push_back(all[place]);
  return some;
}

/** \return the windows that pass every stage of the cascade */
std::vector<GrayImage>
passing(const HaarCascade& cascade, const std::vector<GrayImage>& windows)
{
  const CascadeEvaluator evaluator(cascade, cascade.width + 1);
  std::vector<GrayImage> passed;
  for (const auto& window : windows)
    if (evaluator.stagesPassed(IntegralImage(window), 0, 0) == evaluator.numStages())
      passed.push_back(window);
  return passed;
}

void
checkPositives(const std::vector<GrayImage>& positives,
               const CascadeTrainingOptions& options)
{
  for (std::size_t i = 0; i < positives.size(); ++i)
    if (positives[i].cols != options.width || positives[i].rows != options.height)
      throw BadArgument("positive " + std::to_string(i) + " has " +
                        std::to_string(positives[i].cols) + " x " +
                        std::to_string(positives[i].rows) + " pixels, but the window " +
                        std::to_string(options.width) + " x " +
                        std::to_string(options.height));
}

/** One training: the data shared by its stages. */
class Trainer {
public:
  Trainer(const std::vector<GrayImage>& positives,
          const std::vector<BackgroundImage>& backgrounds,
          const CascadeTrainingOptions& options,
          const ProgressCallback& progress)
  : positives_(positives)
  , finder_(backgrounds, options.scale_factor, options.num_threads)
  , options_(options)
  , progress_(progress)
  , features_(haarFeatures(options.width, options.height, options.features))
  {}

  /** \return false at the end of the training */
  bool
  addStage(CascadeTraining& training)
  {
    const auto index = static_cast<std::uint64_t>(training.cascade.stages.size());
    const std::uint64_t seed = mixBits(mixBits(options_.seed) ^ index);
    const auto positives = passing(training.cascade, positives_);
    require(positives.size() >= kFewestPositives,
            "positives with contrast",
            positives.size(),
            ">= " + std::to_string(kFewestPositives));
    tell("negatives", index);
    const NegativeWindows negatives =
        finder_.find(training.cascade, wanted(positives.size()), seed);
    if (index == 0 && negatives.windows.size() < kFewestNegatives)
      throw BadArgument("the backgrounds have " +
                        std::to_string(negatives.windows.size()) +
                        " windows with contrast, but must have at least " +
                        std::to_string(kFewestNegatives));
    const double background =
        static_cast<double>(negatives.passed) / static_cast<double>(negatives.tested);
    if (negatives.windows.size() < kFewestNegatives ||
        background <= options_.target_false_alarm) {
      training.end = TrainingEnd::kTargetReached;
      return false;
    }
    tell("boosting", index);
    TrainedStage trained =
        trainStage(positives,
                   negatives.windows,
                   drawFeatures(features_, options_.features_per_stage, mixBits(seed)),
                   options_,
                   mixBits(~seed));
    trained.report.background = background;
    if (!trained.reached)
      training.end = TrainingEnd::kCannotSeparate;
    if (trained.stage.trees.empty())
      return false;
    append(training.cascade, trained);
    training.stages.push_back(trained.report);
    return true;
  }

private:
  std::size_t
  wanted(std::size_t num_positives) const
  {
    const std::size_t room = SortedFeatures::kMostWindows - num_positives;
    return std::min(options_.negatives, room);
  }

  void
  tell(const char* what, std::uint64_t stage) const
  {
    if (progress_)
      progress_({std::string(what) + " of stage " + std::to_string(stage + 1),
                 static_cast<std::size_t>(stage),
                 static_cast<std::size_t>(options_.stages)});
  }

  const std::vector<GrayImage>& positives_;
  NegativeFinder finder_;
  const CascadeTrainingOptions& options_;
  const ProgressCallback& progress_;
  std::vector<HaarFeature> features_;
};
} // namespace

void
CascadeTrainingOptions::validate() const
{
  require(width >= 4 && width <= 128, "width", width, "in [4, 128]");
  require(height >= 4 && height <= 128, "height", height, "in [4, 128]");
  require(features_per_stage > 0, "features_per_stage", features_per_stage, "> 0");
  require(features_per_tree > 0, "features_per_tree", features_per_tree, "> 0");
  require(stages > 0, "stages", stages, "> 0");
  require(splits >= 1 && splits <= 16, "splits", splits, "in [1, 16]");
  require(max_trees > 0, "max_trees", max_trees, "> 0");
  require(
      min_hit_rate > 0 && min_hit_rate <= 1, "min_hit_rate", min_hit_rate, "in (0, 1]");
  require(max_false_alarm > 0 && max_false_alarm < 1,
          "max_false_alarm",
          max_false_alarm,
          "in (0, 1)");
  require(negatives >= kFewestNegatives && negatives <= 20000,
          "negatives",
          negatives,
          "in [10, 20000]");
  require(target_false_alarm >= 0 && target_false_alarm < 1,
          "target_false_alarm",
          target_false_alarm,
          "in [0, 1)");
  require(
      scale_factor > 1 && scale_factor <= 2, "scale_factor", scale_factor, "in (1, 2]");
}

CascadeTraining
trainCascade(const std::vector<GrayImage>& positives,
             const std::vector<BackgroundImage>& backgrounds,
             const CascadeTrainingOptions& options,
             const std::function<void(const StageReport&)>& on_stage,
             const ProgressCallback& progress)
{
  options.validate();
  checkPositives(positives, options);
  require(positives.size() <= SortedFeatures::kMostPositives,
          "number of positives",
          positives.size(),
          "<= " + std::to_string(SortedFeatures::kMostPositives));
  CascadeTraining training;
  training.cascade.width = options.width;
  training.cascade.height = options.height;
  const TrainingState state(options.state, positives, backgrounds, options);
  state.load(training);
  if (!training.stages.empty() &&
      training.stages.back().false_alarm > options.max_false_alarm)
    training.end = TrainingEnd::kCannotSeparate;
  if (on_stage)
    for (const auto& stage : training.stages)
      on_stage(stage);
  Trainer trainer(positives, backgrounds, options, progress);
  while (training.end == TrainingEnd::kAllStages &&
         static_cast<int>(training.stages.size()) < options.stages &&
         trainer.addStage(training)) {
    state.save(training);
    if (on_stage)
      on_stage(training.stages.back());
  }
  return training;
}

} // namespace pcl6d

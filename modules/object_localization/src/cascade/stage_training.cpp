// SPDX-License-Identifier: BSD-3-Clause
#include "cascade/stage_training.h"

#include <pcl6d/common/random.h>
#include <pcl6d/object_localization/boosting.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <tuple>

namespace pcl6d::object_localization {
namespace {
/** Numbers of positives and negatives, and error rates at a threshold. */
struct Classes {
  std::size_t positives;
  std::size_t negatives;

  /** \return the largest threshold at which the wanted share of positives passes */
  float
  threshold(const std::vector<double>& sums, double min_hit_rate) const
  {
    const auto end = sums.begin() + static_cast<std::ptrdiff_t>(positives);
    std::vector<double> answers(sums.begin(), end);
    const auto may_fail = static_cast<std::ptrdiff_t>(
        std::floor((1 - min_hit_rate) * static_cast<double>(positives) + 1e-9));
    const auto lowest = answers.begin() + may_fail;
    std::nth_element(answers.begin(), lowest, answers.end());
    return static_cast<float>(*lowest);
  }

  void
  rate(const std::vector<double>& sums,
       const HaarStage& stage,
       StageReport& report) const
  {
    const auto passes = [&](double sum) { return sum >= stage.limit(); };
    const auto middle = sums.begin() + static_cast<std::ptrdiff_t>(positives);
    const auto hits = std::count_if(sums.begin(), middle, passes);
    const auto alarms = std::count_if(middle, sums.end(), passes);
    report.hit_rate = static_cast<double>(hits) / static_cast<double>(positives);
    report.false_alarm = static_cast<double>(alarms) / static_cast<double>(negatives);
  }
};

bool
sameFeature(const HaarFeature& a, const HaarFeature& b)
{
  bool same = a.tilted == b.tilted;
  for (std::size_t i = 0; i < a.rects.size(); ++i)
    same = same && a.rects[i].rect == b.rects[i].rect &&
           a.rects[i].weight == b.rects[i].weight;
  return same;
}

int
placeOf(const HaarFeature& feature, std::vector<HaarFeature>& features)
{
  const auto found =
      std::find_if(features.begin(), features.end(), [&](const HaarFeature& f) {
        return sameFeature(f, feature);
      });
  const auto place = static_cast<int>(found - features.begin());
  if (found == features.end())
    features.push_back(feature);
  return place;
}
} // namespace

std::vector<std::size_t>
drawn(std::size_t size, std::size_t count, std::uint64_t seed)
{
  std::vector<std::size_t> places(size);
  std::iota(places.begin(), places.end(), std::size_t{0});
  if (count >= size)
    return places;
  const auto end = places.begin() + static_cast<std::ptrdiff_t>(count);
  std::vector<std::uint64_t> keys(size);
  for (std::size_t i = 0; i < size; ++i)
    keys[i] = mixBits(seed ^ mixBits(i));
  std::nth_element(
      places.begin(), end, places.end(), [&](std::size_t a, std::size_t b) {
        return std::tie(keys[a], a) < std::tie(keys[b], b);
      });
  places.erase(end, places.end());
  std::sort(places.begin(), places.end());
  return places;
}

TrainedStage
trainStage(const std::vector<GrayImage>& positives,
           const std::vector<GrayImage>& negatives,
           const std::vector<HaarFeature>& features,
           const CascadeTrainingOptions& options,
           std::uint64_t seed)
{
  std::vector<GrayImage> windows = positives;
  windows.insert(windows.end(), negatives.begin(), negatives.end());
  std::vector<int> labels(windows.size(), -1);
  std::fill_n(labels.begin(), positives.size(), 1);
  const bool has_tilted = options.features == HaarFeatureSet::kAll;
  const WindowBatch batch(windows,
                          options.width,
                          options.height,
                          has_tilted ? IntegralImage::Tables::kAll
                                     : IntegralImage::Tables::kUpright);
  const SortedFeatures sorted(batch, features, options.num_threads);
  GentleBoost boost(sorted, labels, options.splits);
  const Classes classes{positives.size(), negatives.size()};
  TrainedStage trained;
  trained.features = features;
  for (int t = 0; t < options.max_trees && !trained.reached; ++t) {
    const std::uint64_t tree_seed = mixBits(seed ^ static_cast<std::uint64_t>(t));
    if (!boost.addTree(drawn(features.size(), options.features_per_tree, tree_seed)))
      break;
    trained.stage.threshold = classes.threshold(boost.sums(), options.min_hit_rate);
    classes.rate(boost.sums(), trained.stage, trained.report);
    trained.reached = trained.report.false_alarm <= options.max_false_alarm;
  }
  trained.stage.trees = boost.trees();
  trained.report.trees = boost.trees().size();
  trained.report.positives = positives.size();
  trained.report.negatives = negatives.size();
  return trained;
}

void
append(HaarCascade& cascade, const TrainedStage& trained)
{
  HaarStage stage = trained.stage;
  for (auto& tree : stage.trees)
    for (auto& node : tree.nodes)
      node.feature = placeOf(trained.features[static_cast<std::size_t>(node.feature)],
                             cascade.features);
  cascade.stages.push_back(std::move(stage));
}

} // namespace pcl6d::object_localization

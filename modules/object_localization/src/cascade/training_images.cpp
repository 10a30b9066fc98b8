// SPDX-License-Identifier: BSD-3-Clause
#include "cascade/training_scene.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/common/require.h>
#include <pcl6d/object_localization/boosting.h>
#include <pcl6d/object_localization/haar_features.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace pcl6d {
using namespace object_localization;

namespace {
constexpr int kMostTries = 200;              // for one positive
using Refusals = std::array<std::size_t, 5>; // per PlaceVerdict

/** A positive, or the reasons for its failure. */
struct Positive {
  GrayImage window;
  Refusals refusals{};
};

/** \return the depths shown by reflectance pictures */
DepthSlice
wholeDepth(const DetectionViews& views)
{
  return {views.options().min_range, views.options().max_range};
}

/** Puts models into scans and cuts out positives. */
class PositiveMaker {
public:
  PositiveMaker(const std::vector<TriangleMesh>& meshes,
                const WindowShape& window,
                const ScannerPreset& scanner,
                const std::vector<BackgroundScan>& scans,
                const DetectionViews& views,
                const TrainingImageOptions& options)
  : window_(window), scanner_(scanner), views_(views), options_(options)
  {
    for (const auto& mesh : meshes)
      models_.emplace_back(mesh);
    for (const auto& scan : scans)
      scans_.emplace_back(scan);
  }

  Positive
  make(std::size_t index) const
  {
    Random random(mixBits(mixBits(options_.seed) ^ index));
    Positive positive;
    for (int i = 0; i < kMostTries && positive.window.pixels.empty(); ++i) {
      const auto& scan = drawn(scans_, random);
      const auto& model = drawn(models_, random);
      const ObjectInScan object = putIntoScan(model, scanner_, scan, options_, random);
      ++positive.refusals[static_cast<std::size_t>(object.verdict)];
      if (object.verdict == PlaceVerdict::kFree)
        positive.window = cutOut(object, random);
    }
    return positive;
  }

private:
  template <typename T>
  static const T&
  drawn(const std::vector<T>& items, Random& random)
  {
    return items[static_cast<std::size_t>(random.uniform() *
                                          static_cast<double>(items.size()))];
  }

  /** \return a slice that contains the object if possible */
  const DepthSlice&
  sliceOf(const ObjectInScan& object, Random& random) const
  {
    std::vector<DepthSlice> const& slices = views_.slices();
    std::vector<std::size_t> whole;
    std::size_t best = 0;
    double most = -1;
    for (std::size_t i = 0; i < slices.size(); ++i) {
      const double inside = std::min(slices[i].far_end, object.farthest) -
                            std::max(slices[i].near_end, object.nearest);
      if (slices[i].near_end <= object.nearest && slices[i].far_end >= object.farthest)
        whole.push_back(i);
      if (inside > most) {
        most = inside;
        best = i;
      }
    }
    return slices[whole.empty() ? best : drawn(whole, random)];
  }

  /** \return the window around the object; empty if it leaves the picture or lacks
   * contrast */
  GrayImage
  cutOut(const ObjectInScan& object, Random& random) const
  {
    const std::size_t view = views_.viewOf(object.middle);
    const RangeImage image =
        views_.image(view, object.scan.points, object.scan.reflectance);
    const bool is_range = options_.channel == ImageChannel::kRange;
    const DepthSlice slice = is_range ? sliceOf(object, random) : wholeDepth(views_);
    const GrayImage picture =
        is_range ? rangePicture(image, slice) : reflectancePicture(image);
    const DetectionViews::Place place = views_.place(view, object.middle);
    const double height =
        random.uniform(0.93, 1.08) * views_.pixelsOf(window_.object_size, place.depth);
    const double width = height * window_.width / window_.height;
    const auto offset = [&] { return random.uniform(-0.04, 0.04) * height; };
    const double left = place.x - width / 2 + offset();
    const double top = place.y - height / 2 + offset();
    const ImageRect box{static_cast<int>(std::floor(left + 0.5)),
                        static_cast<int>(std::floor(top + 0.5)),
                        static_cast<int>(std::floor(width + 0.5)),
                        static_cast<int>(std::floor(height + 0.5))};
    const bool fits_in = box.x >= 0 && box.y >= 0 && box.width >= 1 &&
                         box.height >= 1 && box.x + box.width <= picture.cols &&
                         box.y + box.height <= picture.rows;
    const WindowGate gate(
        views_.options(), image, slice, window_.object_size, options_.size_tolerance);
    if (!fits_in || !gate.rangeIn(box))
      return {};
    GrayImage window = resized(cropped(picture, box), window_.height, window_.width);
    const IntegralImage sums(window, IntegralImage::Tables::kUpright);
    if (!lightingOf(sums, 0, 0, window.cols, window.rows).has_contrast)
      return {};
    return window;
  }

  std::vector<TrainingModel> models_;
  std::vector<TrainingScan> scans_;
  const WindowShape& window_;
  const ScannerPreset& scanner_;
  const DetectionViews& views_;
  const TrainingImageOptions& options_;
};

std::vector<GrayImage>
makePositives(const PositiveMaker& maker,
              std::size_t count,
              unsigned int num_threads,
              const ProgressCallback& progress)
{
  constexpr std::size_t kBatch = 50;
  Refusals refusals{};
  std::vector<GrayImage> windows;
  for (std::size_t begin = 0; begin < count; begin += kBatch) {
    std::vector<Positive> made(std::min(kBatch, count - begin));
    parallelFor(made.size(), num_threads, [&](std::size_t i) {
      made[i] = maker.make(begin + i);
    });
    for (auto& positive : made) {
      for (std::size_t i = 0; i < refusals.size(); ++i)
        refusals[i] += positive.refusals[i];
      if (!positive.window.pixels.empty())
        windows.push_back(std::move(positive.window));
    }
    if (progress)
      progress({"positives", begin + made.size(), count});
    if (begin == 0 && windows.size() < made.size() / 2 + 1)
      break; // the rest would not do better
  }
  if (windows.size() * 2 > count || windows.size() == count)
    return windows;
  const char* const reasons[] = {"the window left the view, lacked contrast, or "
                                 "showed another range",
                                 "no floor was seen at this place",
                                 "something stood there",
                                 "the scanner had too few samples on the object",
                                 "something hid it"};
  const auto most = std::max_element(refusals.begin(), refusals.end());
  throw ComputeFailed("only " + std::to_string(windows.size()) + " of " +
                      std::to_string(count) +
                      " places for the object were found; most "
                      "often " +
                      reasons[most - refusals.begin()]);
}

std::vector<BackgroundImage>
makeBackgrounds(const std::vector<BackgroundScan>& scans,
                const WindowShape& window,
                const DetectionViews& views,
                const TrainingImageOptions& options)
{
  std::vector<std::vector<BackgroundImage>> pictures(scans.size() * views.size());
  parallelFor(pictures.size(), views.options().num_threads, [&](std::size_t i) {
    const auto& scan = scans[i / views.size()];
    const RangeImage image =
        views.image(i % views.size(), scan.points, scan.reflectance);
    const auto gate = [&](const DepthSlice& slice) {
      return std::make_shared<const WindowGate>(
          views.options(), image, slice, window.object_size, options.size_tolerance);
    };
    if (options.channel == ImageChannel::kReflectance)
      pictures[i].emplace_back(reflectancePicture(image), gate(wholeDepth(views)));
    else
      for (const auto& slice : views.slices())
        pictures[i].emplace_back(rangePicture(image, slice), gate(slice));
  });
  std::vector<BackgroundImage> all;
  for (auto& of_view : pictures)
    std::move(of_view.begin(), of_view.end(), std::back_inserter(all));
  return all;
}
} // namespace

void
TrainingImageOptions::validate() const
{
  require(positives > 0 && positives <= SortedFeatures::kMostPositives,
          "positives",
          positives,
          "in [1, " + std::to_string(SortedFeatures::kMostPositives) + "]");
  require(min_distance > 0, "min_distance", min_distance, "> 0");
  require(max_distance > min_distance && std::isfinite(max_distance),
          "max_distance",
          max_distance,
          "> min_distance and finite");
  require(min_visible > 0 && min_visible <= 1, "min_visible", min_visible, "in (0, 1]");
  require(size_tolerance > 1, "size_tolerance", size_tolerance, "> 1");
  require(min_reflectance >= 0 && min_reflectance <= 1,
          "min_reflectance",
          min_reflectance,
          "in [0, 1]");
  require(max_reflectance >= min_reflectance && max_reflectance <= 1,
          "max_reflectance",
          max_reflectance,
          "in [min_reflectance, 1]");
  require(min_samples > 0, "min_samples", min_samples, "> 0");
}

TrainingImages
makeTrainingImages(const std::vector<TriangleMesh>& models,
                   const WindowShape& window,
                   const ScannerPreset& scanner,
                   const std::vector<BackgroundScan>& scans,
                   const DetectionViews& views,
                   const TrainingImageOptions& options,
                   const ProgressCallback& progress)
{
  options.validate();
  require(!models.empty(), "number of models", models.size(), "> 0");
  require(!scans.empty(), "number of background scans", scans.size(), "> 0");
  for (std::size_t i = 0; i < scans.size(); ++i)
    if (options.channel == ImageChannel::kReflectance &&
        scans[i].reflectance.size() != scans[i].points.size())
      throw BadArgument("background scan " + std::to_string(i) +
                        " has no reflectances");
  const PositiveMaker maker(models, window, scanner, scans, views, options);
  TrainingImages images;
  images.positives =
      makePositives(maker, options.positives, views.options().num_threads, progress);
  images.backgrounds = makeBackgrounds(scans, window, views, options);
  return images;
}

} // namespace pcl6d

// SPDX-License-Identifier: BSD-3-Clause
#include "cascade/negative_windows.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/common/random.h>

#include <algorithm>
#include <tuple>

namespace pcl6d::object_localization {

/** A window that passes every stage. */
struct NegativeFinder::Alarm {
  std::uint64_t key = 0; ///< random: the smallest are drawn
  std::size_t image = 0;
  std::size_t scale = 0;
  int x = 0;
  int y = 0;

  friend bool
  operator<(const Alarm& a, const Alarm& b)
  {
    return std::tie(a.key, a.image, a.scale, a.y, a.x) <
           std::tie(b.key, b.image, b.scale, b.y, b.x);
  }
};

struct NegativeFinder::Alarms {
  std::vector<Alarm> drawn;
  std::size_t passed = 0;

  void
  keepSmallest(std::size_t count)
  {
    if (drawn.size() <= count)
      return;
    const auto end = drawn.begin() + static_cast<std::ptrdiff_t>(count);
    std::nth_element(drawn.begin(), end, drawn.end());
    drawn.erase(end, drawn.end());
  }
};

NegativeFinder::NegativeFinder(const std::vector<BackgroundImage>& backgrounds,
                               double scale_factor,
                               unsigned int num_threads)
: backgrounds_(backgrounds)
, scale_factor_(scale_factor)
, num_threads_(num_threads)
, searches_(backgrounds.size())
{}

std::vector<WindowScale>
NegativeFinder::scalesOf(const HaarCascade& cascade, std::size_t image) const
{
  const BackgroundImage& background = backgrounds_[image];
  WindowGrid grid{scale_factor_, 0, 0};
  if (background.gate) {
    const auto sizes = background.gate->grid(scale_factor_);
    if (!sizes)
      return {};
    grid = *sizes;
  }
  return windowScales(background.image.rows,
                      background.image.cols,
                      cascade.width,
                      cascade.height,
                      grid);
}

std::vector<NegativeFinder::Place>
NegativeFinder::allPlaces(const WindowScale& scale, std::size_t image) const
{
  const WindowGate* const gate = backgrounds_[image].gate.get();
  std::vector<Place> places;
  for (int y = 0; y < scale.end_row; y += scale.step)
    for (int x = 0; x < scale.end_col; x += scale.step)
      if (!gate || gate->rangeIn(scale.window(x, y)))
        places.push_back(
            {static_cast<std::uint16_t>(x), static_cast<std::uint16_t>(y)});
  return places;
}

// A window that failed once fails every longer cascade: the next search skips it.
NegativeFinder::Alarms
NegativeFinder::searchImage(const HaarCascade& cascade,
                            std::size_t image,
                            std::size_t wanted,
                            std::uint64_t seed)
{
  const auto tables = cascade.hasTilted() ? IntegralImage::Tables::kAll
                                          : IntegralImage::Tables::kUpright;
  const std::vector<WindowScale> scales = scalesOf(cascade, image);
  Search& search = searches_[image];
  const bool was_known = search.is_known;
  search.is_known = true;
  search.places.resize(scales.size());
  search.tested = was_known ? search.tested : 0;
  Alarms found;
  for (std::size_t s = 0; s < scales.size(); ++s) {
    const WindowScale& scale = scales[s];
    const std::vector<Place> places =
        was_known ? std::move(search.places[s]) : allPlaces(scale, image);
    search.places[s].clear();
    if (places.empty())
      continue;
    const IntegralImage sums(resized(backgrounds_[image].image, scale.rows, scale.cols),
                             tables);
    const CascadeEvaluator evaluator(cascade, sums.stride());
    const std::uint64_t scale_key = mixBits(mixBits(seed ^ mixBits(image)) ^ s);
    for (const Place& place : places) {
      const auto passed = evaluator.stagesPassed(sums, place.x, place.y);
      search.tested += passed && !was_known ? 1 : 0;
      if (passed != evaluator.numStages())
        continue;
      ++found.passed;
      search.places[s].push_back(place);
      const std::uint64_t corner = std::uint64_t{place.y} << 32 | place.x;
      found.drawn.push_back({mixBits(scale_key ^ corner), image, s, place.x, place.y});
    }
    found.keepSmallest(wanted);
  }
  return found;
}

GrayImage
NegativeFinder::cut(const HaarCascade& cascade, const Alarm& alarm) const
{
  const WindowScale scale = scalesOf(cascade, alarm.image)[alarm.scale];
  return cropped(resized(backgrounds_[alarm.image].image, scale.rows, scale.cols),
                 {alarm.x, alarm.y, cascade.width, cascade.height});
}

NegativeWindows
NegativeFinder::find(const HaarCascade& cascade, std::size_t wanted, std::uint64_t seed)
{
  std::vector<Alarms> per_image(backgrounds_.size());
  parallelFor(backgrounds_.size(), num_threads_, [&](std::size_t i) {
    per_image[i] = searchImage(cascade, i, wanted, seed);
  });
  NegativeWindows negatives;
  Alarms all;
  for (std::size_t i = 0; i < per_image.size(); ++i) {
    const Alarms& found = per_image[i];
    negatives.passed += found.passed;
    negatives.tested += searches_[i].tested;
    all.drawn.insert(all.drawn.end(), found.drawn.begin(), found.drawn.end());
    all.keepSmallest(wanted);
  }
  std::sort(all.drawn.begin(), all.drawn.end());
  negatives.windows.resize(all.drawn.size());
  parallelFor(all.drawn.size(), num_threads_, [&](std::size_t i) {
    negatives.windows[i] = cut(cascade, all.drawn[i]);
  });
  return negatives;
}

} // namespace pcl6d::object_localization

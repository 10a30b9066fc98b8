// SPDX-License-Identifier: BSD-3-Clause
#include "negative_windows.h"

#include <pcl6d/common/parallel.h>
#include <pcl6d/common/random.h>
#include <pcl6d/object_localization/cascade_evaluator.h>

#include <algorithm>
#include <tuple>

namespace pcl6d {
namespace {
/** A window that passes all stages. */
struct Alarm {
  std::uint64_t key = 0; ///< random: the smallest are drawn
  std::uint32_t image = 0;
  std::uint32_t scale = 0;
  int x = 0;
  int y = 0;

  friend bool
  operator<(const Alarm& a, const Alarm& b)
  {
    return std::tie(a.key, a.image, a.scale, a.y, a.x) <
           std::tie(b.key, b.image, b.scale, b.y, b.x);
  }
};

struct Alarms {
  std::vector<Alarm> drawn;
  std::size_t passed = 0;
  std::size_t tested = 0;
};

void
keepSmallest(std::vector<Alarm>& alarms, std::size_t count)
{
  if (alarms.size() <= count)
    return;
  const auto end = alarms.begin() + static_cast<std::ptrdiff_t>(count);
  std::nth_element(alarms.begin(), end, alarms.end());
  alarms.erase(end, alarms.end());
}

std::vector<WindowScale>
scalesOf(const HaarCascade& cascade, const GrayImage& image, double factor)
{
  return windowScales(
      image.rows, image.cols, cascade.width, cascade.height, {factor, 0, 0});
}

void
searchScale(const HaarCascade& cascade,
            const GrayImage& small,
            const WindowScale& scale,
            Alarm alarm,
            std::uint64_t seed,
            Alarms& found)
{
  const auto tables = cascade.hasTilted() ? IntegralImage::Tables::kAll
                                          : IntegralImage::Tables::kUpright;
  const IntegralImage sums(small, tables);
  const CascadeEvaluator evaluator(cascade, sums.stride());
  const std::uint64_t scale_key =
      mixBits(mixBits(seed ^ mixBits(alarm.image)) ^ alarm.scale);
  for (alarm.y = 0; alarm.y < scale.end_row; alarm.y += scale.step)
    for (alarm.x = 0; alarm.x < scale.end_col; alarm.x += scale.step) {
      const auto passed = evaluator.stagesPassed(sums, alarm.x, alarm.y);
      found.tested += passed ? 1 : 0;
      if (passed != evaluator.numStages())
        continue;
      ++found.passed;
      const auto place = static_cast<std::uint64_t>(alarm.y) << 32 |
                         static_cast<std::uint64_t>(alarm.x);
      alarm.key = mixBits(scale_key ^ place);
      found.drawn.push_back(alarm);
    }
}

Alarms
searchImage(const HaarCascade& cascade,
            const GrayImage& image,
            std::uint32_t number,
            const NegativeSearch& search)
{
  Alarms found;
  std::uint32_t index = 0;
  for (const auto& scale : scalesOf(cascade, image, search.scale_factor)) {
    searchScale(cascade,
                resized(image, scale.rows, scale.cols),
                scale,
                {0, number, index++, 0, 0},
                search.seed,
                found);
    keepSmallest(found.drawn, search.wanted);
  }
  return found;
}

GrayImage
cut(const HaarCascade& cascade,
    const std::vector<GrayImage>& backgrounds,
    const Alarm& alarm,
    double factor)
{
  const GrayImage& image = backgrounds[alarm.image];
  const WindowScale scale = scalesOf(cascade, image, factor)[alarm.scale];
  return cropped(resized(image, scale.rows, scale.cols),
                 {alarm.x, alarm.y, cascade.width, cascade.height});
}
} // namespace

NegativeWindows
findNegatives(const HaarCascade& cascade,
              const std::vector<GrayImage>& backgrounds,
              const NegativeSearch& search)
{
  std::vector<Alarms> per_image(backgrounds.size());
  parallelFor(backgrounds.size(), search.num_threads, [&](std::size_t i) {
    per_image[i] =
        searchImage(cascade, backgrounds[i], static_cast<std::uint32_t>(i), search);
  });
  NegativeWindows negatives;
  std::vector<Alarm> all;
  for (const auto& found : per_image) {
    negatives.passed += found.passed;
    negatives.tested += found.tested;
    all.insert(all.end(), found.drawn.begin(), found.drawn.end());
    keepSmallest(all, search.wanted);
  }
  std::sort(all.begin(), all.end());
  negatives.windows.resize(all.size());
  parallelFor(all.size(), search.num_threads, [&](std::size_t i) {
    negatives.windows[i] = cut(cascade, backgrounds, all[i], search.scale_factor);
  });
  return negatives;
}

} // namespace pcl6d

// SPDX-License-Identifier: BSD-3-Clause
#include "median_split.h"

namespace pcl6d::search {

PCL6D_SIMD_CLONES Cut
cutBySample(const Item* items, std::size_t size, float share)
{
  constexpr int kCount = 64; // of the sample
  constexpr float kBand = 7; // ranks on either side; a median varies by 4 (1 sigma)
  Item sample[kCount];
  for (std::uint64_t i = 0; i < kCount;
       ++i) { // one item of each part, against periodic patterns
    const std::uint64_t part = (i << 16) | ((i * 40503) & 0xffff); // golden ratio
    sample[i] = items[(part * size) >> 22];
  }
  const ItemBox box = boxOf<kCount>(sample);
  const int axis = box.longestAxis();
  int keys[kCount], ranks[kCount];
  keysOf<kCount>(sample, box, axis, keys);
  ranksOf<kCount>(keys, ranks);
  float sorted[kCount];
  for (int i = 0; i < kCount; ++i)
    sorted[ranks[i]] = sample[i].xyz[axis];
  const float rank = share * kCount;
  const float low = sorted[static_cast<int>(std::max(rank - kBand, 0.0f))];
  const float high =
      sorted[static_cast<int>(std::min(rank + kBand, static_cast<float>(kCount - 1)))];
  return {axis, std::min(low, high), std::max(low, high)}; // keys may round
}
} // namespace pcl6d::search

// SPDX-License-Identifier: BSD-3-Clause
#include "scan/las/laz_coder.h"

#include <utility>

namespace pcl6d::io {

void
LazEncoder::carry()
{
  std::size_t i = bytes_.size();
  while (i > 0 && ++bytes_[--i] == 0) {} // 255 becomes 0, and the carry goes on
}

std::string
LazEncoder::finish()
{
  // The minimum of base bytes that identify the interval, then padding for a decoder's
  // read-ahead: four bytes in total.
  const bool one_is_enough = length_ > 2 * kLazShortest;
  one_is_enough ? give(kLazShortest, kLazShortest / 2)
                : give(kLazShortest / 2, kLazShortest >> 9);
  bytes_.append(one_is_enough ? 3 : 2, '\0');
  base_ = 0;
  length_ = ~0U;
  return std::exchange(bytes_, {});
}

} // namespace pcl6d::io

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <array>
#include <cstddef>
#include <cstdint>

namespace pcl6d::io {

/** \brief Approximate median of the last differences: five numbers in ascending order. A new
 * number replaces the largest number until it is not below the median, from then on the
 * smallest until it is not above the median, and so on. Source: LAZ Specification 1.4 R1. */
class LazMedian {
public:
  std::int32_t
  median() const
  {
    return values_[2];
  }

  void
  add(std::int32_t value)
  {
    const bool from_above = drops_largest_;
    if (from_above ? value >= values_[2] : value <= values_[2])
      drops_largest_ = !drops_largest_;
    if (from_above) {
      std::size_t place = 4;
      for (; place > 0 && value < values_[place - 1]; --place)
        values_[place] = values_[place - 1];
      values_[place] = value;
    }
    else {
      std::size_t place = 0;
      for (; place < 4 && values_[place + 1] < value; ++place)
        values_[place] = values_[place + 1];
      values_[place] = value;
    }
  }

private:
  std::array<std::int32_t, 5> values_{};
  bool drops_largest_ = true;
};

/** \return a - b, modulo 2^32 */
inline std::int32_t
lazDifference(std::int32_t a, std::int32_t b)
{
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) -
                                   static_cast<std::uint32_t>(b));
}

/** \return a + b, modulo 2^32 */
inline std::int32_t
lazSum(std::int32_t a, std::int32_t b)
{
  return static_cast<std::int32_t>(static_cast<std::uint32_t>(a) +
                                   static_cast<std::uint32_t>(b));
}

/** \return the context of a coordinate by the size of the differences before: even, and no
 * more than `most` */
inline std::size_t
lazSizeContext(std::uint32_t size, std::uint32_t most)
{
  return size < most ? size & ~1U : most;
}

} // namespace pcl6d::io

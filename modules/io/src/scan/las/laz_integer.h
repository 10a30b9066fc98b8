// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scan/las/laz_coder.h"

#include <vector>

namespace pcl6d::io {

/** \brief LAZ coding of an integer with a prediction: the number of bits of the difference by a
 * model per context, then the difference, with a model for the highest eight bits. Source: LAZ
 * Specification 1.4 R1, "integer compressor". */
class IntegerModel {
public:
  /** \param[in] bits of the integers: 8, 16 or 32; arithmetic wraps around */
  IntegerModel(std::uint32_t bits, std::size_t contexts)
  : bits_(bits), sizes_(contexts, bits + 1)
  {
    for (std::uint32_t size = 1; size <= bits; ++size)
      values_.emplace_back(1, 1U << (size < kModelled ? size : kModelled));
  }

  /** \return the number of bits of the last difference */
  std::uint32_t
  size() const
  {
    return size_;
  }

  /** \return the integer; not negative for 8 and 16 bits */
  template <typename Coder>
  std::int32_t
  code(Coder& coder, std::int32_t predicted, std::size_t context, std::int32_t wanted)
  {
    std::uint32_t difference = 0; // modulo 2^32
    if constexpr (Coder::kEncodes) {
      difference = wrapped(static_cast<std::uint32_t>(wanted) -
                           static_cast<std::uint32_t>(predicted));
      size_ = sizeOf(static_cast<std::int32_t>(difference));
    }
    size_ = coder.symbol(sizes_[context], size_);
    difference = codeDifference(coder, difference);
    const std::uint32_t value = static_cast<std::uint32_t>(predicted) + difference;
    return static_cast<std::int32_t>(bits_ < 32 ? value & ((1U << bits_) - 1) : value);
  }

private:
  static constexpr std::uint32_t kModelled = 8; // highest bits with a model

  /** \return the smallest difference that is congruent modulo 2^bits */
  std::uint32_t
  wrapped(std::uint32_t difference) const
  {
    if (bits_ == 32)
      return difference;
    const std::uint32_t half = 1U << (bits_ - 1);
    return ((difference + half) & (2 * half - 1)) - half;
  }

  /** \return k, where -2^k < difference <= -2^(k-1) or 2^(k-1) < difference <= 2^k;
   * 0 for 0 and 1 */
  static std::uint32_t
  sizeOf(std::int32_t difference)
  {
    const auto value = static_cast<std::uint32_t>(difference);
    std::uint32_t rest = difference <= 0 ? 0U - value : value - 1;
    std::uint32_t size = 0;
    for (; rest != 0; rest >>= 1)
      ++size;
    return size;
  }

  template <typename Coder>
  std::uint32_t
  codeDifference(Coder& coder, std::uint32_t difference)
  {
    if (size_ == 0)
      return coder.bit(bit_, difference & 1);
    if (size_ == 32)
      return 1U << 31; // the only one: -2^31
    // Negative differences of a size come before the positive differences.
    const std::uint32_t half = 1U << (size_ - 1);
    std::uint32_t place = static_cast<std::int32_t>(difference) < 0
                              ? difference + 2 * half - 1
                              : difference - 1;
    SymbolModel& model = values_[size_ - 1][0];
    if (size_ <= kModelled)
      place = coder.symbol(model, Coder::kEncodes ? place : 0);
    else {
      const std::uint32_t low = size_ - kModelled;
      const std::uint32_t mask = (1U << low) - 1;
      const std::uint32_t high =
          coder.symbol(model, Coder::kEncodes ? place >> low : 0);
      place = high << low | coder.bits(low, place & mask);
    }
    return place >= half ? place + 1 : place + 1 - 2 * half;
  }

  std::uint32_t bits_;
  std::uint32_t size_ = 0;
  ModelSet sizes_;
  std::vector<ModelSet> values_; ///< for each size, with a single context
  BitModel bit_;
};

} // namespace pcl6d::io

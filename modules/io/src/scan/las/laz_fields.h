// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scan/las/las_bytes.h"
#include "scan/las/laz_integer.h"

#include <algorithm>
#include <array>

/** \file LAZ coding of the parts of a point after the first: GPS time, colours, extra bytes.
 * Each class codes the values of consecutive points, with one function for decoder and encoder
 * (laz_coder.h). Source: LAZ Specification 1.4 R1. */
namespace pcl6d::io {

/** \brief Time of a point, coded as the bits of a double: four sequences of nearly equal steps,
 * caused by several lasers or returns; a time is coded as a multiple of the last step of the
 * sequence. */
class LazTime {
public:
  /** \param[in] first time \param[in] knows_equal whether a symbol marks a time equal to the
   * previous point's (point formats below 6) */
  LazTime(std::int64_t first, bool knows_equal)
  : equal_(knows_equal ? 1 : 0)
  , first_steps_(1, 5 + equal_)
  , multiples_(1, kFull + equal_ + 4)
  {
    times_[0] = first;
  }

  template <typename Coder>
  std::int64_t
  code(Coder& coder, std::int64_t wanted)
  {
    // No writer changes the sequence more than once a point.
    for (int changes = 0; changes < 4; ++changes)
      if (codeOnce(coder, wanted))
        return times_[now_];
    coder.setBroken();
    return times_[now_];
  }

private:
  static constexpr std::uint32_t kMost = 500; ///< largest multiple
  static constexpr std::uint32_t kLeast = 10; ///< smallest multiple, negative
  static constexpr std::uint32_t kFull =
      511; ///< symbol of a time in full, if equal_ = 0
  static constexpr std::uint32_t kExtreme =
      3; ///< extreme multiples before the step changes

  /** \return false if only the sequence was changed */
  template <typename Coder>
  bool
  codeOnce(Coder& coder, std::int64_t wanted)
  {
    const bool is_first = steps_[now_] == 0;
    std::uint32_t chosen = 0;
    if constexpr (Coder::kEncodes)
      chosen = is_first ? firstSymbol(wanted) : multipleOf(wanted);
    const std::uint32_t symbol =
        coder.symbol(is_first ? first_steps_[0] : multiples_[0], chosen);
    const std::uint32_t full = is_first ? 1 + equal_ : kFull + equal_;
    if (equal_ == 1 && symbol == (is_first ? 0 : kFull))
      return true;
    if (symbol > full) {
      now_ = (now_ + symbol - full) % times_.size();
      return false;
    }
    if (symbol == full)
      codeFull(coder, wanted);
    else if (is_first) {
      steps_[now_] = codeStep(coder, 0, 0, wanted);
      extremes_[now_] = 0;
    }
    else
      codeMultiple(coder, symbol, wanted);
    return true;
  }

  static bool
  fits(std::int64_t step)
  {
    return step == static_cast<std::int32_t>(step);
  }

  std::int64_t
  stepTo(std::int64_t wanted) const
  {
    return static_cast<std::int64_t>(static_cast<std::uint64_t>(wanted) -
                                     static_cast<std::uint64_t>(times_[now_]));
  }

  /** The encoder's choice: continue the sequence, or begin a new sequence. */
  std::uint32_t
  firstSymbol(std::int64_t wanted) const
  {
    if (equal_ == 1 && wanted == times_[now_])
      return 0;
    return equal_ + (fits(stepTo(wanted)) ? 0 : 1);
  }

  std::uint32_t
  multipleOf(std::int64_t wanted) const
  {
    if (equal_ == 1 && wanted == times_[now_])
      return kFull;
    const std::int64_t step = stepTo(wanted);
    if (!fits(step))
      return kFull + equal_;
    const double ratio = static_cast<double>(step) / steps_[now_];
    if (ratio >= 0)
      return ratio < kMost ? static_cast<std::uint32_t>(ratio + 0.5) : kMost;
    const auto below = static_cast<std::uint32_t>(std::min(0.5 - ratio, 1.0 * kLeast));
    return below == 0 ? 0 : kMost + below;
  }

  template <typename Coder>
  std::int32_t
  codeStep(Coder& coder,
           std::int32_t predicted,
           std::size_t context,
           std::int64_t wanted)
  {
    const std::int32_t step = integer_.code(
        coder, predicted, context, static_cast<std::int32_t>(stepTo(wanted)));
    times_[now_] = static_cast<std::int64_t>(static_cast<std::uint64_t>(times_[now_]) +
                                             static_cast<std::uint64_t>(step));
    return step;
  }

  template <typename Coder>
  void
  codeMultiple(Coder& coder, std::uint32_t symbol, std::int64_t wanted)
  {
    const bool is_negative = symbol > kMost;
    const std::uint32_t size = is_negative ? symbol - kMost : symbol;
    const auto last = static_cast<std::uint32_t>(steps_[now_]);
    const auto predicted =
        static_cast<std::int32_t>(is_negative ? 0U - size * last : size * last);
    const std::size_t context = is_negative      ? (size < kLeast ? 5 : 6)
                                : symbol == 0    ? 7
                                : symbol == 1    ? 1
                                : symbol < 10    ? 2
                                : symbol < kMost ? 3
                                                 : 4;
    const std::int32_t step = codeStep(coder, predicted, context, wanted);
    if (symbol == 1)
      extremes_[now_] = 0;
    else if (context == 4 || context == 6 || context == 7)
      if (++extremes_[now_] > kExtreme) {
        steps_[now_] = step;
        extremes_[now_] = 0;
      }
  }

  template <typename Coder>
  void
  codeFull(Coder& coder, std::int64_t wanted)
  {
    newest_ = (newest_ + 1) % times_.size();
    const auto high = static_cast<std::uint32_t>(
        integer_.code(coder,
                      static_cast<std::int32_t>(times_[now_] >> 32),
                      8,
                      static_cast<std::int32_t>(wanted >> 32)));
    const std::uint64_t low = coder.bits(32, static_cast<std::uint32_t>(wanted));
    now_ = newest_;
    times_[now_] = static_cast<std::int64_t>(std::uint64_t{high} << 32 | low);
    steps_[now_] = 0;
    extremes_[now_] = 0;
  }

  std::uint32_t equal_;
  ModelSet first_steps_;
  ModelSet multiples_;
  IntegerModel integer_{32, 9};
  std::array<std::int64_t, 4> times_{}; ///< the last time of each sequence
  std::array<std::int32_t, 4> steps_{};
  std::array<std::uint32_t, 4> extremes_{};
  std::size_t now_ = 0;
  std::size_t newest_ = 0;
};

/** \brief Three 16-bit numbers, often equal to each other, with equal high and low bytes. */
using LazColour = std::array<std::uint16_t, 3>;

/** \brief Red, green and blue: the change of red predicts the change of green and blue. */
class LazColours {
public:
  using Value = LazColour;

  /** \param[in,out] last previous value, then the current value */
  template <typename Coder>
  void
  code(Coder& coder, LazColour& last, const LazColour& wanted)
  {
    const std::uint32_t changed =
        coder.symbol(changed_[0], Coder::kEncodes ? changes(last, wanted) : 0);
    const auto has = [changed](std::uint32_t channel, std::uint32_t half) {
      return (changed & (1U << (2 * channel + half))) != 0;
    };
    LazColour colour = last;
    for (std::uint32_t half = 0; half < 2; ++half) // low and high byte
      if (has(0, half))
        codeByte(coder, 0, half, 0, wanted, colour);
    if ((changed & kIsColoured) == 0)
      colour[1] = colour[2] = colour[0];
    else
      for (std::uint32_t half = 0; half < 2; ++half) {
        const int by_red = byteOf(colour[0], half) - byteOf(last[0], half);
        if (has(1, half))
          codeByte(coder, 1, half, by_red, wanted, colour);
        const int by_green = byteOf(colour[1], half) - byteOf(last[1], half);
        if (has(2, half))
          codeByte(coder, 2, half, (by_red + by_green) / 2, wanted, colour);
      }
    last = colour;
  }

private:
  static constexpr std::uint32_t kIsColoured = 1U << 6;

  static int
  byteOf(std::uint16_t value, std::uint32_t half)
  {
    return value >> (8 * half) & 0xff;
  }

  static std::uint32_t
  changes(const LazColour& last, const LazColour& wanted)
  {
    std::uint32_t changed = 0;
    for (std::uint32_t channel = 0; channel < 3; ++channel)
      for (std::uint32_t half = 0; half < 2; ++half)
        if (byteOf(last[channel], half) != byteOf(wanted[channel], half))
          changed |= 1U << (2 * channel + half);
    if (wanted[0] != wanted[1] || wanted[0] != wanted[2])
      changed |= kIsColoured;
    return changed;
  }

  /** \param[in] change predicted change \param[in,out] colour with the preceding byte */
  template <typename Coder>
  void
  codeByte(Coder& coder,
           std::uint32_t channel,
           std::uint32_t half,
           int change,
           const LazColour& wanted,
           LazColour& colour)
  {
    const int before = byteOf(colour[channel], half);
    const int predicted = std::clamp(before + change, 0, 255);
    const int difference = byteOf(wanted[channel], half) - predicted;
    const auto byte = (static_cast<std::uint32_t>(predicted) +
                       coder.symbol(differences_[2 * channel + half],
                                    static_cast<std::uint32_t>(difference) & 0xff)) &
                      0xff;
    colour[channel] = static_cast<std::uint16_t>(
        (colour[channel] & ~(0xffU << (8 * half))) | byte << (8 * half));
  }

  ModelSet changed_{1, 128};
  ModelSet differences_{6, 256};
};

/** \brief Near infrared: a 16-bit channel. */
class LazInfrared {
public:
  using Value = std::uint16_t;

  /** \param[in,out] last previous value, then the current value */
  template <typename Coder>
  void
  code(Coder& coder, std::uint16_t& last, std::uint16_t wanted)
  {
    const std::uint32_t change = last ^ wanted;
    const std::uint32_t changed = coder.symbol(
        changed_[0], ((change & 0xff) != 0 ? 1U : 0U) | (change > 0xff ? 2U : 0U));
    std::uint32_t value = 0;
    for (std::uint32_t half = 0; half < 2; ++half) {
      std::uint32_t byte = last >> (8 * half) & 0xff;
      if ((changed & (1U << half)) != 0)
        byte +=
            coder.symbol(differences_[half], ((wanted >> (8 * half)) - byte) & 0xff);
      value |= (byte & 0xff) << (8 * half);
    }
    last = static_cast<std::uint16_t>(value);
  }

private:
  ModelSet changed_{1, 4};
  ModelSet differences_{2, 256};
};

/** \brief A further byte of a point. */
class LazByte {
public:
  using Value = std::uint8_t;

  /** \param[in,out] last previous value, then the current value */
  template <typename Coder>
  void
  code(Coder& coder, std::uint8_t& last, std::uint8_t wanted)
  {
    last = static_cast<std::uint8_t>(
        last + coder.symbol(differences_[0], (wanted - last) & 0xff));
  }

private:
  ModelSet differences_{1, 256};
};

} // namespace pcl6d::io

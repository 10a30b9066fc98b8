// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scan/las/laz_fields.h"
#include "scan/las/laz_median.h"

#include <optional>

namespace pcl6d::io {

/** \brief The first 20 bytes of a point of formats 0 to 5. */
struct LazPoint10 {
  std::int32_t x = 0, y = 0, z = 0;
  std::uint16_t intensity = 0;
  /** return number, number of returns (3 bits each), direction of the scan, edge of the
   * flight line */
  std::uint8_t flags = 0;
  std::uint8_t classification = 0;
  std::uint8_t angle = 0;
  std::uint8_t user_data = 0;
  std::uint16_t source = 0;

  static LazPoint10
  of(const std::uint8_t* record)
  {
    return {lasNumber<std::int32_t>(record),
            lasNumber<std::int32_t>(record + 4),
            lasNumber<std::int32_t>(record + 8),
            lasNumber<std::uint16_t>(record + 12),
            record[14],
            record[15],
            record[16],
            record[17],
            lasNumber<std::uint16_t>(record + 18)};
  }

  void
  store(std::uint8_t* record) const
  {
    storeLasNumber(record, x);
    storeLasNumber(record + 4, y);
    storeLasNumber(record + 8, z);
    storeLasNumber(record + 12, intensity);
    record[14] = flags;
    record[15] = classification;
    record[16] = angle;
    record[17] = user_data;
    storeLasNumber(record + 18, source);
  }
};

/** \brief LAZ codec of LazPoint10 ("POINT10", version 2). Source: LAZ Specification 1.4 R1. */
class LazPoint10Codec {
public:
  explicit LazPoint10Codec(const LazPoint10& first) : last_(first)
  {
    last_.intensity = 0; // initial intensity in every context
  }

  template <typename Coder>
  LazPoint10
  code(Coder& coder, const LazPoint10& wanted)
  {
    const std::uint32_t changed =
        coder.symbol(changed_[0], Coder::kEncodes ? changesTo(wanted) : 0);
    if ((changed & 32) != 0)
      last_.flags =
          static_cast<std::uint8_t>(coder.symbol(flags_[last_.flags], wanted.flags));
    const unsigned returns = contextOf(last_.flags);
    codeAttributes(coder, changed, returns, wanted);
    codePlace(coder, returns, wanted);
    return last_;
  }

private:
  /** \return one of 16 contexts, by number of returns and return number; also for invalid
   * numbers */
  static unsigned
  contextOf(std::uint8_t flags);

  static unsigned
  numReturns(std::uint8_t flags)
  {
    return flags >> 3 & 7;
  }

  /** \return how many returns lie behind: 0 to 7 */
  static unsigned
  levelOf(std::uint8_t flags)
  {
    const unsigned number = flags & 7, count = numReturns(flags);
    return count > number ? count - number : number - count;
  }

  std::uint32_t
  changesTo(const LazPoint10& wanted) const
  {
    return (last_.flags != wanted.flags ? 32 : 0) |
           (intensities_[contextOf(wanted.flags)] != wanted.intensity ? 16 : 0) |
           (last_.classification != wanted.classification ? 8 : 0) |
           (last_.angle != wanted.angle ? 4 : 0) |
           (last_.user_data != wanted.user_data ? 2 : 0) |
           (last_.source != wanted.source ? 1 : 0);
  }

  template <typename Coder>
  void
  codeAttributes(Coder& coder,
                 std::uint32_t changed,
                 unsigned returns,
                 const LazPoint10& wanted)
  {
    if ((changed & 16) != 0)
      intensities_[returns] = static_cast<std::uint16_t>(intensity_.code(
          coder, intensities_[returns], std::min(returns, 3U), wanted.intensity));
    last_.intensity = intensities_[returns];
    if ((changed & 8) != 0)
      last_.classification = static_cast<std::uint8_t>(
          coder.symbol(classes_[last_.classification], wanted.classification));
    if ((changed & 4) != 0)
      last_.angle = static_cast<std::uint8_t>(
          last_.angle + coder.symbol(angles_[last_.flags >> 6 & 1],
                                     (wanted.angle - last_.angle) & 0xff));
    if ((changed & 2) != 0)
      last_.user_data = static_cast<std::uint8_t>(
          coder.symbol(user_data_[last_.user_data], wanted.user_data));
    if ((changed & 1) != 0)
      last_.source = static_cast<std::uint16_t>(
          source_.code(coder, last_.source, 0, wanted.source));
  }

  template <typename Coder>
  void
  codePlace(Coder& coder, unsigned returns, const LazPoint10& wanted)
  {
    const std::size_t single = numReturns(last_.flags) == 1 ? 1 : 0;
    LazMedian& in_x = medians_x_[returns];
    const std::int32_t dx =
        dx_.code(coder, in_x.median(), single, lazDifference(wanted.x, last_.x));
    last_.x = lazSum(last_.x, dx);
    in_x.add(dx);
    LazMedian& in_y = medians_y_[returns];
    const std::int32_t dy = dy_.code(coder,
                                     in_y.median(),
                                     single + lazSizeContext(dx_.size(), 20),
                                     lazDifference(wanted.y, last_.y));
    last_.y = lazSum(last_.y, dy);
    in_y.add(dy);
    std::int32_t& height = heights_[levelOf(last_.flags)];
    height = z_.code(coder,
                     height,
                     single + lazSizeContext((dx_.size() + dy_.size()) / 2, 18),
                     wanted.z);
    last_.z = height;
  }

  LazPoint10 last_;
  std::array<std::uint16_t, 16> intensities_{};
  std::array<std::int32_t, 8> heights_{};
  std::array<LazMedian, 16> medians_x_{}, medians_y_{};
  IntegerModel dx_{32, 2}, dy_{32, 22}, z_{32, 20}, intensity_{16, 4}, source_{16, 1};
  ModelSet changed_{1, 64}, flags_{256, 256}, classes_{256, 256}, user_data_{256, 256},
      angles_{2, 256};
};

inline unsigned
LazPoint10Codec::contextOf(std::uint8_t flags)
{
  // Row: number of returns; column: return number. Values from the specification.
  static constexpr std::uint8_t kContexts[8][8] = {{15, 14, 13, 12, 11, 10, 9, 8},
                                                   {14, 0, 1, 3, 6, 10, 10, 9},
                                                   {13, 1, 2, 4, 7, 11, 11, 10},
                                                   {12, 3, 4, 5, 8, 12, 12, 11},
                                                   {11, 6, 7, 8, 9, 13, 13, 12},
                                                   {10, 10, 11, 12, 13, 14, 14, 13},
                                                   {9, 10, 11, 12, 13, 14, 15, 14},
                                                   {8, 9, 10, 11, 12, 13, 14, 15}};
  return kContexts[numReturns(flags)][flags & 7];
}

} // namespace pcl6d::io

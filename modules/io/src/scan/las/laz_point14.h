// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scan/las/laz_fields.h"
#include "scan/las/laz_layers.h"
#include "scan/las/laz_median.h"

#include <memory>

namespace pcl6d::io {

/** \brief Models and last point of a channel of the scanner. */
class LazChannel14 {
public:
  explicit LazChannel14(const LazPoint14& first) : last(first), time_(first.time, false)
  {
    heights_.fill(first.z);
    intensities_.fill(first.intensity);
  }

  /** \brief Codes every value except the change of the channel.
   * \param[in,out] last the previous point, then the current point
   * \param[in] changed bits of laz_change, known already */
  template <typename Coder>
  void
  code(LazLayerCoder<Coder>* layers, std::uint32_t changed, const LazPoint14& wanted);

  /** \return the context of the changes */
  std::size_t
  changeContext() const
  {
    return (last.number() == 1 ? 1U : 0U) | (last.number() >= last.count() ? 2U : 0U) |
           (time_changed_ ? 4U : 0U);
  }

  LazPoint14 last;
  ModelSet changes{8, 128};
  ModelSet channels{1, 3};

private:
  template <typename Coder>
  void
  codeReturns(Coder& coder, std::uint32_t changed, const LazPoint14& wanted);
  template <typename Coder>
  void
  codePlace(LazLayerCoder<Coder>* layers, const LazPoint14& wanted);
  template <typename Coder>
  void
  codeAttributes(LazLayerCoder<Coder>* layers,
                 std::uint32_t changed,
                 const LazPoint14& wanted);

  /** \return 3 the only return, 2 the first, 1 the last, 0 in between */
  unsigned
  returnContext() const
  {
    return (last.number() == 1 ? 2U : 0U) | (last.number() >= last.count() ? 1U : 0U);
  }

  bool time_changed_ = false; ///< with the last point
  std::array<std::int32_t, 8> heights_{};
  std::array<std::uint16_t, 8> intensities_{};
  std::array<LazMedian, 12> medians_x_{}, medians_y_{};
  IntegerModel dx_{32, 2}, dy_{32, 22}, z_{32, 20}, intensity_{16, 4}, angle_{16, 2},
      source_{16, 1};
  ModelSet counts_{16, 16}, numbers_{16, 16}, numbers_of_pulse_{1, 13},
      classes_{64, 256}, flags_{64, 64}, user_data_{64, 256};
  LazTime time_;
};

/** \brief LAZ codec of LazPoint14 ("POINT14", version 3). Source: LAZ Specification 1.4 R1. */
class LazPoint14Codec {
public:
  explicit LazPoint14Codec(const LazPoint14& first) : channel_(first.channel())
  {
    channels_[channel_] = std::make_unique<LazChannel14>(first);
  }

  /** \return the channel of the scanner of the last point */
  unsigned
  channel() const
  {
    return channel_;
  }

  template <typename Coder>
  LazPoint14
  code(LazLayerCoder<Coder>* layers, const LazPoint14& wanted)
  {
    LazChannel14& before = *channels_[channel_];
    Coder& coder = layers[kLazXy].coder;
    std::uint32_t changed = 0;
    if constexpr (Coder::kEncodes)
      changed = changesTo(wanted);
    changed = coder.symbol(before.changes[before.changeContext()], changed);
    if ((changed & laz_change::kChannel) != 0) {
      const std::uint32_t step =
          coder.symbol(before.channels[0], (wanted.channel() - channel_ - 1) & 3);
      channel_ = (channel_ + step + 1) % 4;
      if (!channels_[channel_])
        channels_[channel_] = std::make_unique<LazChannel14>(before.last);
      LazPoint14& last = channels_[channel_]->last;
      last.flags = static_cast<std::uint8_t>((last.flags & ~0x30U) | channel_ << 4);
    }
    channels_[channel_]->code(layers, changed, wanted);
    return channels_[channel_]->last;
  }

private:
  std::uint32_t
  changesTo(const LazPoint14& wanted) const
  {
    const bool same_channel = wanted.channel() == channel_;
    const LazChannel14* const known = channels_[wanted.channel()].get();
    const LazPoint14& last = (known ? known : channels_[channel_].get())->last;
    const unsigned step = (wanted.number() - last.number()) & 15;
    return (same_channel ? 0 : laz_change::kChannel) |
           (last.source == wanted.source ? 0 : laz_change::kSource) |
           (last.time == wanted.time ? 0 : laz_change::kTime) |
           (last.angle == wanted.angle ? 0 : laz_change::kAngle) |
           (last.count() == wanted.count() ? 0 : laz_change::kCount) |
           (step == 0    ? 0
            : step == 1  ? 1
            : step == 15 ? 2
                         : laz_change::kNumber);
  }

  unsigned channel_;
  std::array<std::unique_ptr<LazChannel14>, 4> channels_;
};

template <typename Coder>
void
LazChannel14::code(LazLayerCoder<Coder>* layers,
                   std::uint32_t changed,
                   const LazPoint14& wanted)
{
  if constexpr (Coder::kEncodes) {
    const auto look = [&](LazLayer layer, bool has_changed) {
      layers[layer].has_changed = layers[layer].has_changed || has_changed;
    };
    look(kLazZ, last.z != wanted.z);
    look(kLazClassification, last.classification != wanted.classification);
    look(kLazFlags, last.otherFlags() != wanted.otherFlags());
    look(kLazIntensity, last.intensity != wanted.intensity);
    look(kLazAngle, last.angle != wanted.angle);
    look(kLazUserData, last.user_data != wanted.user_data);
    look(kLazSource, last.source != wanted.source);
    look(kLazTime, last.time != wanted.time);
  }
  codeReturns(layers[kLazXy].coder, changed, wanted);
  time_changed_ = (changed & laz_change::kTime) != 0;
  codePlace(layers, wanted);
  codeAttributes(layers, changed, wanted);
}

template <typename Coder>
void
LazChannel14::codeReturns(Coder& coder, std::uint32_t changed, const LazPoint14& wanted)
{
  std::uint32_t count = last.count();
  if ((changed & laz_change::kCount) != 0)
    count = coder.symbol(counts_[count], wanted.count());
  std::uint32_t number = last.number();
  switch (changed & laz_change::kNumber) {
  case 1:
    number += 1;
    break;
  case 2:
    number += 15;
    break;
  case 3:
    if ((changed & laz_change::kTime) != 0)
      number = coder.symbol(numbers_[number], wanted.number());
    else // by 2 to 14: smaller changes have separate symbols
      number +=
          2 + coder.symbol(numbers_of_pulse_[0], (wanted.number() - number - 2) & 15);
    break;
  default:
    break;
  }
  last.returns = static_cast<std::uint8_t>((number & 15) | count << 4);
}

/** \return one of six contexts, by number of returns and return number */
inline std::size_t
lazReturnContext(unsigned count, unsigned number)
{
  // From the specification, a row of digits for each number of returns.
  static constexpr const char* kContexts[16] = {"0123453445555555",
                                                "1013333333333333",
                                                "2124444444433333",
                                                "3345444444444444",
                                                "4344544444444444",
                                                "5344454444444444",
                                                "3344445444444444",
                                                "4344444544444444",
                                                "4344444454444444",
                                                "5344444445444444",
                                                "5344444444544444",
                                                "5334444444455444",
                                                "5334444444455544",
                                                "5334444444445554",
                                                "5334444444444555",
                                                "5334444444444455"};
  return static_cast<std::size_t>(kContexts[count][number] - '0');
}

template <typename Coder>
void
LazChannel14::codePlace(LazLayerCoder<Coder>* layers, const LazPoint14& wanted)
{
  const unsigned count = last.count(), number = last.number();
  const std::size_t returns =
      2 * lazReturnContext(count, number) + (time_changed_ ? 1 : 0);
  const std::size_t single = count == 1 ? 1 : 0;
  Coder& coder = layers[kLazXy].coder;
  LazMedian& in_x = medians_x_[returns];
  const std::int32_t dx =
      dx_.code(coder, in_x.median(), single, lazDifference(wanted.x, last.x));
  last.x = lazSum(last.x, dx);
  in_x.add(dx);
  LazMedian& in_y = medians_y_[returns];
  const std::int32_t dy = dy_.code(coder,
                                   in_y.median(),
                                   single + lazSizeContext(dx_.size(), 20),
                                   lazDifference(wanted.y, last.y));
  last.y = lazSum(last.y, dy);
  in_y.add(dy);
  if (!layers[kLazZ].is_there)
    return;
  const unsigned behind = count > number ? count - number : number - count;
  std::int32_t& height = heights_[std::min(behind, 7U)];
  height = z_.code(layers[kLazZ].coder,
                   height,
                   single + lazSizeContext((dx_.size() + dy_.size()) / 2, 18),
                   wanted.z);
  last.z = height;
}

template <typename Coder>
void
LazChannel14::codeAttributes(LazLayerCoder<Coder>* layers,
                             std::uint32_t changed,
                             const LazPoint14& wanted)
{
  const unsigned place = returnContext();
  const auto coderOf = [&](LazLayer layer) -> Coder& { return layers[layer].coder; };
  if (layers[kLazClassification].is_there)
    last.classification = static_cast<std::uint8_t>(
        coderOf(kLazClassification)
            .symbol(classes_[(last.classification & 31) * 2 + (place == 3 ? 1 : 0)],
                    wanted.classification));
  if (layers[kLazFlags].is_there) {
    const std::uint32_t flags =
        coderOf(kLazFlags).symbol(flags_[last.otherFlags()], wanted.otherFlags());
    last.flags = static_cast<std::uint8_t>((flags & 15) | (last.flags & 0x30) |
                                           (flags & 48) << 2);
  }
  if (layers[kLazIntensity].is_there) {
    std::uint16_t& intensity = intensities_[2 * place + (time_changed_ ? 1 : 0)];
    intensity = static_cast<std::uint16_t>(
        intensity_.code(coderOf(kLazIntensity), intensity, place, wanted.intensity));
    last.intensity = intensity;
  }
  if (layers[kLazAngle].is_there && (changed & laz_change::kAngle) != 0)
    last.angle = static_cast<std::int16_t>(angle_.code(
        coderOf(kLazAngle), last.angle, time_changed_ ? 1 : 0, wanted.angle));
  if (layers[kLazUserData].is_there)
    last.user_data = static_cast<std::uint8_t>(
        coderOf(kLazUserData).symbol(user_data_[last.user_data / 4], wanted.user_data));
  if (layers[kLazSource].is_there && (changed & laz_change::kSource) != 0)
    last.source = static_cast<std::uint16_t>(
        source_.code(coderOf(kLazSource), last.source, 0, wanted.source));
  if (layers[kLazTime].is_there && time_changed_)
    last.time = time_.code(coderOf(kLazTime), wanted.time);
}

} // namespace pcl6d::io

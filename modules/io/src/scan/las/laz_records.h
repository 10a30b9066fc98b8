// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scan/las/laz_point10.h"
#include "scan/las/laz_point14.h"

#include <optional>
#include <vector>

/** \file Whole points of LAZ: the first point of a chunk initialises the codecs, and the further
 * points are coded. Source: LAZ Specification 1.4 R1. */
namespace pcl6d::io {

/** \brief The parts of a point in a LAZ file, in order. */
struct LazItems {
  bool is_layered = false;   ///< formats 6 to 10
  bool has_time = false;     ///< 8 bytes; layered points have theirs in the first part
  bool has_colours = false;  ///< 6 bytes
  bool has_infrared = false; ///< 2 bytes; of layered points
  std::size_t num_bytes = 0; ///< further ones
  /** the channel of the scanner selects the context in all layers, from version 4 of the items
   * on; in earlier versions only on a change, and the previous value may belong to a different
   * channel */
  bool has_right_channels = false;

  /** \return [byte] of a point */
  std::size_t
  size() const
  {
    return (is_layered ? 30U : 20U) + (has_time ? 8U : 0U) + (has_colours ? 6U : 0U) +
           (has_infrared ? 2U : 0U) + num_bytes;
  }
  /** \return how many layers a point has */
  std::size_t
  numLayers() const
  {
    return kLazLayers14 + (has_colours ? 1U : 0U) + (has_infrared ? 1U : 0U) +
           num_bytes;
  }
};

inline LazColour
lazColourOf(const std::uint8_t* bytes)
{
  return {lasNumber<std::uint16_t>(bytes),
          lasNumber<std::uint16_t>(bytes + 2),
          lasNumber<std::uint16_t>(bytes + 4)};
}

inline void
storeLazColour(const LazColour& colour, std::uint8_t* bytes)
{
  for (std::size_t i = 0; i < colour.size(); ++i)
    storeLasNumber(bytes + 2 * i, colour[i]);
}

/** \brief Points of formats 0 to 5, in sequence in one coder. */
class LazPointwise {
public:
  LazPointwise(const LazItems& items, const std::uint8_t* first)
  : items_(items), point_(LazPoint10::of(first))
  {
    first += 20;
    if (items.has_time) {
      time_.emplace(lasNumber<std::int64_t>(first), true);
      first += 8;
    }
    if (items.has_colours) {
      colour_ = lazColourOf(first);
      first += 6;
    }
    last_bytes_.assign(first, first + items.num_bytes);
    bytes_.resize(items.num_bytes);
  }

  /** \param[in,out] record the point; written by a decoder, previous bytes must be defined */
  template <typename Coder>
  void
  code(Coder& coder, std::uint8_t* record)
  {
    point_.code(coder, LazPoint10::of(record)).store(record);
    record += 20;
    if (time_) {
      storeLasNumber(record, time_->code(coder, lasNumber<std::int64_t>(record)));
      record += 8;
    }
    if (items_.has_colours) {
      colours_.code(coder, colour_, lazColourOf(record));
      storeLazColour(colour_, record);
      record += 6;
    }
    for (std::size_t i = 0; i < bytes_.size(); ++i) {
      bytes_[i].code(coder, last_bytes_[i], record[i]);
      record[i] = last_bytes_[i];
    }
  }

private:
  LazItems items_;
  LazPoint10Codec point_;
  std::optional<LazTime> time_;
  LazColour colour_{};
  LazColours colours_;
  std::vector<std::uint8_t> last_bytes_;
  std::vector<LazByte> bytes_;
};

/** \brief A part of layered points, with models for each channel of the scanner. */
template <typename Models>
class LazChannelModels {
public:
  using Value = typename Models::Value;

  LazChannelModels(std::size_t channel, const Value& first) : channel_(channel)
  {
    models_[channel].emplace();
    lasts_[channel] = first;
  }

  /** \return the value */
  template <typename Coder>
  Value
  code(LazLayerCoder<Coder>& layer,
       std::size_t channel,
       bool has_right_channels,
       const Value& wanted)
  {
    std::size_t of_last = channel_;
    if (channel != channel_) {
      if (!models_[channel]) {
        models_[channel].emplace();
        lasts_[channel] = lasts_[channel_];
        of_last = channel;
      }
      else if (has_right_channels)
        of_last = channel;
      channel_ = channel;
    }
    Value& last = lasts_[of_last];
    if constexpr (Coder::kEncodes)
      layer.has_changed = layer.has_changed || last != wanted;
    if (layer.is_there)
      models_[channel]->code(layer.coder, last, wanted);
    return last;
  }

private:
  std::size_t channel_;
  std::array<std::optional<Models>, 4> models_;
  std::array<Value, 4> lasts_{};
};

/** \brief Points of formats 6 to 10, with a coder for each part. */
class LazLayered {
public:
  LazLayered(const LazItems& items, const std::uint8_t* first)
  : items_(items), point_(LazPoint14::of(first))
  {
    first += 30;
    if (items.has_colours) {
      colours_.emplace(point_.channel(), lazColourOf(first));
      first += 6;
    }
    if (items.has_infrared) {
      infrared_.emplace(point_.channel(), lasNumber<std::uint16_t>(first));
      first += 2;
    }
    for (std::size_t i = 0; i < items.num_bytes; ++i)
      bytes_.emplace_back(point_.channel(), first[i]);
  }

  /** \param[in] layers array of items.numLayers() coders \param[in,out] record see LazPointwise */
  template <typename Coder>
  void
  code(LazLayerCoder<Coder>* layers, std::uint8_t* record)
  {
    const unsigned before = point_.channel();
    point_.code(layers, LazPoint14::of(record)).store(record);
    layers += kLazLayers14;
    record += 30;
    const bool right = items_.has_right_channels;
    const std::size_t channel =
        right || point_.channel() != before ? point_.channel() : 0;
    if (colours_) {
      storeLazColour(colours_->code(*layers++, channel, right, lazColourOf(record)),
                     record);
      record += 6;
    }
    if (infrared_) {
      storeLasNumber(
          record,
          infrared_->code(*layers++, channel, right, lasNumber<std::uint16_t>(record)));
      record += 2;
    }
    for (auto& byte : bytes_) {
      *record = byte.code(*layers++, channel, right, *record);
      ++record;
    }
  }

private:
  LazItems items_;
  LazPoint14Codec point_;
  std::optional<LazChannelModels<LazColours>> colours_;
  std::optional<LazChannelModels<LazInfrared>> infrared_;
  std::vector<LazChannelModels<LazByte>> bytes_;
};

} // namespace pcl6d::io

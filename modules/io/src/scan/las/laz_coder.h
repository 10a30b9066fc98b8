// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "scan/las/laz_models.h"

#include <string>

/** \file The arithmetic coder of LAZ. Decoder and encoder have equal interfaces: the encoder
 * writes the given value, the decoder ignores the argument; both return the value. A single
 * implementation therefore defines the order of the coded values for both. Source: see
 * laz_models.h. */
namespace pcl6d::io {

constexpr std::uint32_t kLazShortest = 1U << 24; // interval; a byte is output below

/** \brief Reads values out of compressed bytes. */
class LazDecoder {
public:
  static constexpr bool kEncodes = false;

  LazDecoder() = default;
  /** \brief Starts decoding; the bytes must stay valid. */
  LazDecoder(const std::uint8_t* begin, const std::uint8_t* end)
  : place_(begin), end_(end)
  {
    for (int i = 0; i < 4; ++i)
      value_ = value_ << 8 | nextByte();
  }

  std::uint32_t
  symbol(SymbolModel& model, std::uint32_t /*wanted*/)
  {
    constexpr std::uint32_t kLast = (1U << SymbolModel::kBits) - 1;
    const std::uint32_t unit = length_ >> SymbolModel::kBits;
    const std::uint32_t probability = value_ / unit;
    const std::uint32_t symbol =
        model.symbolAt(probability < kLast ? probability : kLast);
    const std::uint32_t low = model.below(symbol) * unit;
    const std::uint32_t high =
        symbol + 1 < model.count() ? model.below(symbol + 1) * unit : length_;
    take(low, high - low);
    model.add(symbol);
    return symbol;
  }

  std::uint32_t
  bit(BitModel& model, std::uint32_t /*wanted*/)
  {
    const std::uint32_t zero = model.ofZero() * (length_ >> BitModel::kBits);
    const std::uint32_t bit = value_ >= zero ? 1 : 0;
    bit ? take(zero, length_ - zero) : take(0, zero);
    model.add(bit);
    return bit;
  }

  /** \brief Bits of equal probability. \param[in] count 1 to 32 */
  std::uint32_t
  bits(std::uint32_t count, std::uint32_t /*wanted*/)
  {
    if (count > 19) {
      const std::uint32_t low = bits(16, 0);
      return bits(count - 16, 0) << 16 | low;
    }
    const std::uint32_t unit = length_ >> count;
    const std::uint32_t most = (1U << count) - 1;
    const std::uint32_t found = value_ / unit;
    const std::uint32_t value = found < most ? found : most;
    take(value * unit, unit);
    return value;
  }

  /** \return the position of the next byte */
  const std::uint8_t*
  place() const
  {
    return place_;
  }

  /** \return whether the input ended early or is invalid */
  bool
  isBroken() const
  {
    return broken_;
  }

  void
  setBroken()
  {
    broken_ = true;
  }

private:
  std::uint32_t
  nextByte()
  {
    if (place_ != end_)
      return *place_++;
    broken_ = true;
    return 0;
  }

  void
  take(std::uint32_t low, std::uint32_t length)
  {
    value_ -= low;
    length_ = length;
    while (length_ < kLazShortest && !broken_) {
      value_ = value_ << 8 | nextByte();
      length_ <<= 8;
    }
    if (broken_) // values may be any, but are defined
      length_ = ~0U;
  }

  const std::uint8_t* place_ = nullptr;
  const std::uint8_t* end_ = nullptr;
  std::uint32_t value_ = 0;
  std::uint32_t length_ = ~0U;
  bool broken_ = false;
};

/** \brief Encodes values to compressed bytes. */
class LazEncoder {
public:
  static constexpr bool kEncodes = true;

  std::uint32_t
  symbol(SymbolModel& model, std::uint32_t symbol)
  {
    const std::uint32_t unit = length_ >> SymbolModel::kBits;
    const std::uint32_t low = model.below(symbol) * unit;
    const std::uint32_t high =
        symbol + 1 < model.count() ? model.below(symbol + 1) * unit : length_;
    give(low, high - low);
    model.add(symbol);
    return symbol;
  }

  std::uint32_t
  bit(BitModel& model, std::uint32_t bit)
  {
    const std::uint32_t zero = model.ofZero() * (length_ >> BitModel::kBits);
    bit ? give(zero, length_ - zero) : give(0, zero);
    model.add(bit);
    return bit;
  }

  std::uint32_t
  bits(std::uint32_t count, std::uint32_t value)
  {
    if (count > 19) {
      bits(16, value & 0xffff);
      bits(count - 16, value >> 16);
      return value;
    }
    const std::uint32_t unit = length_ >> count;
    give(value * unit, unit);
    return value;
  }

  /** \return all bytes; resets the encoder */
  std::string
  finish();

  void
  setBroken()
  {}

private:
  void
  give(std::uint32_t low, std::uint32_t length)
  {
    const std::uint32_t before = base_;
    base_ += low;
    length_ = length;
    if (base_ < before)
      carry();
    while (length_ < kLazShortest) {
      bytes_ += static_cast<char>(base_ >> 24);
      base_ <<= 8;
      length_ <<= 8;
    }
  }

  void
  carry();

  std::string bytes_;
  std::uint32_t base_ = 0;
  std::uint32_t length_ = ~0U;
};

} // namespace pcl6d::io

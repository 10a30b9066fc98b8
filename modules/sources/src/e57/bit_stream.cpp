// SPDX-License-Identifier: BSD-3-Clause
#include "e57/bit_stream.h"

#include <algorithm>
#include <cstring>

namespace pcl6d::sources {

namespace {

/** \return a mask of the lowest bits; 64 at most, 1 at least */
std::uint64_t
lowest(unsigned bits)
{
  return ~std::uint64_t{0} >> (64 - bits);
}

template <typename T>
void
dropFirst(std::vector<T>& values, std::size_t count)
{
  values.erase(values.begin(),
               values.begin() +
                   static_cast<std::ptrdiff_t>(std::min(count, values.size())));
}

template <typename Target, typename Source>
Target
sameBits(Source source)
{
  static_assert(sizeof(Target) == sizeof(Source), "bits of the first for the second");
  Target target;
  std::memcpy(&target, &source, sizeof target);
  return target;
}

} // namespace

void
E57Column::drop(std::size_t count)
{
  constexpr std::size_t kMany = 65536; // bounds the cost of moving the remaining bytes
  first_ += count;
  if (size() > 0 && first_ < std::max(kMany, size()))
    return;
  dropFirst(reals_, first_);
  dropFirst(integers_, first_);
  first_ = 0;
}

void
E57Column::copyValues(const E57Field& field,
                      std::size_t count,
                      std::vector<double>& values) const
{
  values.resize(count);
  if (field.isInteger())
    for (std::size_t i = 0; i < count; ++i)
      values[i] = field.valueOf(integer(i));
  else
    std::copy_n(reals_.data() + first_, count, values.data());
}

BitDecoder::BitDecoder(const E57Field& field, std::uint64_t count)
: field_(field), bits_(field.bits()), missing_(count)
{}

void
BitDecoder::appendConstants(std::size_t count)
{
  column_.addIntegers(field_.minimum, count);
  missing_ -= count;
}

/** Calls store() with the number and the bits of each value. \param[in] count of values, all
 * within bytes_, with room behind */
template <typename Store>
void
BitDecoder::unpack(std::size_t count, Store&& store)
{
  const std::uint64_t mask = lowest(bits_);
  std::size_t place = done_; // [bit]
  for (std::size_t i = 0; i < count; ++i, place += bits_) {
    const std::uint8_t* const at = &bytes_[place / 8];
    const unsigned shift = place % 8;
    std::uint64_t word = 0;
    std::memcpy(&word, at, sizeof word);
    word >>= shift;
    if (shift + bits_ > 64)
      word |= std::uint64_t{at[8]} << (64 - shift);
    store(i, word & mask);
  }
}

void
BitDecoder::append(const std::uint8_t* bytes, std::size_t count)
{
  if (bits_ == 0 || missing_ == 0)
    return;
  constexpr std::size_t kBeyond = 9; // bytes touched at most by a 64-bit value
  bytes_.insert(bytes_.end(), bytes, bytes + count);
  const std::size_t size = bytes_.size();
  const auto values = static_cast<std::size_t>(
      std::min<std::uint64_t>(missing_, (size * 8 - done_) / bits_));
  bytes_.resize(size + kBeyond);
  if (field_.isInteger()) {
    std::int64_t* const target = column_.growIntegers(values);
    const auto minimum = static_cast<std::uint64_t>(field_.minimum);
    // Modulo 2^64: a value above the maximum of a broken file is no overflow.
    unpack(values, [=](std::size_t i, std::uint64_t word) {
      target[i] = sameBits<std::int64_t>(minimum + word);
    });
  }
  else {
    double* const target = column_.growReals(values);
    if (field_.kind == E57Kind::kDouble)
      unpack(values, [=](std::size_t i, std::uint64_t word) {
        target[i] = sameBits<double>(word);
      });
    else
      unpack(values, [=](std::size_t i, std::uint64_t word) {
        target[i] = sameBits<float>(static_cast<std::uint32_t>(word));
      });
  }
  const std::size_t end = done_ + values * bits_; // [bit]
  missing_ -= values;
  bytes_.resize(size);
  dropFirst(bytes_, end / 8);
  done_ = end % 8;
}

void
BitEncoder::addReal(double value)
{
  add(field_.kind == E57Kind::kDouble
          ? sameBits<std::uint64_t>(value)
          : sameBits<std::uint32_t>(static_cast<float>(value)));
}

void
BitEncoder::addInteger(std::int64_t value)
{
  add(static_cast<std::uint64_t>(value) - static_cast<std::uint64_t>(field_.minimum));
}

void
BitEncoder::add(std::uint64_t word)
{
  if (used_ == 0 && bits_ % 8 == 0) { // whole bytes
    std::uint8_t bytes[sizeof word];
    std::memcpy(bytes, &word, sizeof word);
    bytes_.insert(bytes_.end(), bytes, bytes + bits_ / 8);
    return;
  }
  for (unsigned left = bits_; left > 0;) {
    if (used_ == 0)
      bytes_.push_back(0);
    const unsigned part = std::min(left, 8 - used_);
    bytes_.back() |= static_cast<std::uint8_t>((word & lowest(part)) << used_);
    word = part == 64 ? 0 : word >> part;
    used_ = (used_ + part) % 8;
    left -= part;
  }
}

std::size_t
BitEncoder::waiting(bool all) const
{
  return bytes_.size() - (!all && used_ > 0 ? 1 : 0);
}

void
BitEncoder::take(std::size_t count, std::vector<std::uint8_t>& target)
{
  target.insert(target.end(),
                bytes_.begin(),
                bytes_.begin() + static_cast<std::ptrdiff_t>(count));
  dropFirst(bytes_, count);
}

} // namespace pcl6d::sources

// SPDX-License-Identifier: BSD-3-Clause
#include "scan/las/laz_models.h"

#include <algorithm>

namespace pcl6d::io {

namespace {
constexpr std::uint32_t kUnit = 1U << 31; // of probabilities during the update
} // namespace

SymbolModel::SymbolModel(std::uint32_t count)
: counts_(count, 1), cumulative_(count), cycle_(count)
{
  std::uint32_t bits = 3; // a part for each four symbols is found fast
  while (count > (1U << (bits + 2)))
    ++bits;
  shift_ = kBits - bits;
  first_.resize(std::size_t{1} << bits);
  update();
  cycle_ = (count + 6) / 2;
  until_update_ = cycle_;
}

void
SymbolModel::update()
{
  total_ += cycle_;
  if (total_ > (1U << kBits)) { // older symbols count less
    total_ = 0;
    for (std::uint32_t& count : counts_) {
      count = (count + 1) / 2;
      total_ += count;
    }
  }
  const std::uint32_t scale = kUnit / total_;
  std::uint32_t sum = 0;
  std::size_t part = 0;
  for (std::uint32_t symbol = 0; symbol < count(); ++symbol) {
    cumulative_[symbol] = (scale * sum) >> (31 - kBits);
    sum += counts_[symbol];
    // Parts that begin below the symbol begin within the previous symbol.
    for (; part < first_.size() && (part << shift_) < cumulative_[symbol]; ++part)
      first_[part] = static_cast<std::uint16_t>(symbol - 1);
  }
  for (; part < first_.size(); ++part)
    first_[part] = static_cast<std::uint16_t>(count() - 1);
  cycle_ = std::min(5 * cycle_ / 4, 8 * (count() + 6));
  until_update_ = cycle_;
}

void
BitModel::update()
{
  total_ += cycle_;
  if (total_ > (1U << kBits)) {
    total_ = (total_ + 1) / 2;
    zeros_ = (zeros_ + 1) / 2;
    if (zeros_ == total_)
      ++total_;
  }
  of_zero_ = (zeros_ * (kUnit / total_)) >> (31 - kBits);
  cycle_ = std::min(5 * cycle_ / 4, 64U);
  until_update_ = cycle_;
}

} // namespace pcl6d::io

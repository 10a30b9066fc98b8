// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

/** \file Adaptive probability models of LAZ's arithmetic coder. Source: A. Said,
 * "Introduction to Arithmetic Coding - Theory and Practice", HPL-2004-76, 2004; numbers of
 * bits and periods of the updates: LAZ Specification 1.4 R1, 2019. */
namespace pcl6d::io {

/** \brief Adaptive probabilities of the symbols 0 to n - 1. */
class SymbolModel {
public:
  static constexpr std::uint32_t kBits = 15; ///< of a cumulative probability

  SymbolModel() = default;
  /** \param[in] count of symbols, 2 to 2048; equally probable at first */
  explicit SymbolModel(std::uint32_t count);

  std::uint32_t
  count() const
  {
    return static_cast<std::uint32_t>(cumulative_.size());
  }

  /** \return the probability of all smaller symbols, times 2^kBits */
  std::uint32_t
  below(std::uint32_t symbol) const
  {
    return cumulative_[symbol];
  }

  /** \return the symbol of a cumulative probability below 2^kBits */
  std::uint32_t
  symbolAt(std::uint32_t probability) const
  {
    std::uint32_t symbol = first_[probability >> shift_];
    while (symbol + 1 < count() && cumulative_[symbol + 1] <= probability)
      ++symbol;
    return symbol;
  }

  /** \brief Counts a coded symbol. */
  void
  add(std::uint32_t symbol)
  {
    ++counts_[symbol];
    if (--until_update_ == 0)
      update();
  }

private:
  void
  update();

  std::vector<std::uint32_t> counts_;
  std::vector<std::uint32_t> cumulative_;
  std::vector<std::uint16_t> first_; ///< first symbol of each equal part of the range
  std::uint32_t shift_ = 0;          ///< from a probability to the index of its part
  std::uint32_t total_ = 0;
  std::uint32_t cycle_ = 0; ///< symbols between updates
  std::uint32_t until_update_ = 0;
};

/** \brief Adaptive probability of a bit. */
class BitModel {
public:
  static constexpr std::uint32_t kBits = 13; ///< of the probability

  /** \return the probability of 0, times 2^kBits */
  std::uint32_t
  ofZero() const
  {
    return of_zero_;
  }

  void
  add(std::uint32_t bit)
  {
    zeros_ += bit == 0 ? 1 : 0;
    if (--until_update_ == 0)
      update();
  }

private:
  void
  update();

  std::uint32_t zeros_ = 1;
  std::uint32_t total_ = 2;
  std::uint32_t of_zero_ = 1U << (kBits - 1);
  std::uint32_t cycle_ = 4;
  std::uint32_t until_update_ = 4;
};

/** \brief Models of equal size, for each context, created on first use. */
class ModelSet {
public:
  ModelSet(std::size_t contexts, std::uint32_t symbols)
  : symbols_(symbols), models_(contexts)
  {}

  SymbolModel&
  operator[](std::size_t context)
  {
    SymbolModel& model = models_[context];
    if (model.count() == 0)
      model = SymbolModel(symbols_);
    return model;
  }

private:
  std::uint32_t symbols_;
  std::vector<SymbolModel> models_;
};

} // namespace pcl6d::io

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "e57/e57_layout.h"

#include <vector>

namespace pcl6d::sources {

/** \brief Buffered values of a field: floating point, or integers as stored. */
class E57Column {
public:
  std::size_t
  size() const
  {
    return reals_.size() + integers_.size() - first_; // one vector is empty
  }

  double
  real(std::size_t i) const
  {
    return reals_[first_ + i];
  }

  std::int64_t
  integer(std::size_t i) const
  {
    return integers_[first_ + i];
  }

  /** \brief Converts the first stored values to numbers. \param[in] field of the column */
  void
  copyValues(const E57Field& field,
             std::size_t count,
             std::vector<double>& values) const;

  /** \brief Adds room for values. \return the start of the new room, to be filled */
  double*
  growReals(std::size_t count)
  {
    reals_.resize(reals_.size() + count);
    return reals_.data() + reals_.size() - count;
  }
  std::int64_t*
  growIntegers(std::size_t count)
  {
    integers_.resize(integers_.size() + count);
    return integers_.data() + integers_.size() - count;
  }

  void
  addReal(double value)
  {
    reals_.push_back(value);
  }
  void
  addIntegers(std::int64_t value, std::size_t count = 1)
  {
    integers_.insert(integers_.end(), count, value);
  }

  /** \brief Removes the first values. */
  void
  drop(std::size_t count);

private:
  std::vector<double> reals_;
  std::vector<std::int64_t> integers_;
  std::size_t first_ = 0; ///< dropped values still in the vector
};

/** \brief Decodes the bytes of a field to values. Values are packed without gaps, lowest bit
 * first; a value may begin in a packet and end in the next. */
class BitDecoder {
public:
  /** \param[in] count number of values of the field, equal to the number of points */
  BitDecoder(const E57Field& field, std::uint64_t count);

  /** \brief Takes the bytes of a packet. */
  void
  append(const std::uint8_t* bytes, std::size_t count);

  /** \brief Adds values that take no bits in the file. */
  void
  appendConstants(std::size_t count);

  /** \return the decoded values not yet dropped */
  E57Column&
  column()
  {
    return column_;
  }

  /** \return the number of values still to come */
  std::uint64_t
  missing() const
  {
    return missing_;
  }

  bool
  isConstant() const
  {
    return bits_ == 0;
  }

private:
  template <typename Store>
  void
  unpack(std::size_t count, Store&& store);

  E57Field field_;
  unsigned bits_;
  std::uint64_t missing_;
  std::vector<std::uint8_t> bytes_; ///< of incomplete values
  unsigned done_ = 0;               ///< used bits of the first byte
  E57Column column_;
};

/** \brief Turns values into the bytes of a field. */
class BitEncoder {
public:
  explicit BitEncoder(const E57Field& field) : field_(field), bits_(field.bits()) {}

  void
  addReal(double value);
  void
  addInteger(std::int64_t value);

  /** \return number of complete bytes \param[in] all including the bytes of a value in progress */
  std::size_t
  waiting(bool all) const;

  /** \brief Moves pending bytes to the end of `target`. */
  void
  take(std::size_t count, std::vector<std::uint8_t>& target);

private:
  void
  add(std::uint64_t word);

  E57Field field_;
  unsigned bits_;
  std::vector<std::uint8_t> bytes_;
  unsigned used_ = 0; ///< used bits of the last byte; 0: full
};

} // namespace pcl6d::sources

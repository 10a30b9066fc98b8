// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Core>

#include <limits>
#include <type_traits>

/** \file The range of numbers that enter, and the way from a double to a whole number. */
namespace PCL6D_EXPORTS pcl6d {

/** \brief [m] A coordinate as large as this is no place: 2.5 times as far as the moon, 150
 * times the radius of the earth. A double still tells 0.1 um apart there, and no product or
 * square of such lengths overflows. */
constexpr double kFarthestCoordinate = 1e9;

/** \return whether all coordinates [m] are finite and below kFarthestCoordinate */
template <typename Derived>
bool
isPlace(const Eigen::MatrixBase<Derived>& p)
{
  using Scalar = typename Derived::Scalar;
  return (p.array().abs() < static_cast<Scalar>(kFarthestCoordinate)).all();
}

/** \brief A cast that is defined for every number, where that of the language is not for
 * what the type cannot hold.
 * \return the value without its fraction, or the nearest that the type holds; 0 for NaN */
template <typename Integer>
constexpr Integer
clampedTo(double value)
{
  static_assert(std::is_integral_v<Integer>, "to a whole number");
  using Limits = std::numeric_limits<Integer>;
  // 2^digits is exact in a double, where the largest 64-bit numbers are not.
  constexpr auto kHalf = Limits::max() / 2 + 1; // a power of two, so a double holds it
  constexpr double kEnd = 2.0 * static_cast<double>(kHalf);
  if (value >= kEnd)
    return Limits::max();
  if (value <= static_cast<double>(Limits::min()))
    return Limits::min();
  return value == value ? static_cast<Integer>(value) : Integer{0};
}

} // namespace pcl6d

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <Eigen/Core>

#include <limits>
#include <type_traits>

/** \file The valid range of input numbers, and the conversion from double to integer. */
namespace PCL6D_EXPORTS pcl6d {

/** \brief [m] Coordinates of this size are invalid: 2.5 times the distance of the moon, 150
 * times the radius of the earth. A double still resolves 0.1 um at the limit, and products and
 * squares of the lengths do not overflow. */
constexpr double kFarthestCoordinate = 1e9;

/** \return whether all coordinates [m] are finite and below kFarthestCoordinate */
template <typename Derived>
bool
isPlace(const Eigen::MatrixBase<Derived>& p)
{
  using Scalar = typename Derived::Scalar;
  return (p.array().abs() < static_cast<Scalar>(kFarthestCoordinate)).all();
}

/** \brief A cast from double that is defined for every number; the cast of the language is
 * undefined outside the type's range.
 * \return the value without the fraction, or the nearest number of the type; 0 for NaN */
template <typename Integer>
constexpr Integer
clampedTo(double value)
{
  static_assert(std::is_integral_v<Integer>, "to a whole number");
  using Limits = std::numeric_limits<Integer>;
  // 2^digits is exact in a double, where the largest 64-bit numbers are not.
  constexpr auto kHalf = Limits::max() / 2 + 1; // a power of two, exact in double
  constexpr double kEnd = 2.0 * static_cast<double>(kHalf);
  if (value >= kEnd)
    return Limits::max();
  if (value <= static_cast<double>(Limits::min()))
    return Limits::min();
  return value == value ? static_cast<Integer>(value) : Integer{0};
}

} // namespace pcl6d

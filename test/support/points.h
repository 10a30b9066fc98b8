// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/error.h>
#include <pcl6d/common/points.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>
#include <string>

namespace pcl6d::test {

constexpr float kNan = std::numeric_limits<float>::quiet_NaN();
constexpr float kInfinity = std::numeric_limits<float>::infinity();

/** \return the points in an order that does not depend on theirs, to compare sets */
inline Points
sorted(Points points)
{
  std::sort(points.begin(), points.end(), [](const auto& a, const auto& b) {
    return std::lexicographical_compare(a.data(), a.data() + 3, b.data(), b.data() + 3);
  });
  return points;
}

/** Expects the same points with the same bits, in the same order; prints the first that
 * differs. */
inline void
expectSamePoints(const Points& found, const Points& expected)
{
  ASSERT_EQ(found.size(), expected.size());
  const auto [a, b] = std::mismatch(found.begin(), found.end(), expected.begin());
  if (a != found.end())
    ADD_FAILURE() << "point " << a - found.begin() << ": " << a->transpose()
                  << ", expected " << b->transpose();
}

/** \return the message of the BadArgument that the call throws; "" if it does not */
template <typename Call>
std::string
badArgumentOf(Call call)
{
  try {
    call();
  } catch (const BadArgument& e) {
    return e.what();
  }
  return "";
}

} // namespace pcl6d::test

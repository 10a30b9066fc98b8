// SPDX-License-Identifier: BSD-3-Clause
#include "surfaces.h"

#include <pcl6d/plane_segmentation/plane_map.h>

#include <gtest/gtest.h>

#include <sys/resource.h>

namespace {
/** \return the largest resident size of this process so far [MB] */
double
peakMemory()
{
  rusage usage{};
  ::getrusage(RUSAGE_SELF, &usage);
  return usage.ru_maxrss / 1024.0;
}
} // namespace

TEST(PlaneMapMemory, GrowsWithTheSurfaceAndNotWithTheTenMillionPoints)
{
  pcl6d::PlaneMap map;
  std::size_t given = 0;
  double after_first = 0;
  for (std::uint64_t scan = 0; given < 10000000; ++scan) {
    const pcl6d::Points points = pcl6d::test::room(0.01, 0.03, scan + 1);
    ASSERT_GT(points.size(), 50000u);
    given += points.size();
    map.addScan(points, Eigen::Isometry3d::Identity());
    if (scan == 4)
      after_first = peakMemory();
  }
  EXPECT_LT(peakMemory(), after_first + 30); // [MB]; the points alone are 120 MB
  EXPECT_GT(map.numPoints(), given * 9 / 10);
  const auto planes = map.planes();
  ASSERT_GE(planes.planes.size(), 6u);
  EXPECT_NEAR(planes.planes[0].plane.rms, 0.01, 0.001);
}

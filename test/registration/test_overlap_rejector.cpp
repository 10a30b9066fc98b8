// SPDX-License-Identifier: BSD-3-Clause
// The rejector of pairs at the rim of the overlap, for which PCL has no class.
#include "as_pcl_cases.h"

#include <pcl6d/registration/pcl/correspondence_rejector_overlap.h>

using namespace pcl6d::test;
using pcl6d::Points;

namespace {
using OrientedPoint = pcl::PointNormal;

pcl::Correspondences
left(pcl6d::CorrespondenceRejectorOverlap& rejector, const pcl::Correspondences& pairs)
{
  pcl::Correspondences remaining;
  rejector.getRemainingCorrespondences(pairs, remaining);
  return remaining;
}

/** \return a square of points 5 cm apart, side 2 m, from a corner, with a bend of a right
 * angle at y = 1 m */
Points
bentSheet(double from_x)
{
  Points points;
  for (int i = 0; i <= 40; ++i)
    for (int j = 0; j <= 40; ++j) {
      const double along = 0.05 * j;
      points.emplace_back(
          from_x + 0.05 * i, std::min(along, 1.0), std::max(0.0, along - 1));
    }
  return points;
}
} // namespace

TEST(OurOverlapRejector, FindsTheRimAndNotTheEdge)
{
  const auto target = toCloud<OrientedPoint>(bentSheet(0));
  pcl6d::CorrespondenceRejectorOverlap rejector;
  rejector.setInputTarget<OrientedPoint>(target);
  for (int i = 0; i <= 40; ++i)
    for (int j = 0; j <= 40; ++j) {
      const bool is_rim = i == 0 || i == 40 || j == 0 || j == 40;
      const bool is_near = i < 2 || i > 38 || j < 2 || j > 38;
      if (is_rim || !is_near) {
        EXPECT_EQ(rejector.isBoundary(41 * i + j), is_rim) << i << ' ' << j;
      }
    }
}

TEST(OurOverlapRejector, KeepsTheSourceFromBeingPulledOverTheRim)
{
  // The source reaches 0.6 m farther than the target; both are sampled at other places.
  const Eigen::Isometry3d truth =
      pcl6d::poseFromEuler({0.03, 0.01, -0.01}, {0, 0, 0.01});
  Points moved;
  for (const auto& p : bentSheet(0.617))
    moved.push_back((truth.inverse() * p.cast<double>()).cast<float>());
  const auto error = [&](bool with) {
    pcl6d::ICP6D<OrientedPoint, OrientedPoint, double> icp;
    icp.setInputTarget(toCloud<OrientedPoint>(bentSheet(0)));
    icp.setInputSource(toCloud<OrientedPoint>(moved));
    icp.setMaxCorrespondenceDistance(1);
    if (with)
      icp.addCorrespondenceRejector(
          pcl::make_shared<pcl6d::CorrespondenceRejectorOverlap>());
    alignFrom(icp);
    return errorOf(icp, truth).translation;
  };
  const double plain = error(false);
  EXPECT_GT(plain, 0.1);
  EXPECT_LT(error(true), 0.3 * plain);
}

TEST(OurOverlapRejector, GivesTheSamePairsForAnyNumberOfThreads)
{
  const auto target = cornerModel<OrientedPoint>();
  pcl::Correspondences pairs, first;
  for (int i = 0; i < 1998; ++i)
    pairs.emplace_back(i, 1997 - i, 0.1f);
  for (const unsigned int threads : {1u, 3u, 0u}) {
    pcl6d::CorrespondenceRejectorOverlap rejector;
    rejector.setNumberOfThreads(threads);
    rejector.setInputTarget<OrientedPoint>(target);
    const auto kept = left(rejector, pairs);
    if (first.empty())
      first = kept;
    EXPECT_EQ(queriesOf(kept), queriesOf(first));
  }
  // The rims are 3 x 4 sides of 4 m with points about 0.15 m apart.
  EXPECT_GT(first.size(), 1400u);
  EXPECT_LT(first.size(), 1900u);
}

TEST(OurOverlapRejector, SaysWhatIsWrong)
{
  pcl6d::CorrespondenceRejectorOverlap rejector;
  const pcl::Correspondences pairs = {{0, 5, 0.1f}};
  EXPECT_NE(badArgumentOf([&] { left(rejector, pairs); }).find("no target"),
            std::string::npos);
  rejector.setInputTarget<OrientedPoint>(
      toCloud<OrientedPoint>({{0, 0, 0}, {kNan, 0, 0}}));
  EXPECT_NE(badArgumentOf([&] { left(rejector, pairs); }).find("index"),
            std::string::npos);
  EXPECT_TRUE(rejector.isBoundary(0)) << "alone";
  EXPECT_TRUE(rejector.isBoundary(1)) << "not finite";
  for (const double angle : {0.0, -1.0, 7.0, static_cast<double>(kNan)})
    EXPECT_FALSE(badArgumentOf([&] { rejector.setBoundaryAngle(angle); }).empty());
  EXPECT_FALSE(badArgumentOf([&] { rejector.setKSearch(2); }).empty());
  EXPECT_FALSE(badArgumentOf([&] { rejector.setRadiusSearch(-1); }).empty());
  EXPECT_FALSE(
      badArgumentOf([&] { rejector.setInputTarget<OrientedPoint>(nullptr); }).empty());
  EXPECT_FALSE(badArgumentOf([&] { rejector.setTargetPoints(nullptr); }).empty());
}

// SPDX-License-Identifier: BSD-3-Clause
// UTM-sized coordinates. The points of a corner lie on a grid of half a metre, which float
// holds exactly there, so that the same run near the origin tells what is right.
#include "icp6d_cases.h"

#include <pcl6d/search/pcl/cached_kd_tree.h>

using namespace pcl6d::test;
using pcl6d::IcpIteration;
using pcl6d::Metric;
using pcl6d::Points;
using pcl6d::transformed;

namespace {
using Point = pcl::PointXYZ;
using DoubleIcp = pcl6d::ICP6D<Point, Point, double>;
const Eigen::Vector3d kPlace(6.9e5, 5.3e6, 100); // [m]
const Eigen::Isometry3d kOffset(Eigen::Translation3d{kPlace});
const Eigen::Isometry3d kFarStart =
    pcl6d::poseFromEuler({0.08, -0.06, 0.05}, {0.003, -0.004, 0.005});
// Double holds the place to 1e-9 m; the poses are products of a few.
constexpr double kTol = 2e-8; // [m], [rad]

/** \return a corner of 8 m on the grid */
Points
grid()
{
  Points points;
  for (int wall = 0; wall < 3; ++wall)
    for (int i = 1; i < 17; ++i)
      for (int j = 1; j < 17; ++j) {
        Eigen::Vector3f p = Eigen::Vector3f::Zero();
        p[(wall + 1) % 3] = 0.5f * static_cast<float>(i);
        p[(wall + 2) % 3] = 0.5f * static_cast<float>(j);
        points.push_back(p);
      }
  return points;
}

void
setUp(DoubleIcp& icp, const Points& source, const Points& target, Metric metric)
{
  icp.setInputSource(toCloud<Point>(source));
  icp.setInputTarget(toCloud<Point>(target));
  icp.setMaxCorrespondenceDistance(1);
  icp.setMotionEpsilon(1e-9, 1e-9);
  icp.setMetric(metric);
}

/** Expects the motions equal in how they move the corner. */
void
expectSameMotion(const Eigen::Isometry3d& found,
                 const Eigen::Isometry3d& expected,
                 const Eigen::Vector3d& source_place)
{
  EXPECT_LT((found * source_place - expected * source_place).norm(), kTol);
  EXPECT_LT(pcl6d::rotationAngle(expected.linear().transpose() * found.linear()), kTol);
}
} // namespace

TEST(Icp6DFar, AScanFindsItsPlaceInAModelAsItDoesNearTheOrigin)
{
  const Points scan = transformed(grid(), kFarStart.inverse());
  for (const Metric metric : kMetrics) {
    SCOPED_TRACE(toString(metric));
    DoubleIcp near, far;
    setUp(near, scan, grid(), metric);
    alignFrom(near);
    EXPECT_TRUE(near.hasConverged());
    EXPECT_LT(errorOf(near, kFarStart).translation, kExactTol);
    setUp(far, scan, transformed(grid(), kOffset), metric);
    alignFrom(far, kOffset);
    EXPECT_TRUE(far.hasConverged());
    EXPECT_EQ(far.result().pairs, near.result().pairs);
    EXPECT_EQ(far.result().iterations, near.result().iterations);
    expectSameMotion(Eigen::Isometry3d(far.getFinalTransformation()),
                     kOffset * Eigen::Isometry3d(near.getFinalTransformation()),
                     Eigen::Vector3d::Zero());
    EXPECT_NEAR(
        far.result().rms, near.result().rms, 10 * kTol); // a root of what is left
  }
}

TEST(Icp6DFar, TwoCloudsMeetWhereTheyLie)
{
  const Points corner = transformed(grid(), kOffset);
  for (const Metric metric : kMetrics) {
    SCOPED_TRACE(toString(metric));
    DoubleIcp icp;
    setUp(icp, corner, corner, metric);
    alignFrom(icp, kOffset * kFarStart * kOffset.inverse());
    EXPECT_TRUE(icp.hasConverged());
    expectSameMotion(
        icp.result().T_target_source, Eigen::Isometry3d::Identity(), kPlace);
  }
}

TEST(Icp6DFar, ObserverAndResultSpeakInTheTargetsFrame)
{
  DoubleIcp icp;
  setUp(icp,
        transformed(grid(), kFarStart.inverse()),
        transformed(grid(), kOffset),
        Metric::kPoint);
  IcpIteration last;
  icp.setObserver([&](const IcpIteration& i) {
    last = i;
    return true;
  });
  alignFrom(icp, kOffset);
  EXPECT_TRUE(sameBits(last.T_target_source, icp.result().T_target_source));
  EXPECT_LT((last.T_target_source.translation() - kPlace).norm(), 1);
  ASSERT_TRUE(icp.result().localizability);
  const Eigen::Vector3d centroid = icp.result().localizability->centroid;
  EXPECT_LT((centroid - kPlace).cwiseAbs().maxCoeff(), 8) << "on the corner";
}

TEST(Icp6DFar, ThePoseIsKnownAsWellAsNearTheOrigin)
{
  pcl6d::Random noise(3);
  Points scan = transformed(grid(), kFarStart.inverse());
  for (auto& p : scan)
    p[static_cast<int>(noise.uniform(0, 3))] +=
        static_cast<float>(0.01 * noise.normal());
  DoubleIcp near, far;
  setUp(near, scan, grid(), Metric::kPoint);
  setUp(far, scan, transformed(grid(), kOffset), Metric::kPoint);
  alignFrom(near);
  alignFrom(far, kOffset);
  ASSERT_TRUE(near.result().information && far.result().information);
  const pcl6d::PoseInformation& expected = *near.result().information;
  EXPECT_LT((*far.result().information - expected).norm(), 1e-6 * expected.norm());
}

TEST(Icp6DFar, ScalarFloatLosesNothingInTheResult)
{
  // The guess is of float: half a metre near the northing; so the scan lies there, too.
  const Points corner = transformed(grid(), kOffset);
  for (const Metric metric : kMetrics) {
    pcl6d::ICP6D<Point, Point> icp;
    icp.setInputSource(toCloud<Point>(corner));
    icp.setInputTarget(toCloud<Point>(corner));
    icp.setMaxCorrespondenceDistance(1);
    icp.setMetric(metric);
    alignFrom(icp);
    EXPECT_TRUE(icp.hasConverged()) << toString(metric);
    expectSameMotion(
        icp.result().T_target_source, Eigen::Isometry3d::Identity(), kPlace);
  }
}

TEST(Icp6DFar, TheCachedTreeIsCentredToo)
{
  DoubleIcp icp;
  icp.setSearchMethodTarget(pcl::make_shared<pcl6d::CachedKdTree<Point>>());
  setUp(icp,
        transformed(grid(), kFarStart.inverse()),
        transformed(grid(), kOffset),
        Metric::kPlane);
  alignFrom(icp, kOffset);
  EXPECT_LT((Eigen::Isometry3d(icp.getFinalTransformation()).translation() -
             (kOffset * kFarStart).translation())
                .norm(),
            kExactTol);
}

TEST(Icp6DFar, ReciprocalPairsAreTheSame)
{
  DoubleIcp icp;
  setUp(icp,
        transformed(grid(), kFarStart.inverse()),
        transformed(grid(), kOffset),
        Metric::kPoint);
  icp.setUseReciprocalCorrespondences(true);
  alignFrom(icp, kOffset);
  EXPECT_TRUE(icp.hasConverged());
  EXPECT_EQ(icp.result().pairs, grid().size());
  EXPECT_LT(pcl6d::distanceBetween(kOffset * kFarStart, icp.result().T_target_source)
                .translation,
            kExactTol);
}

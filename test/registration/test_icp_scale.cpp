// SPDX-License-Identifier: BSD-3-Clause
// The scale of the source: in icp(), ICP6D, and the PCL class of the minimiser.
#include "icp6d_cases.h"
#include "icp_cases.h"
#include "support/pairs.h"
#include "support/pcl_peers.h"

#include <pcl6d/registration/minimisers.h>
#include <pcl6d/registration/pcl/transformation_estimation_scale_quaternion.h>

#include <pcl/registration/transformation_estimation_svd_scale.h>

#include <cmath>

using namespace pcl6d; // NOLINT: the whole API of ICP
using pcl6d::test::corner;
using pcl6d::test::Surface;
using pcl6d::test::toCloud;
using Point = pcl::PointXYZ;
using Cloud = pcl::PointCloud<Point>;
using Icp = ICP6D<Point, Point, double>;
using Estimation = TransformationEstimationScaleQuaternion<Point, Point, double>;

namespace {
// Floats of coordinates up to 2 m are rounded to 1.2e-7 m; averaged over a thousand points
// and more, times 5.
constexpr double kScaleTol = 2e-8;
constexpr double kPoseTol = 1e-7; // [m], [rad]
const Eigen::Isometry3d kSmallTruth =
    poseFromEuler({0.02, -0.015, 0.01}, {0.005, -0.004, 0.006});

/** \return the source that a scale and a pose take to the target */
Points
sourceOf(const Points& target, double scale, const Eigen::Isometry3d& T = kSmallTruth)
{
  Points source;
  for (const auto& m : target)
    source.push_back((T.inverse() * m.cast<double>() / scale).eval().cast<float>());
  return source;
}

IcpOptions
scaled()
{
  IcpOptions options;
  options.estimate_scale = true;
  options.translation_epsilon = options.rotation_epsilon = 1e-10;
  return options;
}

IcpResult
match(const Points& target, const Points& source, const IcpOptions& options)
{
  const IcpModel model(target, {}), data(source, {});
  return icp({model.part()}, data.source(), Eigen::Isometry3d::Identity(), options);
}

void
setUpScaled(Icp& icp, const Points& target, const Points& source)
{
  icp.setInputTarget(toCloud<Point>(target));
  icp.setInputSource(toCloud<Point>(source));
  icp.setMaxCorrespondenceDistance(0.25);
  icp.setMotionEpsilon(1e-10, 1e-10);
  icp.setEstimateScale(true);
}

Points
cornerOf(std::uint64_t seed)
{
  Random random(seed);
  return corner(random, 3000, 2).points;
}
} // namespace

TEST(IcpScale, IsFoundAndAppliedExactly)
{
  const Points target = cornerOf(1);
  for (const double scale : {0.99, 1.0, 1.01}) {
    SCOPED_TRACE(scale);
    const IcpResult found = match(target, sourceOf(target, scale), scaled());
    EXPECT_EQ(found.status, Status::kOk);
    EXPECT_NEAR(found.scale, scale, kScaleTol);
    EXPECT_LT(distanceBetween(kSmallTruth, found.T_target_source).translation,
              kPoseTol);
    EXPECT_LT(distanceBetween(kSmallTruth, found.T_target_source).rotation, kPoseTol);
    EXPECT_LT(found.rms, 5e-7) << "[m] the source lies on the target";
    EXPECT_EQ(found.pairs, target.size());
  }
}

TEST(IcpScale, IsOneUnlessAskedFor)
{
  const Points target = cornerOf(2), source = sourceOf(target, 1.01);
  IcpOptions options;
  options.minimiser = minimiserFromName("scale-quaternion");
  const IcpResult found = match(target, source, options);
  EXPECT_EQ(found.scale, 1);
  EXPECT_TRUE(
      test::sameBits(found.T_target_source, match(target, source, {}).T_target_source))
      << "as by the quaternion without scale";
  EXPECT_GT(found.rms, 1e-3) << "[m] what a rigid motion leaves of 1 % of 2 m";
}

TEST(IcpScale, FollowsTheFrames)
{
  // Scale and rotation do not depend on where the target stands; the other way round the
  // scale is its inverse.
  const Points target = cornerOf(3), source = sourceOf(target, 1.008);
  const IcpResult found = match(target, source, scaled());
  const Eigen::Isometry3d T = poseFromEuler({3, -2, 1}, {0.3, 0.2, -1});
  const IcpModel model(target, {}), data(source, {});
  const IcpResult moved = icp({model.part(T)}, data.source(), T, scaled());
  // Twenty times the rounding: the coordinates are several times as large.
  EXPECT_NEAR(moved.scale, found.scale, 20 * kScaleTol);
  EXPECT_LT(
      distanceBetween(T * found.T_target_source, moved.T_target_source).translation,
      20 * kPoseTol);
  const IcpResult back = match(source, target, scaled());
  EXPECT_NEAR(back.scale * found.scale, 1, 2 * kScaleTol);
}

TEST(IcpScale, IsTheSameForEveryExactSearchAndNumberOfThreads)
{
  const Points target = cornerOf(4), source = sourceOf(target, 1.01);
  const IcpModel data(source, {});
  const auto with = [&](SearchMethod search, unsigned int threads) {
    IcpModel::Options options;
    options.search = search;
    const IcpModel model(target, options);
    IcpOptions of_icp = scaled();
    of_icp.num_threads = threads;
    return icp({model.part()}, data.source(), Eigen::Isometry3d::Identity(), of_icp);
  };
  const IcpResult expected = with(SearchMethod::kKdTree, 1);
  for (const SearchMethod search :
       {SearchMethod::kRemembered, SearchMethod::kCachedTree})
    for (const unsigned int threads : {1u, 3u}) {
      const IcpResult found = with(search, threads);
      EXPECT_EQ(found.scale, expected.scale);
      EXPECT_TRUE(test::sameBits(found.T_target_source, expected.T_target_source));
    }
}

TEST(IcpScale, OfDegenerateInputIsOne)
{
  const Points target = cornerOf(5);
  const auto expectOne = [&](const Points& source, Status status) {
    const IcpResult found = match(target, source, scaled());
    EXPECT_EQ(found.scale, 1);
    EXPECT_EQ(found.status, status);
  };
  expectOne(Points(50, target[7]), Status::kRankDeficient); // all in one place
  expectOne({target[7]}, Status::kTooFewPairs);
  expectOne({}, Status::kTooFewPairs);
  const IcpResult onto_one = match(Points(50, target[7]), target, scaled());
  EXPECT_EQ(onto_one.scale, 1);
}

TEST(IcpScale, ThatRunsAwayIsDiverged)
{
  // Near the edge of a disc of the target's plane alone, a cluster: shrinking pays.
  Random random(6);
  Points target, source;
  for (int i = 0; i < 5; ++i)
    target.push_back(test::randomCube(random, 1, 0.01)[0]);
  for (const auto& p : test::randomCube(random, 300, 0.2))
    source.push_back(p);
  IcpOptions options = scaled();
  options.max_distance = 1;
  const IcpResult found = match(target, source, options);
  EXPECT_EQ(found.status, Status::kDiverged);
  EXPECT_EQ(found.scale, 1);
  EXPECT_TRUE(test::sameBits(found.T_target_source, Eigen::Isometry3d::Identity()));
}

TEST(IcpScale, IsRefusedWhereItMeansNothing)
{
  const Points target = cornerOf(7);
  for (const Metric metric : {Metric::kPlane, Metric::kGicp}) {
    IcpOptions options = scaled();
    options.metric = metric;
    EXPECT_THROW(options.validate(), BadArgument);
  }
  for (const double most : std::vector<double>{1.0, 0.5, -1.0, test::kNan}) {
    IcpOptions options = scaled();
    options.max_scale = most;
    EXPECT_THROW(options.validate(), BadArgument);
  }
  Icp icp;
  setUpScaled(icp, target, target);
  icp.setUseReciprocalCorrespondences(true);
  EXPECT_THROW(test::alignFrom(icp), BadArgument);
}

TEST(Icp6DScale, IsInTheMatrixAndInTheOutput)
{
  const Points target = cornerOf(8);
  const double scale = 1.01;
  Icp icp;
  setUpScaled(icp, target, sourceOf(target, scale));
  Cloud aligned;
  icp.align(aligned);
  EXPECT_TRUE(icp.hasConverged());
  EXPECT_NEAR(icp.result().scale, scale, kScaleTol);
  Eigen::Matrix4d expected = kSmallTruth.matrix();
  expected.topLeftCorner<3, 3>() *= scale;
  EXPECT_LT((icp.getFinalTransformation() - expected).norm(), 5 * kPoseTol);
  for (std::size_t i = 0; i < target.size(); ++i)
    EXPECT_LT((aligned[i].getVector3fMap() - target[i]).norm(), 2e-6f);
  icp.setEstimateScale(false);
  icp.align(aligned);
  EXPECT_EQ(icp.result().scale, 1);
}

TEST(Icp6DScale, IsFoundInUtmCoordinates)
{
  // A grid of 4 m is exact in floats there, and so is one of 3.875 m about the origin.
  const Eigen::Vector3f far(409600, 819200, 0);
  Points target, source;
  for (int x = -3; x <= 3; ++x)
    for (int y = -3; y <= 3; ++y)
      for (int z = -2; z <= 2; ++z) {
        target.push_back(far + 4 * Eigen::Vector3f(x, y, z));
        source.push_back(3.875f * Eigen::Vector3f(x, y, z));
      }
  Icp icp;
  setUpScaled(icp, target, source);
  icp.setMaxCorrespondenceDistance(1.5);
  Eigen::Isometry3d guess = Eigen::Isometry3d::Identity();
  guess.translation() = far.cast<double>() + Eigen::Vector3d(0.1, -0.2, 0.1);
  test::alignFrom(icp, guess);
  EXPECT_NEAR(icp.result().scale, 4 / 3.875, 1e-12);
  EXPECT_LT((icp.result().T_target_source.translation() - far.cast<double>()).norm(),
            1e-9);
}

TEST(ScaleQuaternionEstimation, IsThatOfPclsSvdScale)
{
  const pcl::registration::TransformationEstimationSVDScale<Point, Point, double> peer;
  Random random(10);
  for (const double scale : {0.3048, 1.0, 5.0}) {
    SCOPED_TRACE(scale);
    const Points source = test::randomCube(random, 200, 3);
    const Eigen::Isometry3d T = test::randomPose(random, 2, 2);
    Points target;
    for (const auto& d : source)
      target.push_back(
          (T * (scale * d.cast<double>()) + test::normalVector(random, 0.01))
              .cast<float>());
    Eigen::Matrix4d found, expected;
    Estimation().estimateRigidTransformation(
        *toCloud<Point>(source), *toCloud<Point>(target), found);
    peer.estimateRigidTransformation(
        *toCloud<Point>(source), *toCloud<Point>(target), expected);
    // PCL sums in float: an ulp for each of the pairs at most, of numbers up to 3 scale.
    EXPECT_LT((found - expected).cwiseAbs().maxCoeff(), 3 * scale * 200 * 6e-8);
    EXPECT_NEAR(std::cbrt(found.topLeftCorner<3, 3>().determinant()), scale, 0.01);
  }
}

TEST(ScaleQuaternionEstimation, ThrowsWhenThePairsFixNoScale)
{
  const Eigen::Matrix4d before = Eigen::Matrix4d::Constant(7);
  Eigen::Matrix4d matrix = before;
  const Cloud same = *toCloud<Point>(Points(9, {1, 2, 3}));
  const Cloud spread = *toCloud<Point>(cornerOf(11)),
              one = *toCloud<Point>({{1, 0, 0}});
  const Cloud nine(Cloud(spread, pcl::Indices{0, 1, 2, 3, 4, 5, 6, 7, 8}));
  EXPECT_THROW(Estimation().estimateRigidTransformation(same, same, matrix),
               ComputeFailed);
  EXPECT_THROW(Estimation().estimateRigidTransformation(same, nine, matrix),
               ComputeFailed);
  EXPECT_THROW(Estimation().estimateRigidTransformation(nine, same, matrix),
               ComputeFailed);
  EXPECT_THROW(Estimation().estimateRigidTransformation(one, one, matrix),
               ComputeFailed);
  EXPECT_EQ(matrix, before);
}

TEST(ScaleQuaternionEstimation, TurnsMirroredPairsAndNeverMirrors)
{
  // The mirror image along z of points that spread least there: best is no turn, and a scale
  // of (a + b - c) / (a + b + c), where a, b, c are the sums of squares along the axes.
  Points source, target;
  for (const float x : {-3.0f, 3.0f})
    for (const float y : {-2.0f, 2.0f})
      for (const float z : {-1.0f, 1.0f}) {
        source.emplace_back(x, y, z);
        target.emplace_back(x, y, -z);
      }
  Eigen::Matrix4d found;
  Estimation().estimateRigidTransformation(
      *toCloud<Point>(source), *toCloud<Point>(target), found);
  Eigen::Matrix4d expected = Eigen::Matrix4d::Identity();
  expected.topLeftCorner<3, 3>() *= (9.0 + 4 - 1) / (9 + 4 + 1);
  EXPECT_LT((found - expected).norm(), 1e-12);
}

TEST(ScaleQuaternionEstimation, ScalesInsidePclsIcp)
{
  const Points target = cornerOf(12);
  pcl::IterativeClosestPoint<Point, Point, double> icp;
  icp.setTransformationEstimation(pcl::make_shared<Estimation>());
  icp.setInputTarget(toCloud<Point>(target));
  icp.setInputSource(toCloud<Point>(sourceOf(target, 1.005)));
  icp.setMaximumIterations(200);
  Cloud aligned;
  icp.align(aligned);
  const Eigen::Matrix3d linear = icp.getFinalTransformation().topLeftCorner<3, 3>();
  EXPECT_NEAR(std::cbrt(linear.determinant()), 1.005, 1e-5);
}

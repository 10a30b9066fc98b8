// SPDX-License-Identifier: BSD-3-Clause
// The rejector of pairs that one motion cannot bring together: exact truth, features, PCL's ICP.
#include "support/clouds.h"
#include "support/pcl_peers.h"
#include "support/points.h"
#include "verification/verified_rooms.h"

#include <pcl6d/global_registration/pcl/correspondence_rejector_compatibility.h>
#include <pcl6d/global_registration/pcl/feature_scale_estimation.h>

#include <pcl/features/fpfh.h>
#include <pcl/features/normal_3d.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/point_types.h>

#include <gtest/gtest.h>

using pcl6d::CorrespondenceRejectorCompatibility;
using pcl6d::distanceBetween;
using pcl6d::FeatureScale;
using pcl6d::Points;
using pcl6d::poseFromEuler;
using pcl6d::Random;
using pcl6d::test::badArgumentOf;
using pcl6d::test::randomCube;
using pcl6d::test::ScannedPair;
using pcl6d::test::toCloud;
using Vector = Eigen::Vector3d;

namespace {
using Point = pcl::PointXYZ;
using Cloud = pcl::PointCloud<Point>;
using Features = pcl::PointCloud<pcl::FPFHSignature33>;

const Eigen::Isometry3d kTruth = poseFromEuler({3, -2, 0.5}, {0.2, -0.1, 2});

/** Points, the same moved with 1 cm of noise, and pairs of which one in 20 is right. */
struct Matches {
  explicit Matches(std::uint64_t seed = 31)
  {
    Random random(seed);
    const Points from = randomCube(random, 1000, 10);
    Points to = pcl6d::transformed(from, kTruth);
    for (auto& p : to)
      p += randomCube(random, 1, 0.01)[0];
    source = toCloud<Point>(from);
    target = toCloud<Point>(to);
    for (int i = 0; i < 1000; ++i) {
      const int other = (i + 1 + static_cast<int>(random.uniform(0, 998))) % 1000;
      pairs.emplace_back(i, i % 20 == 0 ? i : other, 0.1f);
    }
  }

  CorrespondenceRejectorCompatibility
  rejector(double noise = 0.01) const
  {
    CorrespondenceRejectorCompatibility rejector;
    rejector.setInputSource<Point>(source);
    rejector.setInputTarget<Point>(target);
    rejector.setNoise(noise);
    return rejector;
  }

  Cloud::Ptr source, target;
  pcl::Correspondences pairs;
};

pcl::Correspondences
left(CorrespondenceRejectorCompatibility& rejector, const pcl::Correspondences& pairs)
{
  pcl::Correspondences remaining;
  rejector.getRemainingCorrespondences(pairs, remaining);
  return remaining;
}

/** A cloud reduced and described at a scale, by PCL's classes. */
struct Described {
  Described(const Points& scan, const FeatureScale& scale)
  {
    pcl::VoxelGrid<Point> grid;
    const auto leaf = static_cast<float>(scale.voxel);
    grid.setLeafSize(leaf, leaf, leaf);
    grid.setInputCloud(toCloud<Point>(scan));
    grid.filter(*points);
    const auto normals = pcl::make_shared<pcl::PointCloud<pcl::Normal>>();
    pcl::NormalEstimation<Point, pcl::Normal> estimation;
    estimation.setInputCloud(points);
    estimation.setRadiusSearch(scale.normal_radius);
    estimation.compute(*normals);
    pcl::FPFHEstimation<Point, pcl::Normal> fpfh;
    fpfh.setInputCloud(points);
    fpfh.setInputNormals(normals);
    fpfh.setRadiusSearch(scale.feature_radius);
    fpfh.compute(*features);
  }

  Cloud::Ptr points = pcl::make_shared<Cloud>();
  Features::Ptr features = pcl::make_shared<Features>();
};

std::size_t
rightOf(const pcl::Correspondences& pairs,
        const Described& source,
        const Described& target,
        const Eigen::Isometry3d& truth,
        double within)
{
  std::size_t right = 0;
  for (const auto& pair : pairs) {
    const Vector p = (*source.points)[pair.index_query].getVector3fMap().cast<double>();
    const Vector q = (*target.points)[pair.index_match].getVector3fMap().cast<double>();
    right += (truth * p - q).norm() < within;
  }
  return right;
}
} // namespace

TEST(CompatibilityRejector, LeavesTheOneRightPairOfTwenty)
{
  const Matches matches;
  auto rejector = matches.rejector();
  const pcl::Correspondences kept = left(rejector, matches.pairs);
  ASSERT_EQ(kept.size(), 50u);
  for (std::size_t k = 0; k < kept.size(); ++k) {
    EXPECT_EQ(kept[k].index_query, static_cast<int>(20 * k));
    EXPECT_EQ(kept[k].index_match, kept[k].index_query);
  }
  pcl::registration::TransformationEstimationSVD<Point, Point> estimation;
  Eigen::Matrix4f T;
  estimation.estimateRigidTransformation(*matches.source, *matches.target, kept, T);
  EXPECT_LT(distanceBetween(kTruth, Eigen::Isometry3d(T.cast<double>())).translation,
            0.01);
}

TEST(CompatibilityRejector, IsARejectorOfPcl)
{
  const Matches matches;
  auto ours = matches.rejector();
  pcl::registration::CorrespondenceRejector& rejector = ours;
  EXPECT_TRUE(rejector.requiresSourcePoints());
  EXPECT_TRUE(rejector.requiresTargetPoints());
  rejector.setInputCorrespondences(
      pcl::make_shared<const pcl::Correspondences>(matches.pairs));
  pcl::Correspondences kept;
  rejector.getCorrespondences(kept);
  EXPECT_EQ(kept.size(), 50u);
  left(ours, {});
  EXPECT_TRUE(left(ours, {}).empty());
}

TEST(CompatibilityRejector, FindsItsNoiseInTheClouds)
{
  // Points of a surface 0.1 m apart, those of the target between those of the source.
  Points from, to;
  for (int i = 0; i < 30; ++i)
    for (int j = 0; j < 30; ++j) {
      from.emplace_back(0.1f * i, 0.1f * j, 0.02f * static_cast<float>(i * j % 7));
      to.emplace_back(0.1f * i + 0.05f, 0.1f * j + 0.05f, from.back().z());
    }
  pcl::Correspondences pairs;
  for (int i = 0; i < 900; ++i)
    pairs.emplace_back(i, i % 10 == 0 ? i : (i * 37 + 11) % 900, 0.1f);
  CorrespondenceRejectorCompatibility rejector;
  rejector.setInputSource<Point>(toCloud<Point>(from));
  rejector.setInputTarget<Point>(toCloud<Point>(to));
  const pcl::Correspondences kept = left(rejector, pairs);
  std::size_t right = 0;
  for (const auto& pair : kept)
    right += pair.index_query == pair.index_match;
  EXPECT_GE(right, 90u);
}

TEST(CompatibilityRejector, FindsTheRightPairsOfFeatures)
{
  const ScannedPair scans;
  pcl6d::FeatureScaleEstimation<Point> estimation;
  estimation.setInputCloud(toCloud<Point>(scans.first));
  const FeatureScale scale = estimation.compute().at(0);
  const Described target(scans.first, scale), source(scans.second, scale);
  pcl::registration::CorrespondenceEstimation<pcl::FPFHSignature33,
                                              pcl::FPFHSignature33>
      matching;
  matching.setInputSource(source.features);
  matching.setInputTarget(target.features);
  pcl::Correspondences pairs;
  matching.determineReciprocalCorrespondences(pairs);
  const double within = 2 * scale.voxel;
  const std::size_t right_before =
      rightOf(pairs, source, target, scans.T_first_second, within);
  EXPECT_LT(right_before, pairs.size() / 4) << "most pairs are wrong";
  CorrespondenceRejectorCompatibility rejector;
  rejector.setInputSource<Point>(source.points);
  rejector.setInputTarget<Point>(target.points);
  const pcl::Correspondences kept = left(rejector, pairs);
  EXPECT_GT(kept.size(), 10u);
  EXPECT_GT(rightOf(kept, source, target, scans.T_first_second, 2 * within),
            9 * kept.size() / 10);
}

TEST(CompatibilityRejector, KeepsWhatMovedFromPullingInPclsIcp)
{
  // A third of the points, in one piece, moved by 0.3 m between the scans.
  Random random(32);
  const Points rest = randomCube(random, 1200, 8), moved = randomCube(random, 600, 2);
  const Eigen::Isometry3d truth = poseFromEuler({0.02, 0.03, -0.01}, {0, 0, 0.005});
  Points to = rest, from = pcl6d::transformed(rest, truth.inverse());
  for (const auto& p : moved) {
    to.push_back(p);
    from.push_back(
        (truth.inverse() * (p.cast<double>() + Vector(0.3, 0, 0))).cast<float>());
  }
  const auto error = [&](bool with) {
    pcl::IterativeClosestPoint<Point, Point> icp;
    icp.setInputSource(toCloud<Point>(from));
    icp.setInputTarget(toCloud<Point>(to));
    if (with) {
      const auto rejector = pcl::make_shared<CorrespondenceRejectorCompatibility>();
      rejector->setNoise(0.02);
      icp.addCorrespondenceRejector(rejector);
    }
    Cloud aligned;
    icp.align(aligned);
    return distanceBetween(
               truth, Eigen::Isometry3d(icp.getFinalTransformation().cast<double>()))
        .translation;
  };
  const double plain = error(false);
  EXPECT_GT(plain, 0.01);
  EXPECT_LT(error(true), 0.002);
}

TEST(CompatibilityRejector, SaysWhatIsWrong)
{
  const Matches matches;
  CorrespondenceRejectorCompatibility rejector;
  EXPECT_NE(
      badArgumentOf([&] { left(rejector, matches.pairs); }).find("no input source"),
      std::string::npos);
  rejector.setInputSource<Point>(matches.source);
  EXPECT_NE(
      badArgumentOf([&] { left(rejector, matches.pairs); }).find("no input target"),
      std::string::npos);
  rejector.setInputTarget<Point>(toCloud<Point>({{0, 0, 0}}));
  EXPECT_NE(badArgumentOf([&] { left(rejector, matches.pairs); }).find("index"),
            std::string::npos);
  EXPECT_NE(badArgumentOf([&] { rejector.setNoise(0); }), "");
  EXPECT_NE(badArgumentOf([&] { rejector.setMaximumPairs(1); }), "");
  EXPECT_NE(badArgumentOf([&] { rejector.setInputSource<Point>(nullptr); }), "");
  EXPECT_NE(badArgumentOf([&] { rejector.setTargetPoints(nullptr); }), "");
  rejector.setNoise(0.3);
  EXPECT_EQ(rejector.getNoise(), 0.3);
  rejector.setNoise(std::nullopt);
  EXPECT_FALSE(rejector.getNoise());
  rejector.setMaximumPairs(500);
  EXPECT_EQ(rejector.getMaximumPairs(), 500u);
}

// SPDX-License-Identifier: BSD-3-Clause
// The parts for PCL's users: scale from data, compatible pairs and the vertical as classes.
#include "support/points.h"
#include "support/room.h"
#include "verification/verified_rooms.h"

#include <pcl6d/global_registration/pcl/correspondence_rejector_compatibility.h>
#include <pcl6d/global_registration/pcl/feature_scale_estimation.h>
#include <pcl6d/global_registration/pcl/vertical_estimation.h>

#include <pcl/features/fpfh.h>
#include <pcl/features/normal_3d.h>
#include <pcl/filters/voxel_grid.h>
#include <pcl/point_types.h>
#include <pcl/registration/correspondence_estimation.h>
#include <pcl/registration/icp.h>
#include <pcl/registration/transformation_estimation_svd.h>

#include <gtest/gtest.h>

using pcl6d::CorrespondenceRejectorCompatibility;
using pcl6d::distanceBetween;
using pcl6d::FeatureScale;
using pcl6d::MotionSize;
using pcl6d::Points;
using pcl6d::poseFromEuler;
using pcl6d::Random;
using pcl6d::VerticalEstimate;
using pcl6d::test::badArgumentOf;
using pcl6d::test::kNan;
using pcl6d::test::PillarRoom;
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

TEST(FeatureScaleEstimation, IsTheFunctionSeenFromTheSensor)
{
  const ScannedPair scans;
  const Eigen::Vector3f origin(100, 50, 3);
  auto cloud = toCloud<Point>(scans.first);
  for (auto& p : *cloud)
    p.getVector3fMap() += origin;
  cloud->sensor_origin_.head<3>() = origin;
  pcl6d::FeatureScaleEstimation<Point> estimation;
  estimation.setMaximumScales(3);
  estimation.setInputCloud(cloud);
  const auto scales = estimation.compute();
  const auto expected = pcl6d::estimateFeatureScales(scans.first, 3);
  ASSERT_EQ(scales.size(), expected.size());
  for (std::size_t k = 0; k < scales.size(); ++k) // two digits each; floats of 100 m
    EXPECT_NEAR(scales[k].voxel / expected[k].voxel, 1, 0.02);
}

TEST(FeatureScaleEstimation, HonoursIndicesAndSaysWhatIsWrong)
{
  pcl6d::FeatureScaleEstimation<Point> estimation;
  EXPECT_NE(badArgumentOf([&] { estimation.compute(); }).find("input cloud"),
            std::string::npos);
  EXPECT_NE(badArgumentOf([&] { estimation.setMaximumScales(0); }), "");
  const ScannedPair scans;
  const auto cloud = toCloud<Point>(scans.first);
  cloud->push_back({1e6f, 0, 0});
  const auto near = pcl::make_shared<pcl::Indices>();
  for (int i = 0; i < static_cast<int>(scans.first.size()); ++i)
    near->push_back(i);
  estimation.setInputCloud(cloud);
  estimation.setIndices(near);
  EXPECT_EQ(estimation.compute().at(0).voxel,
            pcl6d::estimateFeatureScales(scans.first).at(0).voxel);
  near->push_back(1 << 20);
  EXPECT_NE(badArgumentOf([&] { estimation.compute(); }).find("index"),
            std::string::npos);
  estimation.setIndices(pcl::make_shared<pcl::Indices>());
  EXPECT_TRUE(estimation.compute().empty());
}

TEST(VerticalEstimation, OfAScanIsItsSensorsTilt)
{
  Random random(33);
  const Eigen::Isometry3d pose = poseFromEuler({0.4, -0.3, 0}, {0.3, -0.2, 1});
  pcl6d::VerticalEstimation<Point> vertical;
  vertical.setInputCloud(toCloud<Point>(PillarRoom().scan(pose, random, 0.025)));
  const VerticalEstimate found = vertical.compute();
  const Vector up = pose.linear().transpose() * Vector::UnitZ();
  EXPECT_LT(found.up.cross(up).norm(), 0.01); // 5 mm of noise on walls 5 m wide
  EXPECT_GT(found.up.dot(up), 0.9);
}

TEST(VerticalEstimation, TakesNormalsAndIndicesThatAreGiven)
{
  // Three surfaces across each other, and a heap of others that are not chosen.
  const auto cloud = pcl::make_shared<Cloud>();
  const auto normals = pcl::make_shared<pcl::PointCloud<pcl::Normal>>();
  const auto chosen = pcl::make_shared<pcl::Indices>();
  const Vector up = Vector(0.1, 0.2, 1).normalized();
  Random random(34);
  for (int i = 0; i < 900; ++i) {
    const double turn = random.uniform(0, 6.28);
    const Vector level = (std::cos(turn) * up.unitOrthogonal() +
                          std::sin(turn) * up.cross(up.unitOrthogonal()));
    const Vector n =
        i % 3 == 0 ? up
        : i % 3 == 1
            ? level
            : Vector(random.normal(), random.normal(), random.normal()).normalized();
    cloud->push_back({1, 2, 3});
    normals->push_back(pcl::Normal(static_cast<float>(n.x()),
                                   static_cast<float>(n.y()),
                                   static_cast<float>(n.z())));
    if (i % 3 < 2)
      chosen->push_back(i);
  }
  normals->at(0).normal_x = kNan;
  pcl6d::VerticalEstimation<Point> vertical;
  vertical.setInputCloud(cloud);
  vertical.setInputNormals(normals);
  vertical.setIndices(chosen);
  VerticalEstimate found = vertical.compute();
  EXPECT_LT((found.up - up).norm(), 1e-4);
  EXPECT_NEAR(found.share, 1, 1e-9);
  EXPECT_TRUE(found.is_sure);
  vertical.setExpectedUp(-Vector::UnitZ());
  EXPECT_EQ(vertical.getExpectedUp(), Vector(-Vector::UnitZ()));
  found = vertical.compute();
  EXPECT_LT((found.up + up).norm(), 1e-4);
}

TEST(VerticalEstimation, OfNothingIsWhatIsExpected)
{
  pcl6d::VerticalEstimation<Point> vertical;
  EXPECT_NE(badArgumentOf([&] { vertical.compute(); }).find("input cloud"),
            std::string::npos);
  EXPECT_NE(badArgumentOf([&] { vertical.setExpectedUp({0, 0, 2}); }), "");
  vertical.setExpectedUp(Vector::UnitY());
  for (const Points& points :
       {Points(), Points(5, {kNan, 0, 0}), Points(9, {1, 1, 1})}) {
    vertical.setInputCloud(toCloud<Point>(points));
    const VerticalEstimate found = vertical.compute();
    EXPECT_EQ(found.up, Vector(Vector::UnitY()));
    EXPECT_FALSE(found.is_sure);
  }
  vertical.setInputCloud(toCloud<Point>({{1, 2, 3}, {2, 3, 4}}));
  vertical.setInputNormals(pcl::make_shared<pcl::PointCloud<pcl::Normal>>());
  EXPECT_NE(badArgumentOf([&] { vertical.compute(); }).find("normals"),
            std::string::npos);
}

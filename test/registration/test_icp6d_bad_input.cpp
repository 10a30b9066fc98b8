// SPDX-License-Identifier: BSD-3-Clause
// Clouds and settings that ICP6D can make nothing of.
#include "icp6d_cases.h"

using namespace pcl6d::test;
using pcl6d::Metric;
using pcl6d::Points;
using pcl6d::Random;
using pcl6d::Status;

namespace {
using Point = pcl::PointXYZ;
using Cloud = pcl::PointCloud<Point>;
using DoubleIcp = pcl6d::ICP6D<Point, Point, double>;
using Gicp = pcl6d::GICP6D<Point, Point, double>;

/** Runs a cloud against itself with each metric. \return the statuses */
std::vector<Status>
statusesOf(const Points& source, const Points& target)
{
  std::vector<Status> statuses;
  for (const Metric metric : kMetrics) {
    DoubleIcp icp;
    icp.setInputSource(toCloud<Point>(source));
    icp.setInputTarget(toCloud<Point>(target));
    icp.setMaxCorrespondenceDistance(1);
    icp.setMetric(metric);
    alignFrom(icp);
    EXPECT_EQ(icp.hasConverged(), icp.result().status == Status::kOk);
    EXPECT_TRUE(icp.getFinalTransformation().allFinite()) << toString(metric);
    statuses.push_back(icp.result().status);
  }
  return statuses;
}

const std::vector<Status> kAllTooFew(3, Status::kTooFewPairs);

/** \return points uniform in a box about the origin with these sides [m] */
Points
box(const Eigen::Vector3f& sides, std::uint64_t seed = 4)
{
  Random random(seed);
  Points points = randomCube(random, 900, 1);
  for (auto& p : points)
    p = p.cwiseProduct(sides) + Eigen::Vector3f(1, 2, 3);
  return points;
}

template <typename Registration>
bool
refuses(std::function<void(Registration&)> change)
{
  Registration icp;
  setUpCorner(icp);
  change(icp);
  return !badArgumentOf([&] { alignFrom(icp); }).empty() && !icp.hasConverged();
}
} // namespace

TEST(Icp6DBadInput, WithoutCloudsNothingHappens)
{
  DoubleIcp icp;
  alignFrom(icp); // PCL prints that clouds are missing
  EXPECT_FALSE(icp.hasConverged());
  icp.setInputTarget(cornerModel<Point>());
  alignFrom(icp);
  EXPECT_FALSE(icp.hasConverged());
  EXPECT_EQ(icp.result().status, Status::kTooFewPairs);
}

TEST(Icp6DBadInput, EmptyCloudsTakeThePlaceOfOthersAndAreTooFew)
{
  const auto empty = pcl::make_shared<Cloud>();
  for (const bool source : {true, false}) {
    DoubleIcp icp;
    setUpCorner(icp);
    expectCorner(icp);
    if (source)
      icp.setInputSource(empty);
    else
      icp.setInputTarget(empty);
    alignFrom(icp, kCornerTruth);
    EXPECT_FALSE(icp.hasConverged());
    EXPECT_EQ(icp.result().status, Status::kTooFewPairs);
    EXPECT_LT(errorOf(icp).translation, 1e-12) << "the guess";
    setUpCorner(icp);
    expectCorner(icp);
  }
}

TEST(Icp6DBadInput, NullIsRefused)
{
  const auto refused = [](auto change) {
    DoubleIcp icp;
    setUpCorner(icp);
    const std::string message = badArgumentOf([&] { change(icp); });
    EXPECT_NE(message.find("is null"), std::string::npos) << message;
    expectCorner(icp); // as if nothing had been said
  };
  refused([](DoubleIcp& icp) { icp.setInputSource(nullptr); });
  refused([](DoubleIcp& icp) { icp.setInputTarget(nullptr); });
  refused([](DoubleIcp& icp) { icp.setIndices(pcl::IndicesPtr()); });
  refused([](DoubleIcp& icp) { icp.setIndices(pcl::IndicesConstPtr()); });
  refused([](DoubleIcp& icp) { icp.setIndices(pcl::PointIndicesConstPtr()); });
  refused([](DoubleIcp& icp) { icp.setSearchMethodTarget(nullptr); });
  refused([](DoubleIcp& icp) { icp.setTransformationEstimation(nullptr); });
  refused([](DoubleIcp& icp) { icp.addCorrespondenceRejector(nullptr); });
}

TEST(Icp6DBadInput, NullThatCameThroughTheBaseClassIsRefusedByAlign)
{
  DoubleIcp icp;
  setUpCorner(icp);
  DoubleIcp::Base& base = icp;
  base.setTransformationEstimation(nullptr);
  EXPECT_THROW(alignFrom(icp), pcl6d::BadArgument);
}

TEST(Icp6DBadInput, IndicesOfNoPointAreRefused)
{
  for (const int bad : {-1, 1998, 999999999}) {
    const auto indices = pcl::make_shared<pcl::Indices>(pcl::Indices{0, 1, 2, bad});
    DoubleIcp icp;
    setUpCorner(icp);
    EXPECT_THROW(icp.setIndices(indices), pcl6d::BadArgument) << bad;
    DoubleIcp other;
    other.setIndices(indices); // which points there are is known later
    other.setInputTarget(cornerModel<Point>());
    other.setInputSource(cornerData<Point>()); // nor now: they may be set anew
    EXPECT_THROW(alignFrom(other), pcl6d::BadArgument);
    pcl6d::KdTree<Point> tree;
    EXPECT_THROW(tree.setInputCloud(cornerData<Point>(), indices), pcl6d::BadArgument);
  }
}

TEST(Icp6DBadInput, ARefusedSettingLeavesNoOldResult)
{
  DoubleIcp icp;
  setUpCorner(icp);
  expectCorner(icp);
  icp.setKeptShare(-1);
  EXPECT_THROW(alignFrom(icp), pcl6d::BadArgument);
  EXPECT_FALSE(icp.hasConverged());
  EXPECT_EQ(icp.result().status, Status::kTooFewPairs);
  EXPECT_EQ(icp.result().iterations, 0);
}

TEST(Icp6DBadInput, AGuessOfNanIsTooFewPairs)
{
  for (const Metric metric : kMetrics)
    for (const float bad : {kNan, kInfinity}) {
      DoubleIcp icp;
      setUpCorner(icp);
      icp.setMetric(metric);
      Eigen::Isometry3d guess = Eigen::Isometry3d::Identity();
      guess.translation().y() = bad;
      alignFrom(icp, guess);
      EXPECT_FALSE(icp.hasConverged());
      EXPECT_EQ(icp.result().status, Status::kTooFewPairs);
      EXPECT_FALSE(icp.getFinalTransformation().allFinite()) << "the guess";
    }
}

TEST(Icp6DBadInput, AGuessThatIsNotRigidBecomesSo)
{
  DoubleIcp icp;
  setUpCorner(icp);
  Eigen::Isometry3d guess = Eigen::Isometry3d::Identity();
  guess.linear() *= 1.001;
  alignFrom(icp, guess);
  EXPECT_LT(errorOf(icp).translation, kExactTol);
  EXPECT_TRUE(pcl6d::isRigid(icp.result().T_target_source));
}

TEST(Icp6DBadInput, FewerThanThreePairsAreTooFew)
{
  const Points corner = cornerPoints();
  for (std::size_t count : {1u, 2u}) {
    const Points few(corner.begin(), corner.begin() + static_cast<long>(count));
    EXPECT_EQ(statusesOf(few, corner), kAllTooFew);
  }
  const Points two(corner.begin(), corner.begin() + 2);
  for (const Status status : statusesOf(corner, two)) // few targets, many pairs
    EXPECT_NE(status, Status::kOk);
}

TEST(Icp6DBadInput, CloudsOfNanAreTooFew)
{
  const Points corner = cornerPoints();
  for (const float bad : {kNan, kInfinity, -kInfinity}) {
    const Points none(100, {bad, 1, 1});
    EXPECT_EQ(statusesOf(none, corner), kAllTooFew);
    EXPECT_EQ(statusesOf(corner, none), kAllTooFew);
    EXPECT_EQ(statusesOf(none, none), kAllTooFew);
  }
}

TEST(Icp6DBadInput, OpenMotionsAreSaid)
{
  for (const Status status : statusesOf(box({4, 4, 0}), box({4, 4, 0}, 5)))
    EXPECT_NE(status, Status::kOk) << "plane";
  const std::vector<Status> copies = statusesOf(box({4, 4, 0}), box({4, 4, 0}));
  EXPECT_EQ(copies[0], Status::kOk) << "points that lie on each other hold";
  EXPECT_EQ(copies[1], Status::kRankDeficient);
  EXPECT_EQ(copies[2], Status::kRankDeficient);
  for (const Status status : statusesOf(box({4, 0, 0}), box({4, 0, 0})))
    EXPECT_NE(status, Status::kOk) << "line";
  for (const Status status : statusesOf(box({0, 0, 0}), box({0, 0, 0})))
    EXPECT_NE(status, Status::kOk) << "duplicates of a point";
}

namespace {
/** Floor, ceiling and two walls without an end. */
Points
openCorridor(std::uint64_t seed)
{
  Random random(seed);
  Points corridor;
  for (int i = 0; i < 4000; ++i) {
    const auto along = static_cast<float>(random.uniform(-10, 10));
    const auto across = static_cast<float>(random.uniform(-1, 1));
    const float side = i % 2 ? 1.0f : -1.0f;
    corridor.push_back(i % 4 < 2 ? Eigen::Vector3f(along, across, side)
                                 : Eigen::Vector3f(along, side, across));
  }
  return corridor;
}
} // namespace

TEST(Icp6DBadInput, ACorridorIsOpenAlongItself)
{
  for (const Metric metric : kMetrics) {
    DoubleIcp icp;
    icp.setInputSource(toCloud<Point>(openCorridor(10)));
    icp.setInputTarget(toCloud<Point>(openCorridor(9)));
    icp.setMaxCorrespondenceDistance(1);
    icp.setMaximumIterations(300);
    icp.setMetric(metric);
    alignFrom(icp);
    EXPECT_EQ(icp.result().status, Status::kRankDeficient) << toString(metric);
    ASSERT_TRUE(icp.result().localizability);
    EXPECT_EQ(icp.result().localizability->openDirections(), 1) << toString(metric);
    EXPECT_NEAR(std::abs(icp.result().localizability->directions(0, 0)), 1, 0.01)
        << "along x";
    EXPECT_FALSE(icp.result().covariance);
  }
}

TEST(Icp6DBadInput, SettingsThatBreakTheirRuleAreRefused)
{
  EXPECT_TRUE(
      refuses<DoubleIcp>([](DoubleIcp& i) { i.setMaxCorrespondenceDistance(kNan); }));
  for (const double share : {0.0, -0.1, 1.1, static_cast<double>(kNan)})
    EXPECT_TRUE(refuses<DoubleIcp>([&](DoubleIcp& i) { i.setKeptShare(share); }))
        << share;
  EXPECT_TRUE(refuses<DoubleIcp>(
      [](DoubleIcp& i) { i.setMaxCorrespondenceDistanceStart(-1); }));
  EXPECT_TRUE(refuses<DoubleIcp>([](DoubleIcp& i) { i.setMotionEpsilon(-1, 1e-5); }));
  EXPECT_TRUE(refuses<DoubleIcp>([](DoubleIcp& i) { i.setMotionEpsilon(1e-4, kNan); }));
}

TEST(Icp6DBadInput, NeighboursOfANormalAreLimited)
{
  for (const Metric metric : {Metric::kPlane, Metric::kGicp})
    for (const std::size_t neighbours : {0u, 2u, 65u})
      EXPECT_TRUE(refuses<DoubleIcp>([&](DoubleIcp& i) {
        i.setMetric(metric);
        i.setNormalNeighbours(neighbours);
      })) << neighbours;
  for (const int neighbours : {-5, 0, 2, 3, 64, 65}) // the nearest that is allowed
    EXPECT_FALSE(
        refuses<Gicp>([&](Gicp& i) { i.setCorrespondenceRandomness(neighbours); }));
}

TEST(Icp6DBadInput, ARefusedRunLeavesTheNextOneAsItIs)
{
  DoubleIcp icp;
  setUpCorner(icp);
  icp.setKeptShare(2);
  EXPECT_THROW(alignFrom(icp), pcl6d::BadArgument);
  icp.setKeptShare(1);
  expectCorner(icp);
}

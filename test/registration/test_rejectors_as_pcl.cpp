// SPDX-License-Identifier: BSD-3-Clause
// Rejectors of correspondences: PCL's classes and ours on the same pairs.
#include "as_pcl_cases.h"

#include <pcl/registration/correspondence_rejection_distance.h>

#include <cmath>
#include <numeric>

using namespace pcl6d::test;
using pcl6d::Points;
using pcl6d::Random;

namespace {
using OrientedPoint = pcl::PointNormal;
using OrientedCloud = pcl::PointCloud<OrientedPoint>;

/** \return pairs with random targets and distances, some of which are equal */
pcl::Correspondences
randomPairs(std::size_t count = 300)
{
  Random random(5);
  pcl::Correspondences pairs;
  for (std::size_t i = 0; i < count; ++i)
    pairs.emplace_back(static_cast<int>(i),
                       static_cast<int>(random.uniform(0, 80)),
                       static_cast<float>(std::floor(random.uniform(0, 40))) / 16);
  return pairs;
}

template <typename Rejector>
pcl::Correspondences
left(Rejector& rejector, const pcl::Correspondences& pairs)
{
  pcl::Correspondences remaining;
  rejector.getRemainingCorrespondences(pairs, remaining);
  return remaining;
}

double
sumOf(const pcl::Correspondences& pairs)
{
  double sum = 0;
  for (const auto& pair : pairs)
    sum += static_cast<double>(pair.distance);
  return sum;
}

bool
isInOrder(const pcl::Correspondences& pairs)
{
  return std::is_sorted(pairs.begin(), pairs.end(), [](const auto& a, const auto& b) {
    return a.index_query < b.index_query;
  });
}
} // namespace

template <typename Side>
class RejectorsAsPcl : public testing::Test {};
TYPED_TEST_SUITE(RejectorsAsPcl, BothSides, NameOfSide);

TYPED_TEST(RejectorsAsPcl, OneToOneLeavesEachTargetItsClosest)
{
  typename TypeParam::OneToOne rejector;
  const auto pairs = randomPairs();
  const auto kept = left(rejector, pairs);
  std::vector<float> closest(80, kInfinity);
  for (const auto& pair : pairs) {
    float& best = closest[static_cast<std::size_t>(pair.index_match)];
    best = std::min(best, pair.distance);
  }
  std::vector<int> seen(80, 0);
  for (const auto& pair : kept) {
    ++seen[static_cast<std::size_t>(pair.index_match)];
    EXPECT_EQ(pair.distance, closest[static_cast<std::size_t>(pair.index_match)]);
  }
  for (std::size_t i = 0; i < seen.size(); ++i)
    EXPECT_EQ(seen[i], std::isinf(closest[i]) ? 0 : 1) << i;
}

TYPED_TEST(RejectorsAsPcl, TrimmedLeavesTheShareThatIsClosest)
{
  const auto pairs = randomPairs();
  std::vector<double> sorted;
  for (const auto& pair : pairs)
    sorted.push_back(static_cast<double>(pair.distance));
  std::sort(sorted.begin(), sorted.end());
  typename TypeParam::Trimmed rejector;
  EXPECT_EQ(rejector.getOverlapRatio(), 0.5f);
  EXPECT_EQ(rejector.getMinCorrespondences(), 0u);
  for (const float ratio : {0.0f, 0.07f, 0.5f, 0.7f, 0.999f, 1.0f, 7.0f, -1.0f}) {
    rejector.setOverlapRatio(ratio);
    const auto kept = left(rejector, pairs);
    const float share = std::min(1.0f, std::max(0.0f, ratio));
    EXPECT_EQ(rejector.getOverlapRatio(), share);
    EXPECT_EQ(kept.size(), static_cast<std::size_t>(share * 300)) << ratio;
    EXPECT_DOUBLE_EQ(
        sumOf(kept),
        std::accumulate(sorted.begin(),
                        sorted.begin() + static_cast<std::ptrdiff_t>(kept.size()),
                        0.0));
  }
  rejector.setOverlapRatio(0.1f);
  rejector.setMinCorrespondences(200);
  EXPECT_EQ(left(rejector, pairs).size(), 200u);
  rejector.setMinCorrespondences(1000);
  EXPECT_EQ(left(rejector, pairs).size(), 300u);
}

TYPED_TEST(RejectorsAsPcl, SurfaceNormalLeavesWhatFacesTheSameWay)
{
  Random random(3);
  const auto source = pcl::make_shared<OrientedCloud>(),
             target = pcl::make_shared<OrientedCloud>();
  pcl::Correspondences pairs;
  for (int i = 0; i < 200; ++i) {
    OrientedPoint p;
    p.getNormalVector3fMap() =
        Eigen::Vector3d(random.normal(), random.normal(), random.normal())
            .normalized()
            .template cast<float>();
    source->push_back(p);
    p.getNormalVector3fMap() = Eigen::Vector3f::UnitZ();
    target->push_back(p);
    pairs.emplace_back(i, i, 0.f);
  }
  typename TypeParam::SurfaceNormal rejector;
  EXPECT_EQ(rejector.getThreshold(), 1.0);
  rejector.template initializeDataContainer<OrientedPoint, OrientedPoint>();
  rejector.template setInputSource<OrientedPoint>(source);
  rejector.template setInputTarget<OrientedPoint>(target);
  rejector.template setInputNormals<OrientedPoint, OrientedPoint>(source);
  rejector.template setTargetNormals<OrientedPoint, OrientedPoint>(target);
  for (const double threshold : {-0.5, 0.0, 0.8}) {
    rejector.setThreshold(threshold);
    std::vector<int> expected;
    for (int i = 0; i < 200; ++i)
      if (static_cast<double>((*source)[static_cast<std::size_t>(i)].normal_z) >
          threshold)
        expected.push_back(i);
    EXPECT_EQ(queriesOf(left(rejector, pairs)), expected);
  }
}

TYPED_TEST(RejectorsAsPcl, VarTrimmedFindsTheShareOfTheInliers)
{
  // 60 % lie within 1 to 2 cm, the others 1 m off or more.
  Random random(8);
  pcl::Correspondences pairs;
  for (int i = 0; i < 500; ++i) {
    const double d = i % 5 < 3 ? random.uniform(0.01, 0.02) : random.uniform(1, 3);
    pairs.emplace_back(i, i, static_cast<float>(d * d));
  }
  typename TypeParam::VarTrimmed rejector;
  EXPECT_EQ(rejector.getMinRatio(), 0.05);
  EXPECT_EQ(rejector.getMaxRatio(), 0.95);
  const auto kept = left(rejector, pairs);
  EXPECT_NEAR(rejector.getTrimFactor(), 0.6, 0.01);
  EXPECT_NEAR(static_cast<double>(kept.size()), 300, 4);
  double farthest = 0;
  for (const auto& pair : kept)
    farthest = std::max(farthest, static_cast<double>(pair.distance));
  if (TypeParam::kIsOurs) {
    EXPECT_LE(farthest, 0.02 * 0.02);
    // Of 300 distances the last one is a few gaps of 0.01 m / 300 below the largest.
    EXPECT_NEAR(rejector.getTrimmedDistance(), 0.02 * 0.02, 1e-5);
  }
  else
    EXPECT_GT(farthest, 1) << "PCL looks up distances that it has sorted meanwhile";
}

TYPED_TEST(RejectorsAsPcl, WorkInPclsIcp)
{
  using Base = pcl::registration::CorrespondenceRejector;
  const auto trimmed = pcl::make_shared<typename TypeParam::Trimmed>();
  trimmed->setOverlapRatio(0.85f);
  const auto normals = pcl::make_shared<typename TypeParam::SurfaceNormal>();
  normals->setThreshold(0.9);
  const auto one = pcl::make_shared<typename TypeParam::OneToOne>();
  for (const Base::Ptr& rejector :
       {Base::Ptr(trimmed), Base::Ptr(normals), Base::Ptr(one)}) {
    pcl::IterativeClosestPoint<OrientedPoint, OrientedPoint> icp;
    icp.setInputSource(outlierData<OrientedPoint>());
    icp.setInputTarget(cornerModel<OrientedPoint>());
    icp.setMaxCorrespondenceDistance(0.5);
    alignFrom(icp);
    const double all = errorOf(icp).translation;
    icp.addCorrespondenceRejector(rejector);
    alignFrom(icp);
    EXPECT_LT(errorOf(icp).translation, 0.6 * all) << rejector->getClassName();
  }
}

TEST(OurRejectors, BreakTiesByIndexAndKeepTheOrder)
{
  const pcl::Correspondences pairs = {
      {0, 4, 1.f}, {1, 4, 0.5f}, {2, 4, 0.5f}, {3, 2, 0.5f}, {4, 1, 0.5f}, {5, 1, 2.f}};
  auto shuffled = pairs;
  std::reverse(shuffled.begin(), shuffled.end());
  pcl6d::CorrespondenceRejectorOneToOne one;
  EXPECT_EQ(queriesOf(left(one, pairs)), (std::vector<int>{1, 3, 4}));
  EXPECT_EQ(queriesOf(left(one, shuffled)), (std::vector<int>{1, 3, 4}));
  pcl6d::CorrespondenceRejectorTrimmed trimmed;
  EXPECT_EQ(queriesOf(left(trimmed, pairs)), (std::vector<int>{1, 2, 3}));
  EXPECT_EQ(queriesOf(left(trimmed, shuffled)), (std::vector<int>{1, 2, 3}));
  EXPECT_TRUE(isInOrder(left(one, randomPairs())));
  EXPECT_TRUE(isInOrder(left(trimmed, randomPairs())));
}

TEST(OurRejectors, LeaveOutPairsWithoutPartnerOrDistance)
{
  const pcl::Correspondences pairs = {
      {0, -1, 0.1f}, {1, 3, kNan}, {-2, 3, 0.1f}, {3, 3, 0.5f}};
  pcl6d::CorrespondenceRejectorOneToOne one;
  pcl6d::CorrespondenceRejectorTrimmed trimmed;
  trimmed.setOverlapRatio(1);
  pcl6d::CorrespondenceRejectorVarTrimmed share;
  for (pcl::registration::CorrespondenceRejector* rejector :
       {static_cast<pcl::registration::CorrespondenceRejector*>(&one),
        static_cast<pcl::registration::CorrespondenceRejector*>(&trimmed),
        static_cast<pcl::registration::CorrespondenceRejector*>(&share)}) {
    pcl::Correspondences same = pairs; // in and out may be one vector
    rejector->getRemainingCorrespondences(same, same);
    EXPECT_EQ(queriesOf(same), std::vector<int>{3}) << rejector->getClassName();
    rejector->getRemainingCorrespondences({}, same);
    EXPECT_TRUE(same.empty());
  }
}

TEST(OurRejectors, DoNotLeaveAnOldResultForNoPairs)
{
  pcl6d::CorrespondenceRejectorTrimmed ours;
  pcl::registration::CorrespondenceRejectorTrimmed pcls;
  const auto none = pcl::make_shared<pcl::Correspondences>();
  pcl::Correspondences kept(5);
  pcls.setInputCorrespondences(none);
  pcls.getCorrespondences(kept);
  EXPECT_EQ(kept.size(), 5u) << "PCL's leaves what was there";
  ours.setInputCorrespondences(none);
  ours.getCorrespondences(kept);
  EXPECT_TRUE(kept.empty());
}

TEST(OurRejectors, VarTrimmedTakesAllExactCopies)
{
  pcl::Correspondences pairs;
  for (int i = 0; i < 100; ++i)
    pairs.emplace_back(i, i, i < 70 ? 0.f : 1.f);
  pcl6d::CorrespondenceRejectorVarTrimmed rejector;
  EXPECT_EQ(left(rejector, pairs).size(), 70u);
  rejector.setMaxRatio(0.5);
  EXPECT_EQ(left(rejector, pairs).size(), 50u);
  rejector.setMinRatio(0.9);
  EXPECT_NE(badArgumentOf([&] { left(rejector, pairs); }).find("min_ratio"),
            std::string::npos);
  rejector.setMaxRatio(1);
  EXPECT_GE(left(rejector, pairs).size(), 90u);
}

TEST(OurRejectors, VarTrimmedMeasuresTheCloudsThatAreGiven)
{
  pcl::Correspondences pairs;
  Points source, target;
  for (int i = 0; i < 10; ++i) {
    pairs.emplace_back(i, i, 1.f); // as if all were equally far
    source.emplace_back(i, 0, 0);
    target.emplace_back(i, i < 6 ? 0.01f : 2.f, 0);
  }
  pcl6d::CorrespondenceRejectorVarTrimmed rejector;
  rejector.setInputSource<OrientedPoint>(toCloud<OrientedPoint>(source));
  rejector.setInputTarget<OrientedPoint>(toCloud<OrientedPoint>(target));
  EXPECT_EQ(left(rejector, pairs).size(), 6u);
  pairs.emplace_back(99, 0, 1.f);
  EXPECT_NE(badArgumentOf([&] { left(rejector, pairs); }).find("index"),
            std::string::npos);
}

TEST(OurRejectors, SurfaceNormalTakesDirectionsAndSaysWhatIsMissing)
{
  auto cloud = pcl::make_shared<OrientedCloud>(4, 1);
  (*cloud)[0].getNormalVector3fMap() = Eigen::Vector3f(0, 0, 20);
  (*cloud)[1].getNormalVector3fMap() = Eigen::Vector3f(0, 0, 0.1f);
  (*cloud)[2].getNormalVector3fMap().setZero();
  (*cloud)[3].getNormalVector3fMap().setConstant(kNan);
  pcl::Correspondences pairs = {{0, 1, 0.f}, {1, 1, 0.f}, {2, 1, 0.f}, {3, 1, 0.f}};
  pcl6d::CorrespondenceRejectorSurfaceNormal rejector;
  rejector.setThreshold(0.9);
  EXPECT_NE(badArgumentOf([&] { left(rejector, pairs); }).find("source"),
            std::string::npos);
  rejector.setInputNormals<OrientedPoint, OrientedPoint>(cloud);
  EXPECT_NE(badArgumentOf([&] { left(rejector, pairs); }).find("target"),
            std::string::npos);
  rejector.setTargetNormals<OrientedPoint, OrientedPoint>(cloud);
  EXPECT_EQ(queriesOf(left(rejector, pairs)), (std::vector<int>{0, 1}));
  pairs.emplace_back(0, 4, 0.f);
  EXPECT_NE(badArgumentOf([&] { left(rejector, pairs); }).find("index"),
            std::string::npos);
  EXPECT_FALSE(badArgumentOf([&] { rejector.getInputNormals<pcl::Normal>(); }).empty());
  rejector.setInputSource<OrientedPoint>(cloud); // PCL's getters do not compile
  EXPECT_EQ(rejector.getInputSource<OrientedPoint>(), cloud);
  EXPECT_EQ(rejector.getInputNormals<OrientedPoint>(), cloud);
  EXPECT_EQ(rejector.getInputTarget<OrientedPoint>(), nullptr);
  EXPECT_FALSE(badArgumentOf([&] { rejector.setThreshold(kNan); }).empty());
  EXPECT_FALSE(badArgumentOf([&] { rejector.setSourceNormals(nullptr); }).empty());
  const auto blob = pcl::make_shared<pcl::PCLPointCloud2>();
  pcl::toPCLPointCloud2(pcl::PointCloud<pcl::PointXYZ>(3, 1), *blob);
  EXPECT_NE(badArgumentOf([&] { rejector.setSourceNormals(blob); }).find("normal_x"),
            std::string::npos);
}

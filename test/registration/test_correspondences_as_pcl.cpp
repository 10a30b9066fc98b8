// SPDX-License-Identifier: BSD-3-Clause
// Correspondence estimation: PCL's class and ours against an exhaustive search.
#include "as_pcl_cases.h"

#include <pcl/point_representation.h>
#include <pcl/registration/correspondence_estimation_normal_shooting.h>

#include <cmath>
#include <numeric>

using namespace pcl6d::test;
using pcl6d::BadArgument;
using pcl6d::Points;
using pcl6d::Random;

namespace {
using Point = pcl::PointXYZ;
using Cloud = pcl::PointCloud<Point>;
using OurEstimation = pcl6d::CorrespondenceEstimation<Point, Point>;

Cloud::Ptr
cube(std::uint64_t seed, std::size_t count = 400)
{
  Random random(seed);
  return toCloud<Point>(randomCube(random, count, 2));
}

pcl::IndicesPtr
everyThird(std::size_t size, std::size_t from)
{
  const auto indices = pcl::make_shared<pcl::Indices>();
  for (std::size_t i = from; i < size; i += 3)
    indices->push_back(static_cast<int>(i));
  return indices;
}

/** \return the chosen point nearest to another, and its squared distance */
pcl6d::Neighbour
nearestTo(const Point& p, const Cloud& cloud, const pcl::Indices& chosen)
{
  pcl6d::Neighbour best{-1, kInfinity};
  for (const int i : chosen) {
    const float d = pcl6d::distanceSq(
        p.getVector3fMap(), cloud[static_cast<std::size_t>(i)].getVector3fMap());
    if (d < best.distance_sq)
      best = {i, d};
  }
  return best;
}

void
expectPairs(const pcl::Correspondences& pairs, const pcl::Correspondences& expected)
{
  ASSERT_EQ(pairs.size(), expected.size());
  for (std::size_t i = 0; i < pairs.size(); ++i) {
    EXPECT_EQ(pairs[i].index_query, expected[i].index_query) << i;
    EXPECT_EQ(pairs[i].index_match, expected[i].index_match) << i;
    EXPECT_FLOAT_EQ(pairs[i].distance, expected[i].distance) << i;
  }
}
} // namespace

template <typename Side>
class CorrespondencesAsPcl : public testing::Test {
protected:
  void
  SetUp() override
  {
    estimation_.setInputSource(source_);
    estimation_.setInputTarget(target_);
    estimation_.setIndicesSource(chosen_);
    estimation_.setIndicesTarget(searched_);
  }

  /** What an exhaustive search finds. */
  pcl::Correspondences
  expected(double limit, bool reciprocal) const
  {
    pcl::Correspondences pairs;
    for (const int s : *chosen_) {
      const auto found =
          nearestTo((*source_)[static_cast<std::size_t>(s)], *target_, *searched_);
      if (found.distance_sq > limit * limit)
        continue;
      const Point& partner = (*target_)[static_cast<std::size_t>(found.index)];
      if (!reciprocal || nearestTo(partner, *source_, *chosen_).index == s)
        pairs.emplace_back(s, found.index, found.distance_sq);
    }
    return pairs;
  }

  Cloud::Ptr source_ = cube(1), target_ = cube(2, 500);
  pcl::IndicesPtr chosen_ = everyThird(400, 1), searched_ = everyThird(500, 2);
  typename Side::template Correspondences<Point> estimation_;
};

TYPED_TEST_SUITE(CorrespondencesAsPcl, BothSides, NameOfSide);

TYPED_TEST(CorrespondencesAsPcl, AreTheClosestPoints)
{
  for (const double limit : {10.0, 0.12}) {
    pcl::Correspondences pairs;
    this->estimation_.determineCorrespondences(pairs, limit);
    const auto expected = this->expected(limit, false);
    EXPECT_EQ(expected.size() == this->chosen_->size(), limit > 1);
    expectPairs(pairs, expected);
  }
}

TYPED_TEST(CorrespondencesAsPcl, AreEachOthersClosestIfReciprocal)
{
  for (const double limit : {10.0, 0.12}) {
    pcl::Correspondences pairs;
    this->estimation_.determineReciprocalCorrespondences(pairs, limit);
    const auto expected = this->expected(limit, true);
    EXPECT_LT(expected.size(), this->expected(limit, false).size());
    EXPECT_GT(expected.size(), 5u);
    expectPairs(pairs, expected);
  }
}

TYPED_TEST(CorrespondencesAsPcl, CountAPairAtExactlyTheLimit)
{
  for (const double distance : {0.5, 0.0}) {
    typename TypeParam::template Correspondences<Point> estimation;
    estimation.setInputSource(toCloud<Point>({{1, 1, 1}}));
    estimation.setInputTarget(
        toCloud<Point>({{1, static_cast<float>(1 + distance), 1}}));
    pcl::Correspondences pairs;
    estimation.determineCorrespondences(pairs, distance);
    EXPECT_EQ(pairs.size(), 1u);
    if (distance > 0) {
      estimation.determineCorrespondences(pairs, std::nextafter(distance, 0));
      EXPECT_EQ(pairs.size(), 0u);
    }
  }
}

TYPED_TEST(CorrespondencesAsPcl, SearchTheTreeThatIsGivenAndKeepIt)
{
  const auto tree =
      pcl::make_shared<CountingTree<typename TypeParam::template Tree<Point>>>();
  tree->setInputCloud(this->target_, this->searched_);
  this->estimation_.setSearchMethodTarget(tree, true);
  pcl::Correspondences pairs;
  this->estimation_.determineCorrespondences(pairs, 10);
  this->estimation_.determineCorrespondences(pairs, 10);
  EXPECT_EQ(tree->built, 1);
  EXPECT_EQ(this->estimation_.getSearchMethodTarget(), tree);
  expectPairs(pairs, this->expected(10, false));
}

TYPED_TEST(CorrespondencesAsPcl, WorkInPclsIcp)
{
  using Estimation = typename TypeParam::template Correspondences<Point>;
  pcl::IterativeClosestPoint<Point, Point> icp;
  icp.setCorrespondenceEstimation(pcl::make_shared<Estimation>());
  icp.setInputSource(cornerData<Point>());
  icp.setInputTarget(cornerModel<Point>());
  icp.setMaxCorrespondenceDistance(0.5);
  for (const bool reciprocal : {false, true}) {
    icp.setUseReciprocalCorrespondences(reciprocal);
    alignFrom(icp);
    EXPECT_TRUE(icp.hasConverged());
    EXPECT_LT(errorOf(icp).translation, 1e-5);
  }
}

// What follows holds for ours alone; PCL's answer stands beside it where it has one.

TEST(OurCorrespondences, NoticeOtherIndicesOfTheSource)
{
  const auto run = [](auto&& estimation) {
    estimation.setInputSource(cube(1));
    estimation.setInputTarget(cube(2));
    estimation.setIndicesSource(everyThird(400, 0));
    pcl::Correspondences pairs;
    estimation.determineReciprocalCorrespondences(pairs);
    estimation.setIndicesSource(everyThird(400, 1));
    estimation.determineReciprocalCorrespondences(pairs);
    return pairs.size();
  };
  EXPECT_EQ(run(pcl::registration::CorrespondenceEstimation<Point, Point>()), 0u)
      << "PCL searches the source points of the first indices for ever";
  EXPECT_GT(run(OurEstimation()), 20u);
}

TEST(OurCorrespondences, LeaveOutWhatIsNotFinite)
{
  for (const bool flann : {false, true}) {
    const auto source = cube(1), target = cube(2);
    (*source)[3].x = kNan;
    (*source)[9].z = kInfinity;
    (*target)[5].y = kNan;
    target->is_dense = source->is_dense = false;
    OurEstimation estimation;
    if (flann)
      estimation.setSearchMethodTarget(pcl::make_shared<pcl::search::KdTree<Point>>());
    estimation.setInputSource(source);
    estimation.setInputTarget(target);
    pcl::Correspondences pairs;
    for (const bool reciprocal : {false, true}) {
      if (reciprocal)
        estimation.determineReciprocalCorrespondences(pairs);
      else
        estimation.determineCorrespondences(pairs);
      for (const auto& pair : pairs) {
        EXPECT_NE(pair.index_query, 3);
        EXPECT_NE(pair.index_query, 9);
        EXPECT_NE(pair.index_match, 5);
      }
      if (!reciprocal) {
        EXPECT_EQ(pairs.size(), 398u);
      }
    }
  }
}

TEST(OurCorrespondences, FindNothingInCloudsWithoutPoints)
{
  const auto nothing = pcl::make_shared<Cloud>();
  const auto nan = toCloud<Point>({{kNan, 0, 0}, {0, kInfinity, 0}});
  const auto some = cube(1);
  for (const bool flann : {false, true})
    for (const auto& source : {nothing, nan, some})
      for (const auto& target : {nothing, nan, some}) {
        if (source == some && target == some)
          continue;
        OurEstimation estimation;
        if (flann) {
          const auto tree = pcl::make_shared<pcl::search::KdTree<Point>>();
          estimation.setSearchMethodTarget(tree);
        }
        estimation.setInputSource(source);
        estimation.setInputTarget(target);
        pcl::Correspondences pairs(7);
        estimation.determineCorrespondences(pairs);
        EXPECT_TRUE(pairs.empty());
        estimation.determineReciprocalCorrespondences(pairs);
        EXPECT_TRUE(pairs.empty());
      }
}

TEST(OurCorrespondences, AreTheSameForAnyNumberOfThreads)
{
  pcl::Correspondences first;
  for (const unsigned int threads : {1u, 2u, 5u, 0u}) {
    OurEstimation estimation;
    estimation.setNumberOfThreads(threads);
    estimation.setInputSource(cube(1, 5000));
    estimation.setInputTarget(cube(2, 6000));
    pcl::Correspondences pairs;
    estimation.determineReciprocalCorrespondences(pairs, 0.3);
    if (first.empty())
      first = pairs;
    expectPairs(pairs, first);
  }
  EXPECT_GT(first.size(), 1000u);
}

TEST(OurCorrespondences, OfACloneDoNotDisturbTheOriginal)
{
  const auto run = [](auto&& original) {
    original.setInputSource(cube(1));
    original.setInputTarget(cube(2));
    pcl::Correspondences before, after, of_copy;
    original.determineCorrespondences(before);
    const auto copy = original.clone();
    copy->setInputTarget(cube(3, 50));
    copy->determineCorrespondences(of_copy);
    original.determineCorrespondences(after);
    std::size_t same = 0;
    for (std::size_t i = 0; i < before.size() && i < after.size(); ++i)
      same += before[i].index_match == after[i].index_match ? 1 : 0;
    return same;
  };
  EXPECT_LT(run(pcl::registration::CorrespondenceEstimation<Point, Point>()), 300u)
      << "PCL's copies share their tree";
  EXPECT_EQ(run(OurEstimation()), 400u);
}

namespace {
/** Counts heights alone. */
struct Heights : pcl::PointRepresentation<Point> {
  Heights() { nr_dimensions_ = 1; }
  void
  copyToFloatArray(const Point& p, float* out) const override
  {
    out[0] = p.z;
  }
};
} // namespace

TEST(OurCorrespondences, AreThoseOfThePointRepresentation)
{
  OurEstimation estimation;
  estimation.setInputSource(toCloud<Point>({{0, 0, 1.1f}}));
  estimation.setInputTarget(toCloud<Point>({{0, 0, 0.8f}, {9, 9, 1}}));
  pcl::Correspondences pairs;
  estimation.determineCorrespondences(pairs);
  ASSERT_EQ(pairs.size(), 1u);
  EXPECT_EQ(pairs[0].index_match, 0);
  estimation.setPointRepresentation(pcl::make_shared<Heights>()); // after the target
  for (const bool reciprocal : {false, true}) {
    if (reciprocal)
      estimation.determineReciprocalCorrespondences(pairs);
    else
      estimation.determineCorrespondences(pairs);
    ASSERT_EQ(pairs.size(), 1u);
    EXPECT_EQ(pairs[0].index_match, 1);
    EXPECT_NEAR(pairs[0].distance, 0.01, 1e-6);
  }
}

TEST(OurCorrespondences, KeepTheirDigitsInUtmCoordinates)
{
  // Points 0.5 m apart, which is how fine float is at 5 000 km.
  const Eigen::Vector3f far(512000, 5400064, 320);
  Points target, source;
  for (int i = 0; i < 60; ++i)
    target.emplace_back(far + Eigen::Vector3f(static_cast<float>(i % 10),
                                              static_cast<float>(i / 10),
                                              0));
  for (const auto& p : target)
    source.emplace_back(p + Eigen::Vector3f(0.25f, 0, 0));
  OurEstimation estimation;
  estimation.setInputSource(toCloud<Point>(source));
  estimation.setInputTarget(toCloud<Point>(target));
  pcl::Correspondences pairs;
  estimation.determineReciprocalCorrespondences(pairs, 0.3);
  ASSERT_EQ(pairs.size(), 60u);
  for (const auto& pair : pairs) {
    EXPECT_EQ(pair.index_query, pair.index_match);
    EXPECT_EQ(pair.distance, 0.0625f);
  }
}

TEST(OurCorrespondences, SayWhatIsWrong)
{
  OurEstimation estimation;
  pcl::Correspondences pairs(3);
  const auto words = [&](auto call) { return badArgumentOf(call); };
  const auto determine = [&] { estimation.determineCorrespondences(pairs, 1); };
  EXPECT_NE(words(determine).find("no input source"), std::string::npos);
  estimation.setInputSource(cube(1));
  EXPECT_NE(words(determine).find("no input target"), std::string::npos);
  EXPECT_NE(words([&] { estimation.setInputSource(nullptr); }).find("null"),
            std::string::npos);
  EXPECT_NE(words([&] { estimation.setInputTarget(nullptr); }).find("null"),
            std::string::npos);
  estimation.setInputTarget(cube(2));
  for (const double distance : {-1.0, static_cast<double>(kNan)})
    EXPECT_NE(words([&] {
                estimation.determineCorrespondences(pairs, distance);
              }).find("max_distance"),
              std::string::npos);
  for (const int index : {-1, 400}) {
    const auto indices = pcl::make_shared<pcl::Indices>(1, index);
    estimation.setIndicesSource(indices);
    EXPECT_NE(words(determine).find("index"), std::string::npos);
    estimation.setIndicesSource(pcl::make_shared<pcl::Indices>(1, 0));
    estimation.setIndicesTarget(indices);
    EXPECT_NE(words(determine).find("index"), std::string::npos);
    estimation.setIndicesTarget(nullptr);
  }
  const auto other = pcl::make_shared<pcl6d::KdTree<Point>>();
  other->setInputCloud(cube(3));
  estimation.setSearchMethodTarget(other, true);
  EXPECT_NE(words(determine).find("another cloud"), std::string::npos);
  estimation.setSearchMethodTarget(nullptr);
  EXPECT_NE(words(determine).find("null"), std::string::npos);
  EXPECT_EQ(pairs.size(), 3u) << "as they were";
}

TEST(OurCorrespondences, TakePartInIcp6D)
{
  pcl6d::ICP6D<Point, Point> icp;
  setUpCorner(icp);
  icp.setCorrespondenceEstimation(pcl::make_shared<OurEstimation>());
  for (const bool reciprocal : {false, true}) {
    icp.setUseReciprocalCorrespondences(reciprocal);
    expectCorner(icp, 1e-5);
  }
}

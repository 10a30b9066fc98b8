// SPDX-License-Identifier: BSD-3-Clause
// The coarse starts as classes of pcl::Registration.
#include "as_pcl_cases.h"

#include <pcl6d/registration/pcl/feature_alignment.h>
#include <pcl6d/registration/pcl/overlap_alignment.h>

using namespace pcl6d::test;
using pcl6d::Points;
using pcl6d::Random;
using pcl6d::Status;

namespace {
using Point = pcl::PointXYZ;
using Cloud = pcl::PointCloud<Point>;
using Registration = pcl::Registration<Point, Point>;
using ByFeatures = pcl6d::FeatureAlignment<Point, Point>;
using ByOverlap = pcl6d::OverlapAlignment<Point, Point>;

const Eigen::Isometry3d kTruth =
    pcl6d::poseFromEuler({0.9, -0.5, 0.1}, {0.02, -0.03, 1.2});

Cloud::Ptr
scanFrom(const Eigen::Isometry3d& pose, std::uint64_t seed)
{
  Random random(seed);
  return toCloud<Point>(PillarRoom().scan(pose, random, 0.025));
}

const Cloud::Ptr&
target()
{
  static const Cloud::Ptr cloud = scanFrom(Eigen::Isometry3d::Identity(), 1);
  return cloud;
}

const Cloud::Ptr&
source()
{
  static const Cloud::Ptr cloud = scanFrom(kTruth, 2);
  return cloud;
}

template <typename Coarse>
double
errorAfter(Coarse& coarse,
           const Eigen::Isometry3d& guess = Eigen::Isometry3d::Identity(),
           const Eigen::Isometry3d& truth = kTruth)
{
  alignFrom(coarse, guess);
  return errorOf(coarse, truth).translation;
}

/** \return a wall and nothing else */
Cloud::Ptr
wallAlone(std::uint64_t seed)
{
  Random random(seed);
  Points points;
  for (int i = 0; i < 6000; ++i)
    points.emplace_back(
        2 + 0.005 * random.normal(), random.uniform(-4, 4), random.uniform(-1, 2));
  return toCloud<Point>(points);
}
} // namespace

TEST(FeatureAlignmentClass, PlacesAScanWithoutAGuess)
{
  ByFeatures coarse;
  Registration& registration = coarse; // as code that takes any
  registration.setInputSource(source());
  registration.setInputTarget(target());
  Cloud aligned;
  registration.align(aligned);
  EXPECT_TRUE(registration.hasConverged());
  EXPECT_LT(errorOf(coarse, kTruth).translation, 0.1);
  EXPECT_EQ(coarse.result().status, Status::kOk);
  ASSERT_EQ(aligned.size(), source()->size());
  const Eigen::Vector3f p =
      registration.getFinalTransformation().topLeftCorner<3, 3>() *
          (*source())[7].getVector3fMap() +
      registration.getFinalTransformation().topRightCorner<3, 1>();
  EXPECT_LT((aligned[7].getVector3fMap() - p).norm(), 1e-5);
  EXPECT_LT(registration.getFitnessScore(), 0.05);
}

TEST(FeatureAlignmentClass, KnowsWhereTheScannerStood)
{
  // The same two scans in frames that are not those of their scanners.
  const Eigen::Vector3f to(30, -20, 5), from(-40, 10, 2);
  const auto shifted = [](const Cloud& cloud, const Eigen::Vector3f& by) {
    auto copy = pcl::make_shared<Cloud>(cloud);
    for (auto& p : *copy)
      p.getVector3fMap() += by;
    copy->sensor_origin_.head<3>() = by;
    return copy;
  };
  ByFeatures coarse;
  coarse.setInputTarget(shifted(*target(), to));
  coarse.setInputSource(shifted(*source(), from));
  Eigen::Isometry3d truth = kTruth;
  truth.translate(-from.cast<double>());
  truth.pretranslate(to.cast<double>());
  EXPECT_LT(errorAfter(coarse, Eigen::Isometry3d::Identity(), truth), 0.1);
  EXPECT_TRUE(coarse.hasConverged());
}

TEST(OverlapAlignmentClass, MendsAGuessThatIsMetresOff)
{
  ByOverlap coarse;
  coarse.setInputSource(source());
  coarse.setInputTarget(target());
  const Eigen::Isometry3d guess = kTruth * pcl6d::planarPose(0.8, -0.6, 0.2);
  EXPECT_LT(errorAfter(coarse, guess), 0.15);
  EXPECT_TRUE(coarse.hasConverged());
  EXPECT_EQ(coarse.result().status, Status::kOk);
}

TEST(OverlapAlignmentClass, KeepsItsDigitsFarFromTheOrigin)
{
  const Eigen::Vector3d far(51200, 64512, 320); // where float knows 8 mm
  auto there = pcl::make_shared<Cloud>(*target());
  for (auto& p : *there)
    p.getVector3fMap() = (p.getVector3fMap().cast<double>() + far).cast<float>();
  pcl6d::OverlapAlignment<Point, Point, double> coarse;
  coarse.setInputSource(source());
  coarse.setInputTarget(there);
  Eigen::Isometry3d truth = kTruth;
  truth.pretranslate(far);
  EXPECT_LT(errorAfter(coarse, truth * pcl6d::planarPose(0.8, -0.6, 0.2), truth), 0.15);
}

TEST(CoarseClasses, HonourTheIndices)
{
  auto disturbed = pcl::make_shared<Cloud>(*source());
  const auto chosen = pcl::make_shared<pcl::Indices>();
  for (std::size_t i = 0; i < disturbed->size(); ++i)
    if (i % 8 < 4)
      chosen->push_back(static_cast<int>(i));
    else
      (*disturbed)[i].getVector3fMap() *= 0.5f;
  ByOverlap coarse;
  coarse.setInputSource(disturbed);
  coarse.setInputTarget(target());
  coarse.setIndices(chosen);
  const Eigen::Isometry3d guess = kTruth * pcl6d::planarPose(0.5, -0.4, 0.1);
  EXPECT_LT(errorAfter(coarse, guess), 0.15);
  Cloud aligned;
  coarse.align(aligned, guess.matrix().cast<float>());
  EXPECT_EQ(aligned.size(), chosen->size());
}

TEST(CoarseClasses, DoNotConvergeOnWhatIsAmbiguous)
{
  ByFeatures features;
  ByOverlap overlap;
  for (Registration* coarse :
       {static_cast<Registration*>(&features), static_cast<Registration*>(&overlap)}) {
    coarse->setInputSource(wallAlone(1));
    coarse->setInputTarget(wallAlone(2));
    alignFrom(*coarse);
    EXPECT_FALSE(coarse->hasConverged()) << coarse->getClassName();
  }
  EXPECT_NE(features.result().status, Status::kOk);
  EXPECT_NE(overlap.result().status, Status::kOk);
}

TEST(CoarseClasses, GiveBackTheGuessWhereNothingIsFound)
{
  const auto nothing = pcl::make_shared<Cloud>();
  const auto nan = toCloud<Point>({{kNan, 0, 0}, {0, kInfinity, 0}});
  for (const auto& cloud : {nothing, nan}) {
    ByFeatures features;
    ByOverlap overlap;
    for (Registration* coarse : {static_cast<Registration*>(&features),
                                 static_cast<Registration*>(&overlap)}) {
      coarse->setInputSource(cloud);
      coarse->setInputTarget(target());
      EXPECT_LT(errorAfter(*coarse, kTruth), 1e-6) << coarse->getClassName();
      EXPECT_FALSE(coarse->hasConverged());
      coarse->setInputSource(source());
      coarse->setInputTarget(cloud);
      EXPECT_LT(errorAfter(*coarse, kTruth), 1e-6) << coarse->getClassName();
      EXPECT_FALSE(coarse->hasConverged());
    }
    EXPECT_EQ(features.result().status, Status::kTooFewPairs);
    EXPECT_EQ(overlap.result().status, Status::kTooFewPairs);
  }
}

TEST(CoarseClasses, RefuseWhatHasNoPlaceInThem)
{
  const auto words = [](auto change) {
    ByOverlap coarse;
    coarse.setInputSource(source());
    coarse.setInputTarget(target());
    change(coarse);
    return badArgumentOf([&] { alignFrom(coarse); });
  };
  EXPECT_EQ(words([](ByOverlap&) {}), "");
  EXPECT_NE(words([](ByOverlap& c) { c.setMaximumIterations(5); }).find("iterations"),
            std::string::npos);
  EXPECT_NE(
      words([](ByOverlap& c) { c.setMaxCorrespondenceDistance(1); }).find("distance"),
      std::string::npos);
  EXPECT_NE(words([](ByOverlap& c) { c.setTransformationEpsilon(1); }).find("epsilon"),
            std::string::npos);
  EXPECT_NE(words([](ByOverlap& c) {
              c.addCorrespondenceRejector(
                  pcl::make_shared<pcl6d::CorrespondenceRejectorOneToOne>());
            }).find("rejectors"),
            std::string::npos);
  ByFeatures coarse;
  EXPECT_FALSE(badArgumentOf([&] { coarse.setInputSource(nullptr); }).empty());
  EXPECT_FALSE(badArgumentOf([&] { coarse.setInputTarget(nullptr); }).empty());
  pcl6d::FeatureAlignmentOptions options;
  options.min_overlap = 2;
  EXPECT_FALSE(badArgumentOf([&] { coarse.setOptions(options); }).empty());
  coarse.setInputSource(source());
  coarse.setInputTarget(target());
  coarse.setIndices(pcl::make_shared<pcl::Indices>(1, 3));
  EXPECT_FALSE(badArgumentOf([&] {
                 coarse.setInputSource(toCloud<Point>({{0, 0, 0}}));
               }).empty());
}

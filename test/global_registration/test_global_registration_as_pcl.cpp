// SPDX-License-Identifier: BSD-3-Clause
// GlobalRegistration as a pcl::Registration.
#include "placeable.h"
#include "support/clouds.h"
#include "support/points.h"
#include "verification/verified_rooms.h"

#include <pcl6d/global_registration/pcl/global_registration.h>

#include <pcl/point_types.h>

#include <gtest/gtest.h>

using pcl6d::distanceBetween;
using pcl6d::MotionSize;
using pcl6d::PlaceAnswer;
using pcl6d::Points;
using pcl6d::poseFromEuler;
using pcl6d::Random;
using pcl6d::test::badArgumentOf;
using pcl6d::test::kFineTol;
using pcl6d::test::kFineTurn;
using pcl6d::test::kNan;
using pcl6d::test::PillarRoom;
using pcl6d::test::scannedPair;
using pcl6d::test::ScannedPair;
using pcl6d::test::toCloud;
using Vector = Eigen::Vector3d;

namespace {
using Point = pcl::PointXYZ;
using Cloud = pcl::PointCloud<Point>;
using Registration = pcl::Registration<Point, Point>;
using Placing = pcl6d::GlobalRegistration<Point, Point>;

template <typename PointT, typename Scalar = float>
using PlacingOf = pcl6d::GlobalRegistration<PointT, PointT, Scalar>;

template <typename Class>
Cloud
aligned(Class& placing, const Eigen::Isometry3d& guess = Eigen::Isometry3d::Identity())
{
  Cloud cloud;
  placing.align(cloud, guess.matrix().cast<float>());
  return cloud;
}

template <typename Class>
MotionSize
errorOf(Class& placing, const Eigen::Isometry3d& truth)
{
  Eigen::Isometry3d found;
  found.matrix() = placing.getFinalTransformation().template cast<double>();
  return distanceBetween(truth, found);
}

template <typename Class>
void
expectPlaced(Class& placing,
             const Eigen::Isometry3d& truth = scannedPair().T_first_second)
{
  EXPECT_TRUE(placing.hasConverged()) << placing.rejection();
  EXPECT_EQ(placing.answer(), PlaceAnswer::kUnique);
  const MotionSize off = errorOf(placing, truth);
  EXPECT_LT(off.translation, kFineTol);
  EXPECT_LT(off.rotation, kFineTurn);
}

void
setInput(Placing& placing)
{
  placing.setInputTarget(toCloud<Point>(scannedPair().first));
  placing.setInputSource(toCloud<Point>(scannedPair().second));
}

/** Half a turn about its middle changes nothing in it. */
PillarRoom
evenRoom()
{
  PillarRoom room;
  room.walls = {Vector(-5, -4, -1), Vector(5, 4, 2)};
  room.pillars = {{Vector(-3, -2, -1), Vector(-2, -1, 2)},
                  {Vector(2, 1, -1), Vector(3, 2, 2)}};
  return room;
}
} // namespace

TEST(GlobalRegistration, PlacesAScanFinelyWithoutAGuess)
{
  Placing placing;
  Registration& registration = placing; // as code that takes any
  registration.setInputTarget(toCloud<Point>(scannedPair().first));
  const Cloud::Ptr source = toCloud<Point>(scannedPair().second);
  registration.setInputSource(source);
  const Cloud moved = aligned(registration);
  expectPlaced(placing);
  EXPECT_EQ(placing.reason(), "");
  ASSERT_FALSE(placing.candidates().empty());
  EXPECT_LT(distanceBetween(scannedPair().T_first_second,
                            placing.candidates().front().T_first_second)
                .translation,
            0.1);
  ASSERT_EQ(moved.size(), source->size());
  const Eigen::Affine3f T(registration.getFinalTransformation());
  EXPECT_LT((moved[7].getVector3fMap() - T * (*source)[7].getVector3fMap()).norm(),
            1e-5);
  EXPECT_LT(registration.getFitnessScore(), 0.05); // what one of them does not see, too
}

TEST(GlobalRegistration, AGuessChangesNothing)
{
  Placing placing;
  setInput(placing);
  aligned(placing);
  const Eigen::Matrix4f without = placing.getFinalTransformation();
  aligned(placing, poseFromEuler({5, 3, 1}, {0.3, 0.2, 2}));
  EXPECT_EQ(placing.getFinalTransformation(), without);
}

TEST(GlobalRegistration, KnowsWhereTheScannersStood)
{
  const Eigen::Vector3f to(30, -20, 5), from(-40, 10, 2);
  const auto shifted = [](const Points& points, const Eigen::Vector3f& by) {
    Cloud::Ptr cloud = toCloud<Point>(points);
    for (auto& p : *cloud)
      p.getVector3fMap() += by;
    cloud->sensor_origin_.head<3>() = by;
    return cloud;
  };
  Placing placing;
  placing.setInputTarget(shifted(scannedPair().first, to));
  placing.setInputSource(shifted(scannedPair().second, from));
  aligned(placing);
  Eigen::Isometry3d truth = scannedPair().T_first_second;
  truth.translate(-from.cast<double>());
  truth.pretranslate(to.cast<double>());
  expectPlaced(placing, truth);
  EXPECT_LT(
      distanceBetween(truth, placing.candidates().front().T_first_second).translation,
      0.1);
}

TEST(GlobalRegistration, WorksWithOtherPointsAndInDouble)
{
  PlacingOf<pcl::PointXYZINormal, double> placing;
  placing.setInputTarget(toCloud<pcl::PointXYZINormal>(scannedPair().first));
  placing.setInputSource(toCloud<pcl::PointXYZINormal>(scannedPair().second));
  pcl::PointCloud<pcl::PointXYZINormal> cloud;
  placing.align(cloud);
  expectPlaced(placing);
}

TEST(GlobalRegistration, OneTargetServesManySources)
{
  Placing one;
  one.setInputTarget(toCloud<Point>(scannedPair().first));
  Random random(21);
  for (const double yaw : {-2.0, 0.4, 2.9}) {
    const Eigen::Isometry3d truth = poseFromEuler({0.9, -0.6, 0.05}, {0, 0.02, yaw});
    const auto source = toCloud<Point>(
        PillarRoom().scan(scannedPair().T_world_first * truth, random, 0.025));
    one.setInputSource(source);
    aligned(one);
    expectPlaced(one, truth);
    Placing fresh; // what was placed before changes nothing
    fresh.setInputTarget(toCloud<Point>(scannedPair().first));
    fresh.setInputSource(source);
    aligned(fresh);
    EXPECT_EQ(fresh.getFinalTransformation(), one.getFinalTransformation());
  }
}

TEST(GlobalRegistration, HonoursTheIndices)
{
  auto disturbed = toCloud<Point>(scannedPair().second);
  const auto chosen = pcl::make_shared<pcl::Indices>();
  for (std::size_t i = 0; i < disturbed->size(); ++i)
    if (i % 10 < 9)
      chosen->push_back(static_cast<int>(i));
    else
      (*disturbed)[i].getVector3fMap() *= 0.5f;
  Placing placing;
  placing.setInputTarget(toCloud<Point>(scannedPair().first));
  placing.setInputSource(disturbed);
  placing.setIndices(chosen);
  EXPECT_EQ(aligned(placing).size(), chosen->size());
  expectPlaced(placing);
}

TEST(GlobalRegistration, LeavesOutWhatIsNotFinite)
{
  Points first = scannedPair().first, second = scannedPair().second;
  for (std::size_t i = 0; i < second.size(); i += 50)
    second[i].setConstant(kNan);
  for (std::size_t i = 0; i < first.size(); i += 50)
    first[i].y() = pcl6d::test::kInfinity;
  Placing placing;
  placing.setInputTarget(toCloud<Point>(first));
  placing.setInputSource(toCloud<Point>(second));
  aligned(placing);
  expectPlaced(placing);
}

TEST(GlobalRegistration, DoesNotConvergeWhereTwoPlacesAreAsGood)
{
  const ScannedPair even(evenRoom());
  Placing placing;
  placing.setInputTarget(toCloud<Point>(even.first));
  placing.setInputSource(toCloud<Point>(even.second));
  aligned(placing);
  EXPECT_FALSE(placing.hasConverged());
  EXPECT_EQ(placing.answer(), PlaceAnswer::kAmbiguous);
  EXPECT_EQ(placing.result().status, pcl6d::Status::kRankDeficient);
  EXPECT_NE(placing.reason(), "");
  EXPECT_GE(placing.candidates().size(), 2u);
}

TEST(GlobalRegistration, GivesBackTheGuessWhereThereIsNoPlace)
{
  const Eigen::Isometry3d guess = poseFromEuler({1, 2, 0}, {0, 0, 1});
  const auto few = toCloud<Point>(
      Points(scannedPair().second.begin(), scannedPair().second.begin() + 40));
  const auto nan = toCloud<Point>({{kNan, 0, 0}, {0, pcl6d::test::kInfinity, 0}});
  const auto same = toCloud<Point>(Points(1000, {1, 2, 3}));
  const auto far =
      toCloud<Point>({{1e30f, 0, 0}, {0, 1e30f, 0}, {1, 1, 1}, {0, 0, 1e30f}});
  const auto none = pcl::make_shared<Cloud>();
  for (const auto& cloud : {few, nan, same, far, none}) {
    Placing placing;
    placing.setInputTarget(toCloud<Point>(scannedPair().first));
    placing.setInputSource(cloud);
    aligned(placing, guess);
    EXPECT_FALSE(placing.hasConverged());
    EXPECT_LT(errorOf(placing, guess).translation, 1e-6);
    EXPECT_EQ(placing.answer(), PlaceAnswer::kNone);
    EXPECT_NE(placing.reason(), "");
    placing.setInputTarget(cloud);
    placing.setInputSource(toCloud<Point>(scannedPair().first));
    aligned(placing, guess);
    EXPECT_FALSE(placing.hasConverged());
    EXPECT_EQ(placing.answer(), PlaceAnswer::kNone);
  }
}

TEST(GlobalRegistration, ForgetsWhatItFoundBefore)
{
  Placing placing;
  setInput(placing);
  aligned(placing);
  ASSERT_TRUE(placing.hasConverged());
  placing.setInputSource(toCloud<Point>(Points(200, {1, 2, 3})));
  aligned(placing);
  EXPECT_FALSE(placing.hasConverged());
  EXPECT_EQ(placing.answer(), PlaceAnswer::kNone);
  EXPECT_TRUE(placing.candidates().empty());
}

TEST(GlobalRegistration, TakesWhatIsUpFromTheCaller)
{
  const Eigen::Isometry3d camera = poseFromEuler(Vector::Zero(), {-M_PI / 2, 0, 0});
  const auto turned = [&](const Points& points) {
    return toCloud<Point>(pcl6d::transformed(points, camera.inverse()));
  };
  Placing placing;
  placing.setAnyAxis(false);
  placing.setExpectedUp(-Vector::UnitY(), -Vector::UnitY());
  placing.setInputTarget(turned(scannedPair().first));
  placing.setInputSource(turned(scannedPair().second));
  aligned(placing);
  expectPlaced(placing, camera.inverse() * scannedPair().T_first_second * camera);
}

TEST(GlobalRegistration, GivesBackWhatWasSet)
{
  Placing placing;
  placing.setMaximumCandidates(3);
  placing.setMaximumAmbiguity(0.4);
  placing.setMaximumContradiction(0.02);
  placing.setMinimumOverlap(0.15);
  placing.setVoxel(0.15);
  placing.setAnyAxis(false);
  placing.setNumberOfThreads(1);
  EXPECT_EQ(placing.getMaximumCandidates(), 3u);
  EXPECT_EQ(placing.getMaximumAmbiguity(), 0.4);
  EXPECT_EQ(placing.getMaximumContradiction(), 0.02);
  EXPECT_EQ(placing.getMinimumOverlap(), 0.15);
  EXPECT_EQ(placing.getVoxel(), 0.15);
  EXPECT_FALSE(placing.getAnyAxis());
  EXPECT_EQ(placing.options().search.num_threads, 1u);
  setInput(placing);
  aligned(placing);
  expectPlaced(placing);
  EXPECT_LE(placing.candidates().size(), 3u);
}

TEST(GlobalRegistration, RefusesWhatBreaksARuleOrHasNoPlaceInIt)
{
  Placing placing;
  EXPECT_NE(badArgumentOf([&] { placing.setMaximumCandidates(0); }), "");
  EXPECT_NE(badArgumentOf([&] { placing.setMaximumAmbiguity(1.5); }), "");
  EXPECT_NE(badArgumentOf([&] { placing.setMaximumContradiction(-1); }), "");
  EXPECT_NE(badArgumentOf([&] { placing.setMinimumOverlap(2); }), "");
  EXPECT_NE(badArgumentOf([&] { placing.setVoxel(-1); }), "");
  EXPECT_NE(badArgumentOf([&] {
              placing.setExpectedUp({0, 0, 2}, Vector::UnitZ());
            }).find("target_up"),
            std::string::npos);
  EXPECT_NE(badArgumentOf([&] { placing.setInputSource(nullptr); }), "");
  EXPECT_NE(badArgumentOf([&] { placing.setInputTarget(nullptr); }), "");
  EXPECT_EQ(placing.getMaximumCandidates(), 5u) << "what was refused is not kept";
  setInput(placing);
  placing.setMaximumIterations(3);
  EXPECT_NE(badArgumentOf([&] { aligned(placing); }).find("iterations"),
            std::string::npos);
}

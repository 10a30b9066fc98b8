// SPDX-License-Identifier: BSD-3-Clause
// Noise of normals feigns that a corridor fixes the motion along it; the normals of both scans tell.
#include "matching/open_directions.h"
#include "support/points.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/common/random.h>
#include <pcl6d/search/point_tree.h>

#include <gtest/gtest.h>

#include <cmath>

using pcl6d::IcpResult;
using pcl6d::IcpSource;
using pcl6d::IcpTarget;
using pcl6d::Localizability;
using pcl6d::Normals;
using pcl6d::Points;
using pcl6d::Random;
using pcl6d::Status;
using pcl6d::slam6d::measureWeakest;

namespace {
constexpr double kPairDistance = 0.17; // [m] of voxels of 10 cm

/** Two walls and a floor along x, with normals that err by an angle; with closets, a share of the
 * points faces along x. */
struct Corridor {
  Points points;
  Normals normals;

  Corridor(std::uint64_t seed, double normals_err, double share_of_closets)
  {
    Random places(1), errors(seed); // points of one place, seen with other noise
    for (int i = 0; i < 6000; ++i) {
      const double x = places.uniform(-6, 6), a = places.uniform(-1, 1);
      const bool is_closet = places.uniform(0, 1) < share_of_closets;
      Eigen::Vector3d place(x, i % 3 == 0 ? 1.5 : i % 3 == 1 ? -1.5 : a, a);
      Eigen::Vector3d normal(0, i % 3 == 0 ? -1 : 1, 0);
      if (i % 3 == 2) {
        place.z() = -1;
        normal = Eigen::Vector3d::UnitZ();
      }
      if (is_closet)
        normal = Eigen::Vector3d::UnitX();
      const Eigen::Vector3d tilt(errors.normal(), errors.normal(), errors.normal());
      points.push_back((place + 0.01 * errors.normal() * normal).cast<float>());
      normals.push_back((normal + normals_err * tilt).normalized().cast<float>());
    }
  }
};

/** \return what ICP found at the true pose, which measured a constraint of 3 % along the corridor */
IcpResult
foundAlong()
{
  IcpResult found;
  found.status = Status::kOk;
  found.covariance = pcl6d::PoseCovariance(pcl6d::PoseCovariance::Identity());
  found.localizability = Localizability();
  found.localizability->eigenvalues << 0.03, 0.2, 0.2, 0.2, 0.3, 0.3;
  return found; // the first motion is along x
}

IcpResult
measured(const Corridor& first, const Corridor& second)
{
  const pcl6d::PointTree tree(first.points);
  const IcpTarget target = {{&tree, &first.points, &first.normals}};
  IcpResult found = foundAlong();
  measureWeakest(target, {&second.points, &second.normals}, kPairDistance, found);
  return found;
}
} // namespace

TEST(WeakestMotion, IsOpenWhereOnlyNoiseFixesIt)
{
  for (const double err : {0.02, 0.1, 0.2}) { // [rad]; 0.2 feigns 4 % with one normal
    const IcpResult found = measured(Corridor(2, err, 0), Corridor(3, err, 0));
    EXPECT_EQ(found.localizability->openDirections(), 1) << err;
    EXPECT_EQ(found.status, Status::kRankDeficient);
    EXPECT_FALSE(found.covariance);
  }
}

TEST(WeakestMotion, StaysWhereSurfacesFixIt)
{
  for (const double err : {0.02, 0.2}) {
    const IcpResult found = measured(Corridor(2, err, 0.03), Corridor(3, err, 0.03));
    EXPECT_EQ(found.localizability->openDirections(), 0) << err;
    EXPECT_EQ(found.localizability->eigenvalues(0), 0.03);
    EXPECT_EQ(found.status, Status::kOk);
    EXPECT_TRUE(found.covariance);
  }
}

TEST(WeakestMotion, IsMeasuredInEachScale)
{
  const auto scaled = [](Corridor corridor) {
    for (auto& p : corridor.points)
      p *= 1000;
    return corridor;
  };
  const Corridor first = scaled(Corridor(2, 0.2, 0)),
                 second = scaled(Corridor(3, 0.2, 0));
  const pcl6d::PointTree tree(first.points);
  IcpResult found = foundAlong();
  measureWeakest({{&tree, &first.points, &first.normals}},
                 {&second.points, &second.normals},
                 1000 * kPairDistance,
                 found);
  EXPECT_EQ(found.localizability->openDirections(), 1);
}

TEST(WeakestMotion, IsNotMeasuredWithoutNormalsOrPairs)
{
  const Corridor first(2, 0.2, 0), second(3, 0.2, 0);
  const pcl6d::PointTree tree(first.points);
  const auto isUnchanged = [](const IcpResult& found) {
    return found.status == Status::kOk && found.localizability->openDirections() == 0;
  };
  IcpResult found = foundAlong();
  measureWeakest({{&tree, &first.points, nullptr}},
                 {&second.points, &second.normals},
                 kPairDistance,
                 found);
  EXPECT_TRUE(isUnchanged(found)) << "a target without normals";
  measureWeakest(
      {{&tree, &first.points, &first.normals}}, {&second.points}, kPairDistance, found);
  EXPECT_TRUE(isUnchanged(found)) << "a source without normals";
  measureWeakest({}, {&second.points, &second.normals}, kPairDistance, found);
  EXPECT_TRUE(isUnchanged(found)) << "no target";
  found.localizability.reset();
  measureWeakest({{&tree, &first.points, &first.normals}},
                 {&second.points, &second.normals},
                 kPairDistance,
                 found);
  EXPECT_EQ(found.status, Status::kOk) << "no figure of ICP";
}

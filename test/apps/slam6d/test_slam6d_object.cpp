// SPDX-License-Identifier: BSD-3-Clause
// Row 6.5 of the book: a small object, scanned once around, with the program that maps streets.
#include "apps/support/corridor_run.h"

#include <pcl6d/common/points.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/random.h>
#include <pcl6d/io/trajectory_io.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <fstream>
#include <limits>

namespace {
namespace fs = std::filesystem;
using Eigen::Vector3d;
using pcl6d::Points;
using pcl6d::Random;
using pcl6d::Trajectory;
using pcl6d::test::Outcome;
using pcl6d::test::slam;
using pcl6d::test::TempFolder;

constexpr double kNowhere = std::numeric_limits<double>::infinity();

double
rangeToBox(const Vector3d& o,
           const Vector3d& d,
           const Vector3d& low,
           const Vector3d& high)
{
  double enter = 0, leave = kNowhere;
  for (int axis = 0; axis < 3; ++axis) {
    const double a = (low[axis] - o[axis]) / d[axis],
                 b = (high[axis] - o[axis]) / d[axis];
    enter = std::max(enter, std::min(a, b));
    leave = std::min(leave, std::max(a, b));
  }
  return enter <= leave && enter > 0 ? enter : kNowhere;
}

double
rangeToBall(const Vector3d& o, const Vector3d& d, const Vector3d& centre, double radius)
{
  const double along = d.dot(o - centre),
               square = along * along - (o - centre).squaredNorm() + radius * radius;
  return square >= 0 ? -along - std::sqrt(square) : kNowhere;
}

/** A box of 20 cm with a ball on it and one at its side, seen by a scanner whose ranges are
 * known to 0.3 mm. */
Points
scanFrom(const Eigen::Isometry3d& pose, Random& random)
{
  Points points;
  for (double elevation = -12; elevation < 12; elevation += 0.2)
    for (double azimuth = -14; azimuth < 14; azimuth += 0.2) {
      const double e = elevation * M_PI / 180, a = azimuth * M_PI / 180;
      const Vector3d ray(
          std::cos(e) * std::cos(a), std::cos(e) * std::sin(a), std::sin(e));
      const Vector3d o = pose.translation(), d = pose.linear() * ray;
      const double range =
          std::min({rangeToBox(o, d, {-0.1, -0.06, 0}, {0.1, 0.06, 0.08}),
                    rangeToBall(o, d, {0.04, 0.01, 0.1}, 0.05),
                    rangeToBall(o, d, {-0.07, -0.05, 0.08}, 0.025)});
      if (range < kNowhere)
        points.push_back(((range + 3e-4 * random.normal()) * ray).cast<float>());
    }
  return points;
}

/** 0.6 m away, looking at the object. */
Eigen::Isometry3d
placeAround(double turn)
{
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = Vector3d(0.6 * std::cos(turn), 0.6 * std::sin(turn), 0.3);
  const Vector3d forward = (Vector3d(0, 0, 0.06) - pose.translation()).normalized();
  const Vector3d left = Vector3d::UnitZ().cross(forward).normalized();
  pose.linear() << forward, left, forward.cross(left);
  return pose;
}
} // namespace

TEST(SmallObject, ScannedOnceAroundIsPutTogether)
{
  const TempFolder folder;
  Random random(3);
  Trajectory truth, rough;
  const Eigen::Isometry3d first = placeAround(0);
  fs::create_directories(folder / "scans");
  for (int i = 0; i <= 6; ++i) {
    const Eigen::Isometry3d place = placeAround(i * M_PI / 3);
    std::ofstream file(folder / "scans" / ("scan00" + std::to_string(i) + ".xyz"));
    for (const auto& p : scanFrom(place, random))
      file << p.transpose() << '\n';
    truth.poses.push_back(first.inverse() * place);
    Eigen::Isometry3d off = Eigen::Isometry3d::Identity();
    if (i > 0) // half a centimetre and a degree
      off = pcl6d::poseFromEuler(
          {0.005 * random.normal(), 0.005 * random.normal(), 0.005 * random.normal()},
          {0.02 * random.normal(), 0.02 * random.normal(), 0.02 * random.normal()});
    rough.poses.push_back(truth.poses.back() * off);
  }
  pcl6d::writeTrajectoryKitti(folder / "scans/odometry.txt", rough);
  const Outcome outcome = slam(folder / "scans", folder / "out", {"--no-picture"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.out << outcome.err;
  const Trajectory poses = pcl6d::readTrajectory(folder / "out/trajectory.kitti");
  const Vector3d middle(0.67, 0, 0); // of the object, seen by the scanner
  for (std::size_t i = 0; i < truth.poses.size(); ++i) {
    const auto off = [&](const Eigen::Isometry3d& pose) {
      return (pose * middle - truth.poses[i] * middle).norm();
    };
    EXPECT_LT(off(poses.poses[i]), 1e-3) << i;
    EXPECT_LT(pcl6d::distanceBetween(poses.poses[i], truth.poses[i]).translation, 5e-3)
        << i << ", by the lever of 0.7 m";
  }
}

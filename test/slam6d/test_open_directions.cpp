// SPDX-License-Identifier: BSD-3-Clause
// Corridors and tunnels without features: what surfaces measure is corrected, and the motion that
// they leave open comes from the given poses.
#include "corridor_drive.h"
#include "matching/open_directions.h"
#include "registered_run.h"

#include <cmath>
#include <limits>

namespace {
using pcl6d::IcpResult;
using pcl6d::Localizability;
using pcl6d::poseFromEuler;
using pcl6d::Random;
using pcl6d::ScanState;
using pcl6d::Slam6DResult;
using pcl6d::Status;
using pcl6d::slam6d::holdOpenDirections;
using pcl6d::test::DriftingRun;
using pcl6d::test::PillarRoom;

/** \return a pose that ICP has found where surfaces leave so many motions open: along x, then
 * along y, then z, then turns */
IcpResult
foundWith(int open, const Eigen::Isometry3d& pose)
{
  IcpResult found;
  found.status = open > 0 ? Status::kRankDeficient : Status::kOk;
  found.T_target_source = pose;
  found.localizability = Localizability();
  found.localizability->centroid = {5, 1, 0};
  for (int k = 0; k < 6; ++k)
    found.localizability->eigenvalues(k) = k < open ? 0 : 0.3;
  return found;
}

TEST(OpenDirections, TakeTheOpenMotionFromThePrediction)
{
  const Eigen::Isometry3d predicted = poseFromEuler({0.5, 0.1, 0}, {});
  IcpResult found = foundWith(1, poseFromEuler({1.2, 0.12, 0.03}, {}));
  EXPECT_TRUE(holdOpenDirections(predicted, found));
  const Eigen::Vector3d expected(0.5, 0.12, 0.03);
  EXPECT_LT((found.T_target_source.translation() - expected).norm(), 1e-12);
  EXPECT_EQ(found.status, Status::kRankDeficient);
}

TEST(OpenDirections, KeepTurnsAboutTheMiddleOfThePoints)
{
  const Eigen::Translation3d middle(5, 1, 0);
  const Eigen::Isometry3d turn = poseFromEuler({}, {0.01, -0.02, 0.05});
  const Eigen::Isometry3d predicted = poseFromEuler({0.5, 0.1, 0}, {0, 0, 0.3});
  IcpResult found = foundWith(2, middle * turn * middle.inverse() * predicted);
  const Eigen::Isometry3d pose = found.T_target_source;
  EXPECT_TRUE(holdOpenDirections(predicted, found));
  EXPECT_LT((found.T_target_source.matrix() - pose.matrix()).norm(), 1e-12);
}

TEST(OpenDirections, ChangeNothingWhereNoneOrNearlyAllAreOpen)
{
  const Eigen::Isometry3d pose = poseFromEuler({1.2, 0.12, 0.03}, {});
  for (const int open : {0, 4, 6}) {
    IcpResult found = foundWith(open, pose);
    EXPECT_FALSE(holdOpenDirections(Eigen::Isometry3d::Identity(), found)) << open;
    EXPECT_EQ(found.T_target_source.matrix(), pose.matrix());
  }
  IcpResult unknown = foundWith(1, pose);
  unknown.localizability.reset();
  EXPECT_FALSE(holdOpenDirections(Eigen::Isometry3d::Identity(), unknown));
}

/** \return a drive through a straight tunnel whose ends are out of sight; the odometry drifts along
 * and across it, and turns */
DriftingRun
tunnelRun()
{
  PillarRoom tunnel;
  tunnel.walls = {Eigen::Vector3d(-60, -1.5, -1), Eigen::Vector3d(60, 1.5, 1.5)};
  tunnel.pillars.clear();
  Random random(3);
  DriftingRun run;
  const Eigen::Isometry3d drift = poseFromEuler({0.02, 0.02, 0.005}, {0, 0, 0.012});
  for (int i = 0; i < 6; ++i) {
    run.truth.push_back(poseFromEuler({0.8 * i, 0.1 * i, 0}, {0, 0, 0.02 * i}));
    run.odometry.push_back(i == 0 ? run.truth[0]
                                  : run.odometry.back() *
                                        run.truth[run.truth.size() - 2].inverse() *
                                        run.truth.back() * drift);
    run.scans.push_back(pcl6d::test::shortSighted(tunnel, run.truth.back(), random));
  }
  return run;
}

TEST(OpenDirections, ATunnelIsStraightAndItsLengthIsThatOfTheOdometry)
{
  const DriftingRun run = tunnelRun();
  const Slam6DResult result = pcl6d::test::registered(run);
  for (std::size_t i = 1; i < run.truth.size(); ++i) {
    const pcl6d::ScanResult& scan = result.scans[i];
    EXPECT_EQ(scan.state, ScanState::kUnconverged) << i;
    EXPECT_EQ(scan.status, Status::kRankDeficient) << i;
    const Eigen::Vector3d off =
        scan.T_world_scan.translation() - run.truth[i].translation();
    const Eigen::Vector3d was =
        run.odometry[i].translation() - run.truth[i].translation();
    EXPECT_LT(std::hypot(off.y(), off.z()), 0.03) << i << ", given " << was.transpose();
    // A drift along the way of 2 cm a step, which nothing measures, and no more.
    EXPECT_LT(std::abs(off.x()), 0.02 * static_cast<double>(i) + 0.02) << i;
  }
  EXPECT_FALSE(result.trusted());
}
} // namespace

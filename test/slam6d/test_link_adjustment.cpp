// SPDX-License-Identifier: BSD-3-Clause
// Poses of a map follow its refined links, and stay where these know less.
#include "graph/link_adjustment.h"
#include "support/points.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/common/random.h>
#include <pcl6d/registration/twist.h>
#include <pcl6d/slam6d/pose_bounds.h>

#include <gtest/gtest.h>

#include <algorithm>
#include <vector>

using pcl6d::LinkCheck;
using pcl6d::LinkTrust;
using pcl6d::MapVerification;
using pcl6d::poseFromEuler;
using pcl6d::Random;
using pcl6d::slam6d::adjustedToLinks;

namespace {
using Poses = std::vector<Eigen::Isometry3d>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;
constexpr double kVoxel = 0.1; // [m]
constexpr std::size_t kScans = 6;

/** A drive along x, and its map, which is off by a few centimetres and degrees. */
struct Drive {
  Poses truth, map;

  Drive()
  {
    Random random(5);
    for (std::size_t i = 0; i < kScans; ++i) {
      truth.push_back(poseFromEuler({2.0 * static_cast<double>(i), 0, 0}, {0, 0, 0.3}));
      const Eigen::Vector3d shift =
          0.03 * Eigen::Vector3d(random.normal(), random.normal(), random.normal());
      const Eigen::Isometry3d error =
          poseFromEuler(shift, {0, 0.005 * random.normal(), 0.005 * random.normal()});
      map.push_back(i == 0 ? truth[i] : Eigen::Isometry3d(truth[i] * error));
    }
  }

  /** \return what a link measures that is right, to a deviation of its shift */
  LinkCheck
  link(std::size_t from, std::size_t to, bool is_refined, double deviation) const
  {
    LinkCheck check;
    check.from = from;
    check.to = to;
    check.trust = LinkTrust::kGood;
    check.refined = is_refined;
    check.deviation = 0.1 * kVoxel;
    check.covariance = deviation * deviation * Matrix6::Identity();
    const Eigen::Isometry3d seen = map[from].inverse() * map[to];
    check.pull =
        pcl6d::twistFromMotion(seen.inverse() * truth[from].inverse() * truth[to]);
    return check;
  }

  /** \return the verdict on the map, whose scans are linked with the one and the two before */
  MapVerification
  verdict(bool are_refined, double deviation = 0.001) const
  {
    MapVerification verdict;
    verdict.scans.resize(kScans);
    for (auto& scan : verdict.scans)
      scan.tied = true;
    for (std::size_t i = 0; i < kScans; ++i)
      for (std::size_t k = i + 1; k < std::min(i + 3, kScans); ++k)
        verdict.links.push_back(link(i, k, are_refined, deviation));
    return verdict;
  }

  Poses
  adjusted(const MapVerification& verdict, unsigned int threads = 1) const
  {
    return adjustedToLinks(map, verdict, kVoxel, threads);
  }

  double
  errorOf(const Poses& poses, std::size_t scan) const
  {
    return (poses[scan].translation() - truth[scan].translation()).norm();
  }
};

bool
isClose(const Eigen::Isometry3d& a, const Eigen::Isometry3d& b, double tolerance)
{
  return (a.matrix() - b.matrix()).cwiseAbs().maxCoeff() < tolerance;
}
} // namespace

TEST(LinkAdjustment, FollowsRefinedLinks)
{
  const Drive drive;
  const Poses poses = drive.adjusted(drive.verdict(true));
  ASSERT_EQ(poses.size(), kScans);
  for (std::size_t i = 1; i < kScans; ++i) {
    EXPECT_GT(drive.errorOf(drive.map, i), 0.01) << i;
    EXPECT_LT(drive.errorOf(poses, i), 0.001) << i;
  }
}

TEST(LinkAdjustment, IsNoneWithoutRefinedLinks)
{
  const Drive drive;
  EXPECT_TRUE(drive.adjusted(drive.verdict(false)).empty());
  MapVerification loose = drive.verdict(true);
  loose.scans[0].tied = false;
  EXPECT_TRUE(drive.adjusted(loose).empty()) << "nothing is connected with the first";
  EXPECT_TRUE(adjustedToLinks({}, {}, kVoxel, 1).empty());
}

TEST(LinkAdjustment, LinksWithEqualWeightsHoldTheMap)
{
  const Drive drive;
  MapVerification verdict = drive.verdict(true);
  auto& links = verdict.links;
  links.erase(std::remove_if(links.begin(),
                             links.end(),
                             [](const LinkCheck& link) {
                               return link.to == kScans - 1 && link.from + 1 < link.to;
                             }),
              links.end());
  links.back().refined = false; // with a pull that must not count
  const Poses poses = drive.adjusted(verdict);
  const auto step = [](const Poses& all) -> Eigen::Isometry3d {
    return all[kScans - 2].inverse() * all[kScans - 1];
  };
  EXPECT_LT(drive.errorOf(poses, kScans - 2), 0.001);
  EXPECT_FALSE(isClose(step(drive.map), step(drive.truth), 0.01));
  EXPECT_TRUE(isClose(step(poses), step(drive.map), 1e-6));
}

TEST(LinkAdjustment, MotionsThatLinksFixWeaklyStay)
{
  const Drive drive;
  const Poses poses = drive.adjusted(drive.verdict(true, 10));
  for (std::size_t i = 0; i < kScans; ++i)
    EXPECT_TRUE(isClose(poses[i], drive.map[i], 0.002)) << i;
}

TEST(LinkAdjustment, ScansThatNothingConnectsStay)
{
  const Drive drive;
  MapVerification verdict = drive.verdict(true);
  verdict.scans[kScans - 1].tied = false;
  const Poses poses = drive.adjusted(verdict);
  EXPECT_TRUE(isClose(poses.back(), drive.map.back(), 1e-15));
  EXPECT_LT(drive.errorOf(poses, kScans - 2), 0.001);
}

TEST(LinkAdjustment, HasTheSameBitsForAnyNumberOfThreads)
{
  const Drive drive;
  const Poses one = drive.adjusted(drive.verdict(true)),
              four = drive.adjusted(drive.verdict(true), 4);
  for (std::size_t i = 0; i < kScans; ++i)
    EXPECT_EQ(one[i].matrix(), four[i].matrix());
}

TEST(LinkAdjustment, BoundsKeepTheVarianceOfTheMapBefore)
{
  const Drive drive;
  MapVerification verdict = drive.verdict(true);
  const auto boundAt = [&](double least_factor) {
    const double factor = pcl6d::boundPoses(drive.map, verdict, 1, {}, least_factor);
    EXPECT_GE(factor, least_factor);
    return verdict.scans.back().covariance->trace();
  };
  for (LinkCheck& link : verdict.links)
    link.pull.setZero();
  EXPECT_NEAR(boundAt(4), 4 * boundAt(1), 1e-9);
}

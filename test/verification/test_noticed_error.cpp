// SPDX-License-Identifier: BSD-3-Clause
// From how far on an error of a link would be noticed.
#include "verified_rooms.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/verification/link_evidence.h>

#include <gtest/gtest.h>

#include <cmath>

using pcl6d::LinkEvidence;
using pcl6d::linkEvidence;
using pcl6d::LinkTrust;
using pcl6d::noticedError;
using pcl6d::test::ScannedPair;
using pcl6d::test::VerifiedScans;

namespace {
constexpr double kErrorBackground = 0.006;

std::optional<pcl6d::NoticedError>
noticedAt(const VerifiedScans& scans, const Eigen::Isometry3d& T)
{
  return noticedError(
      scans[0], scans[1], linkEvidence(scans[0], scans[1], T), kErrorBackground);
}
} // namespace

TEST(NoticedError, OfARoomIsAFewCentimetresEachWay)
{
  const ScannedPair pair;
  const VerifiedScans scans = pair.verified();
  const LinkEvidence evidence = linkEvidence(scans[0], scans[1], pair.T_first_second);
  const auto noticed = noticedError(scans[0], scans[1], evidence, kErrorBackground);
  ASSERT_TRUE(noticed);
  EXPECT_GE(noticed->least, 3 * evidence.deviation());
  EXPECT_GE(noticed->most, noticed->least);
  EXPECT_LT(noticed->most, 0.3);
  EXPECT_LT(noticed->turn, 0.1);
  EXPECT_NEAR(noticed->weakest.norm(), 1, 1e-12);
}

TEST(NoticedError, IsWhatTheJudgeNoticesIndeed)
{
  const ScannedPair pair;
  const VerifiedScans scans = pair.verified();
  const auto noticed = noticedAt(scans, pair.T_first_second);
  ASSERT_TRUE(noticed);
  for (const double sign : {-1.0, 1.0}) {
    const Eigen::Isometry3d moved =
        Eigen::Translation3d(1.5 * sign * noticed->most * noticed->weakest) *
        pair.T_first_second;
    EXPECT_NE(testLink(linkEvidence(scans[0], scans[1], moved), kErrorBackground).trust,
              LinkTrust::kGood);
  }
}

TEST(NoticedError, IsInTheUnitOfTheScans)
{
  const ScannedPair pair;
  const auto noticedIn = [&](double scale) {
    Eigen::Isometry3d T = pair.T_first_second;
    T.translation() *= scale;
    return *noticedAt(pair.verified(scale), T);
  };
  const auto metres = noticedIn(1);
  for (const double scale : {100.0, 0.01}) {
    EXPECT_NEAR(noticedIn(scale).most, scale * metres.most, 0.05 * scale * metres.most);
    EXPECT_NEAR(noticedIn(scale).turn, metres.turn, 0.05 * metres.turn);
  }
}

TEST(NoticedError, IsNoneOfALinkThatIsNotGood)
{
  const ScannedPair pair;
  const VerifiedScans scans = pair.verified();
  EXPECT_FALSE(noticedAt(scans, pcl6d::poseFromEuler({50, 0, 0}, {})));
  VerifiedScans empty;
  empty.add({});
  empty.add({});
  EXPECT_FALSE(noticedAt(empty, Eigen::Isometry3d::Identity()));
}

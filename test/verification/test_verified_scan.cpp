// SPDX-License-Identifier: BSD-3-Clause
#include "support/points.h"
#include "verified_rooms.h"

#include <utility>

using pcl6d::IcpModel;
using pcl6d::Normals;
using pcl6d::Points;
using pcl6d::VerifiedScan;
using pcl6d::test::badArgumentOf;
using pcl6d::test::kInfinity;
using pcl6d::test::kNan;
using pcl6d::test::kVoxel;
using pcl6d::test::ScannedPair;
using pcl6d::test::spoilt;
using pcl6d::test::surfaceOptions;
using pcl6d::test::VerifiedScans;

TEST(VerifiedScan, KnowsItsRaysSurfacesAndNoise)
{
  for (const double sigma : {0.005, 0.02}) {
    const VerifiedScans scans = ScannedPair({}, sigma).verified();
    const VerifiedScan& scan = scans[0];
    EXPECT_EQ(scan.voxel(), kVoxel);
    EXPECT_GT(scan.surfaces().points().size(), 5000u);
    EXPECT_EQ(scan.surfaces().normals().size(), scan.surfaces().points().size());
    EXPECT_GT(scan.rays().resolution(), 0);
    EXPECT_GT(scan.noise(), 0.4 * sigma) << "at a slant it is less";
    EXPECT_LT(scan.noise(), 1.25 * sigma);
    EXPECT_LT(scan.selfContradiction(), 0.005);
    EXPECT_FALSE(scan.abstains());
  }
}

TEST(VerifiedScan, AbstainsIfItsRaysContradictItsOwnPoints)
{
  VerifiedScans scans;
  scans.add(spoilt(ScannedPair().first));
  EXPECT_GT(scans[0].selfContradiction(), 0.05);
  EXPECT_TRUE(scans[0].abstains());
}

TEST(VerifiedScan, DoesNotSeePointsThatAreNotFinite)
{
  const Points points = ScannedPair().first;
  Points with = points;
  with.insert(with.begin(), {kNan, 0, 0});
  with.insert(with.begin() + 500, {1, kInfinity, 0});
  VerifiedScans scans;
  scans.add(points);
  scans.add(with);
  EXPECT_EQ(scans[1].noise(), scans[0].noise());
  EXPECT_EQ(scans[1].selfContradiction(), scans[0].selfContradiction());
  EXPECT_EQ(scans[1].surfaces().points().size(), scans[0].surfaces().points().size());
}

TEST(VerifiedScan, MayBeEmptyOrTiny)
{
  VerifiedScans scans;
  scans.add({});
  scans.add({{1, 2, 3}});
  scans.add(Points(100, {kNan, kNan, kNan}));
  for (std::size_t i = 0; i < 3; ++i) {
    EXPECT_EQ(scans[i].noise(), 0);
    EXPECT_EQ(scans[i].selfContradiction(), 0);
    EXPECT_TRUE(scans[i].abstains()) << "it has no patches to be verified by";
  }
}

TEST(VerifiedScan, NamesWhatIsWrong)
{
  const Points points = {{1, 0, 0}, {0, 1, 0}, {0, 0, 1}, {1, 1, 1}};
  const IcpModel plain(points, {}), good(points, surfaceOptions());
  EXPECT_EQ(badArgumentOf([&] { VerifiedScan(points, plain, 0.1); }),
            "normals = 0, but must be one per point");
  for (const double voxel : {0.0, -1.0, static_cast<double>(kNan)})
    EXPECT_EQ(
        badArgumentOf([&] { VerifiedScan(points, good, voxel); }).find("voxel = "), 0u);
  EXPECT_NE(badArgumentOf([&] { VerifiedScan(points, good, 0.1, {kNan, 0, 0}); }), "");
}

// SPDX-License-Identifier: BSD-3-Clause
#include "support/data_folder.h"

#include <pcl6d/io/scan_reader.h>
#include <pcl6d/io/trajectory_io.h>
#include <pcl6d/visibility/range_noise.h>
#include <pcl6d/visibility/ray_origin.h>
#include <pcl6d/visibility/sight_evidence.h>

#include <algorithm>
#include <string>
#include <utility>

using pcl6d::PlaceUncertainty;
using pcl6d::Points;
using pcl6d::RayImage;
using pcl6d::RayImageOptions;
using pcl6d::SightEvidence;

namespace {
using Isometry = Eigen::Isometry3d;
using Vector = Eigen::Vector3d;
constexpr double kPatch = 0.5; // [m]
constexpr double kPose = 0.03; // [m] the reference is good to a few cm

/** A scan with what its rays say. */
struct SeenScan {
  Points points;
  double noise = 0;
  RayImage image;

  explicit SeenScan(Points measured)
  : points(std::move(measured)), noise(pcl6d::rangeNoise(points))
  {
    RayImageOptions options;
    options.noise = noise;
    image = RayImage(points, options);
  }
};

SeenScan
hku1Scan(const std::filesystem::path& folder, int number)
{
  const std::string digits = std::to_string(1000 + number).substr(1);
  return SeenScan(pcl6d::readScan(folder / ("scan" + digits + ".pcd")).points);
}

/** \return what each of two scans says of the other */
SightEvidence
bothWays(const SeenScan& a, const SeenScan& b, const Isometry& T_a_b)
{
  PlaceUncertainty of_a{a.noise, {}}, of_b{b.noise, {}};
  of_a.motion.setZero();
  of_a.motion.diagonal().head<3>().setConstant(kPose * kPose);
  of_b.motion = of_a.motion;
  SightEvidence evidence = pcl6d::sightEvidence(a.image, b.points, T_a_b, of_b, kPatch);
  evidence += pcl6d::sightEvidence(b.image, a.points, T_a_b.inverse(), of_a, kPatch);
  return evidence;
}
} // namespace

TEST(Hku1, RaysTellTheRightPoseOfNeighboursFromWrongOnes)
{
  PCL6D_DATA_OR_SKIP(folder, "hku1");
  const auto poses = pcl6d::readTrajectory(folder / "groundtruth.txt").poses;
  for (const int i : {0, 10, 20, 30, 40, 50}) {
    SCOPED_TRACE("scans " + std::to_string(i) + " and the next");
    const SeenScan a = hku1Scan(folder, i), b = hku1Scan(folder, i + 1);
    const auto k = static_cast<std::size_t>(i);
    const Isometry T_a_b = poses[k].inverse() * poses[k + 1];
    const SightEvidence right = bothWays(a, b, T_a_b);
    EXPECT_EQ(right.points(), a.points.size() + b.points.size());
    // Measured: 0.0004 to 0.0029, and 0.46 to 0.69 shifted; other links of hku1: up to 0.009.
    EXPECT_LT(right.contradiction(), 0.009);
    EXPECT_GT(right.confirmation(), 0.4);
    EXPECT_LE(right.contradicted_patches, right.patches / 200);
    double shifted = 0;
    for (int axis = 0; axis < 3; ++axis)
      for (const double step : {-0.5, 0.5}) { // [m]
        const Isometry wrong = Eigen::Translation3d(step * Vector::Unit(axis)) * T_a_b;
        shifted = std::max(shifted, bothWays(a, b, wrong).contradiction());
      }
    EXPECT_GT(shifted, 0.2) << "in the direction that shows it best";
    // About the axis of its view, as it is narrow: else it would only look away.
    Vector axis = Vector::Zero();
    for (const auto& p : b.points)
      axis += p.cast<double>().normalized();
    const Isometry turned = T_a_b * Eigen::AngleAxisd(M_PI, axis.normalized());
    EXPECT_GT(bothWays(a, b, turned).contradiction(), 0.1);
    EXPECT_GT(bothWays(a, b, turned).contradicted_patches, 50u);
  }
}

TEST(Hku1, ScansDoNotContradictThemselves)
{
  PCL6D_DATA_OR_SKIP(folder, "hku1");
  for (const int i : {0, 20, 40}) {
    const SeenScan scan = hku1Scan(folder, i);
    // Keyframes merged of five: measured 0.0005 to 0.0053.
    EXPECT_LT(
        pcl6d::selfContradiction(scan.points, Vector::Zero().cast<float>(), scan.noise),
        0.01);
  }
}

TEST(Cases, CutOutsInACommonFrameHaveNoScannerAtTheirOrigin)
{
  PCL6D_DATA_OR_SKIP(cases, "cases");
  for (int i = 0; i < 3; ++i) {
    const std::string name = "scan00" + std::to_string(i) + ".pcd";
    const Points far = pcl6d::readScan(cases / "M4_offset_6_31_49" / name).points;
    EXPECT_FALSE(pcl6d::isPlausibleOrigin(far));
    EXPECT_TRUE(pcl6d::isPlausibleOrigin(far, {6, 31, 49}));
    EXPECT_TRUE(pcl6d::isPlausibleOrigin(
        pcl6d::readScan(cases / "UD2_one_flipped" / name).points));
  }
}

TEST(Hku1, ScansAreCentredOnTheirScanner)
{
  PCL6D_DATA_OR_SKIP(folder, "hku1");
  for (const int i : {0, 10, 49}) // 0 and 49: the largest shares of all scans
    EXPECT_LT(pcl6d::crossedShare(hku1Scan(folder, i).points, {0, 0, 0}), 0.05);
}

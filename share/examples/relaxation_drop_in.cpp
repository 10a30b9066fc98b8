// SPDX-License-Identifier: BSD-3-Clause
// Shows: code that was written for pcl::registration::LUM gets pcl6d::LUM by changing one
// class name. Six scans of a room's corner from a round in it, first all facing one way, then each
// facing another way, where the Euler angles of PCL's class contradict each other.
#include "synthetic.h"

#include <pcl6d/graph_relaxation/pcl/lum.h>

#include <pcl/common/transforms.h>
#include <pcl/registration/correspondence_estimation.h>
#include <pcl/registration/lum.h>

#include <cstdio>
#include <vector>

using Cloud = pcl::PointCloud<pcl::PointXYZ>;
constexpr int kScans = 6;

struct Drive {
  std::vector<Eigen::Isometry3d> truth, guesses; // T_room_scan
  std::vector<Cloud::Ptr> clouds;                // each in its scan's frame
};

Drive
driveRound(double heading_step)
{
  Drive drive;
  for (int i = 0; i < kScans; ++i) {
    const double turn = 2 * M_PI * i / kScans;
    drive.truth.push_back(pcl6d::poseFromEuler(
        {1 + 1.5 * std::cos(turn), 1.2 * std::sin(turn), 0}, {0, 0, heading_step * i}));
    const Eigen::Isometry3d drift =
        pcl6d::poseFromEuler({0.01 * i, -0.008 * i, 0}, {0, 0, 0.004 * i});
    drive.guesses.push_back(drive.truth.back() * drift);
    drive.clouds.push_back(
        makeRoomCorner<pcl::PointXYZ>(i, drive.truth.back().inverse()));
  }
  return drive;
}

// Closest points of two scans at the poses that are known so far.
pcl::CorrespondencesPtr
pairsOf(const Cloud& a, const Cloud& b)
{
  pcl::registration::CorrespondenceEstimation<pcl::PointXYZ, pcl::PointXYZ> closest;
  closest.setInputSource(a.makeShared());
  closest.setInputTarget(b.makeShared());
  const pcl::CorrespondencesPtr pairs(new pcl::Correspondences);
  closest.determineCorrespondences(*pairs, 0.3); // [m]
  return pairs;
}

// The code that was there before: pairs anew, a few rounds, again. Returns how far the
// worst scan is from where it was taken [m].
template <typename Lum>
double
relax(const Drive& drive)
{
  Lum lum;
  for (int i = 0; i < kScans; ++i) {
    Eigen::Matrix<float, 6, 1> pose;
    const Eigen::Isometry3d in_first = drive.guesses[0].inverse() * drive.guesses[i];
    pcl::getTranslationAndEulerAngles(Eigen::Affine3f(in_first.cast<float>()),
                                      pose[0],
                                      pose[1],
                                      pose[2],
                                      pose[3],
                                      pose[4],
                                      pose[5]);
    lum.addPointCloud(drive.clouds[i], pose);
  }
  for (int round = 0; round < 8; ++round) {
    for (int a = 0; a < kScans; ++a)
      for (const int b : {(a + 1) % kScans, (a + 2) % kScans})
        lum.setCorrespondences(
            a, b, pairsOf(*lum.getTransformedCloud(a), *lum.getTransformedCloud(b)));
    lum.setMaxIterations(3);
    lum.compute();
  }
  double worst = 0;
  for (int i = 0; i < kScans; ++i) {
    const Eigen::Isometry3d pose(
        lum.getTransformation(i).matrix().template cast<double>());
    const Eigen::Isometry3d found = drive.truth[0] * pose; // the first one stays
    const double off = (found.translation() - drive.truth[i].translation()).norm();
    worst = std::isfinite(off) ? std::max(worst, off) : 1e9;
  }
  return worst;
}

int
main()
{
  bool fine = true;
  for (const double heading_step : {0.02, 1.1}) {
    const Drive drive = driveRound(heading_step);
    const double before =
        (drive.guesses.back().translation() - drive.truth.back().translation()).norm();
    const double pcl_error = relax<pcl::registration::LUM<pcl::PointXYZ>>(drive);
    const double error = relax<pcl6d::LUM<pcl::PointXYZ>>(drive); // one name changed
    std::printf("headings %.2f rad apart: worst scan %.3f m off before, %.3f m with "
                "pcl::registration::LUM, %.3f m with pcl6d::LUM\n",
                heading_step,
                before,
                pcl_error,
                error);
    fine = fine && error < 0.5 * before;
  }
  std::printf(fine ? "pcl6d::LUM ok\n" : "pcl6d::LUM failed\n");
  return fine ? 0 : 1;
}

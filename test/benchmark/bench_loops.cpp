// SPDX-License-Identifier: BSD-3-Clause
// Drives with a reference whose poses are bent as if they had drifted, and the loops found again:
// how far the poses are off before and after, which loops are wrong, how long it takes.
// usage: bench_loops [every=N] [scans=N] [threads=N] [yaw=DEGREES-PER-100-M] FOLDER ...
#include "verification_links.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/global_registration/drive_loops.h>

#include <chrono>
#include <cmath>
#include <cstdlib>
#include <deque>
#include <iostream>
#include <map>
#include <string>
#include <vector>

namespace pcl6d::bench {

namespace {
/** \return the poses with a heading that drifts steadily [rad/m], and steps 1 % too long */
std::vector<Eigen::Isometry3d>
bent(const std::vector<Eigen::Isometry3d>& truth, double turn)
{
  std::vector<Eigen::Isometry3d> poses{truth[0]};
  for (std::size_t i = 1; i < truth.size(); ++i) {
    Eigen::Isometry3d step = truth[i - 1].inverse() * truth[i];
    const double yaw = turn * step.translation().norm();
    step.translation() *= 1.01;
    step.linear() = Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) * step.linear();
    poses.push_back(poses.back() * step);
    poses.back().linear() =
        Eigen::Quaterniond(poses.back().linear()).normalized().toRotationMatrix();
  }
  return poses;
}

/** \return [m] rms and largest distance of the positions from the reference */
std::pair<double, double>
off(const std::vector<Eigen::Isometry3d>& poses,
    const std::vector<Eigen::Isometry3d>& truth)
{
  double sum = 0, largest = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const double d = (poses[i].translation() - truth[i].translation()).norm();
    sum += d * d;
    largest = std::max(largest, d);
  }
  return {std::sqrt(sum / static_cast<double>(poses.size())), largest};
}

int
run(const std::vector<std::string>& arguments)
{
  std::map<std::string, double> knobs{
      {"every", 1}, {"scans", 2000}, {"threads", 2}, {"yaw", 10}};
  for (const std::string& argument : arguments) {
    const auto equals = argument.find('=');
    if (equals != std::string::npos) {
      knobs.at(argument.substr(0, equals)) = std::atof(argument.c_str() + equals + 1);
      continue;
    }
    const LinkSet set = readLinkSet(argument,
                                    static_cast<int>(knobs["every"]),
                                    static_cast<std::size_t>(knobs["scans"]));
    const auto& truth = set.T_world_scan;
    const auto poses = bent(truth, knobs["yaw"] * M_PI / 180 / 100);
    std::deque<PlaceableScan> scans;
    for (const auto& scan : set.scans)
      scans.emplace_back(scan);
    DriveLoopOptions options;
    options.num_threads = static_cast<unsigned int>(knobs["threads"]);
    const auto start = std::chrono::steady_clock::now();
    const DriveLoops found = closeDriveLoops(scans, poses, options);
    const std::chrono::duration<double> spent =
        std::chrono::steady_clock::now() - start;
    std::size_t wrong = 0;
    for (const DriveLoop& loop : found.loops) {
      const MotionSize apart =
          distanceBetween(truth[loop.from].inverse() * truth[loop.to], loop.T_from_to);
      const bool is_right = apart.translation < 0.5 && apart.rotation < 0.087;
      wrong += !is_right && loop.counts;
      std::cout << "  loop " << loop.from << ' ' << loop.to << ": drift " << loop.drift
                << " m, off the reference by " << apart.translation << " m "
                << (loop.counts ? "" : "(switched off)") << '\n';
    }
    const auto before = off(poses, truth), after = off(found.poses, truth);
    std::cout << set.name << ": " << truth.size() << " scans, off by " << before.first
              << " m rms, " << before.second << " m at most; after "
              << found.loops.size() << " loops (" << wrong << " wrong) of "
              << found.searched << " searched: " << after.first << " m rms, "
              << after.second << " m at most; " << spent.count() << " s\n";
  }
  return 0;
}
} // namespace

} // namespace pcl6d::bench

int
main(int argc, char** argv)
{
  return pcl6d::bench::run({argv + 1, argv + argc});
}

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "apps/convert/convert_test.h"
#include "support/shared_run.h"

#include <pcl6d/common/rotation.h>
#include <pcl6d/io/trajectory_io.h>

#include <algorithm>
#include <fstream>
#include <iomanip>

namespace pcl6d::test {

/** \brief Twelve stations of a terrestrial scanner in a storage hall, with rough poses, as an E57 file,
 * and six surveyed points in national coordinates, of which T3 is 6 cm wrong. */
class ControlSite {
public:
  /** \param[in] folder gets site.e57, control.csv and targets.csv */
  explicit ControlSite(const std::filesystem::path& folder) : folder_(folder)
  {
    const auto scans = sharedOutput("pcl_slam6d_simulate",
                                    {"shelves",
                                     "--scanner",
                                     "terrestrial",
                                     "--resolution",
                                     "0.75",
                                     "--scans",
                                     "12",
                                     "--quiet"});
    const auto truth = readTrajectory(scans / "groundtruth.txt").poses;
    Eigen::Isometry3d T_control_world = Eigen::Isometry3d::Identity();
    T_control_world.linear() =
        Eigen::AngleAxisd(0.7, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    T_control_world.translation() = Eigen::Vector3d(3512345, 5412345, 431);
    Random random(5);
    writeRoughPoses(truth, random);
    converted({"scans",
               scans.string(),
               "--poses",
               (folder / "rough.txt").string(),
               "-o",
               (folder / "site.e57").string(),
               "--quiet"});
    writePoints(truth, T_control_world, random);
    for (const Eigen::Isometry3d& pose : truth)
      truth_.push_back(T_control_world * pose);
  }

  /** \return the options of a run with these points */
  std::vector<std::string>
  options() const
  {
    return {"--control",
            (folder_ / "control.csv").string(),
            "--targets",
            (folder_ / "targets.csv").string(),
            "--check",
            "T5, T6"};
  }

  /** \return T_control_scan */
  const std::vector<Eigen::Isometry3d>&
  truth() const
  {
    return truth_;
  }

private:
  static Eigen::Vector3d
  noise(Random& random, double sigma)
  {
    const double x = random.normal(), y = random.normal(), z = random.normal();
    return sigma * Eigen::Vector3d(x, y, z);
  }

  void
  writeRoughPoses(const std::vector<Eigen::Isometry3d>& truth, Random& random) const
  {
    Trajectory rough;
    for (Eigen::Isometry3d pose : truth) { // 10 cm and 1 deg
      pose.translation() += noise(random, 0.1);
      const double turn = 0.02 * random.normal();
      pose.rotate(Eigen::AngleAxisd(turn, Eigen::Vector3d::UnitZ()));
      rough.poses.push_back(pose);
    }
    writeTrajectoryKitti(folder_ / "rough.txt", rough);
  }

  void
  writePoints(const std::vector<Eigen::Isometry3d>& truth,
              const Eigen::Isometry3d& T_control_world,
              Random& random) const
  {
    constexpr double kSigma = 0.001; // [m]
    Eigen::Vector3d low = truth[0].translation(), high = low;
    for (const Eigen::Isometry3d& pose : truth) {
      low = low.cwiseMin(pose.translation());
      high = high.cwiseMax(pose.translation());
    }
    std::ofstream control(folder_ / "control.csv"), targets(folder_ / "targets.csv");
    control << "name,x,y,z,sigma\n" << std::fixed << std::setprecision(5);
    targets << "name,scan,x,y,z\n" << std::fixed << std::setprecision(5);
    const double shares[6][3] = {{0, 0, 0.4},
                                 {1, 0, 1.9},
                                 {1, 1, 0.8},
                                 {0, 1, 2.1},
                                 {0.5, 0.5, 1.5},
                                 {0.2, 0.8, 0.6}};
    for (int p = 0; p < 6; ++p) {
      const std::string name = "T" + std::to_string(p + 1);
      const Eigen::Vector3d point(low.x() + shares[p][0] * (high.x() - low.x()),
                                  low.y() + shares[p][1] * (high.y() - low.y()),
                                  shares[p][2]);
      Eigen::Vector3d known = T_control_world * point + noise(random, kSigma);
      if (name == "T3")
        known += Eigen::Vector3d(0.05, -0.03, 0.01);
      control << name << ',' << known.x() << ',' << known.y() << ',' << known.z() << ','
              << kSigma << '\n';
      for (const std::size_t scan : nearest(truth, point)) {
        const Eigen::Vector3d seen =
            truth[scan].inverse() * point + noise(random, kSigma);
        targets << name << ",scan" << std::setw(3) << std::setfill('0') << scan << ','
                << seen.x() << ',' << seen.y() << ',' << seen.z() << '\n';
      }
    }
  }

  /** \return the three nearest scans */
  static std::vector<std::size_t>
  nearest(const std::vector<Eigen::Isometry3d>& truth, const Eigen::Vector3d& point)
  {
    std::vector<std::pair<double, std::size_t>> scans;
    for (std::size_t i = 0; i < truth.size(); ++i)
      scans.emplace_back((truth[i].translation() - point).norm(), i);
    std::sort(scans.begin(), scans.end());
    return {scans[0].second, scans[1].second, scans[2].second};
  }

  std::filesystem::path folder_;
  std::vector<Eigen::Isometry3d> truth_;
};

} // namespace pcl6d::test

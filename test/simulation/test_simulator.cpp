// SPDX-License-Identifier: BSD-3-Clause
#include <pcl6d/common/error.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/scanner/driven_scanner.h>
#include <pcl6d/simulation/simulator.h>

#include <gtest/gtest.h>

#include <cstring>

namespace {
using pcl6d::SimulationOptions;
using pcl6d::Simulator;

Simulator
corridor(const SimulationOptions& options = {})
{
  return Simulator(pcl6d::builtInScene("corridor"), options);
}

double
positionRms(const Simulator& simulator)
{
  double sum_sq = 0;
  for (std::size_t i = 0; i < simulator.size(); ++i)
    sum_sq += (simulator.truth().poses[i].translation() -
               simulator.odometry().poses[i].translation())
                  .squaredNorm();
  return std::sqrt(sum_sq / static_cast<double>(simulator.size()));
}

bool
sameBytes(const pcl::PointCloud<pcl::PointXYZI>& a,
          const pcl::PointCloud<pcl::PointXYZI>& b)
{
  if (a.size() != b.size())
    return false;
  for (std::size_t i = 0; i < a.size(); ++i) {
    const float left[] = {a[i].x, a[i].y, a[i].z, a[i].intensity};
    const float right[] = {b[i].x, b[i].y, b[i].z, b[i].intensity};
    if (std::memcmp(left, right, sizeof left) != 0)
      return false;
  }
  return true;
}
} // namespace

TEST(Simulator, StartsBothTrajectoriesAtTheSamePose)
{
  const Simulator simulator = corridor();
  ASSERT_EQ(simulator.size(), 40u);
  ASSERT_EQ(simulator.odometry().poses.size(), 40u);
  EXPECT_EQ(simulator.truth().poses[0].matrix(), Eigen::Matrix4d::Identity());
  EXPECT_EQ(simulator.odometry().poses[0].matrix(), Eigen::Matrix4d::Identity());
}

TEST(Simulator, DrivesARoundInEvenSteps)
{
  const Simulator simulator = corridor();
  const auto& poses = simulator.truth().poses;
  double height = 0;
  for (std::size_t i = 0; i < poses.size(); ++i) {
    const auto step = pcl6d::distanceBetween(poses[i], poses[(i + 1) % poses.size()]);
    EXPECT_LT(step.translation, 1.5)
        << "scan " << i; // from the last one to the first too
    EXPECT_GT(step.translation, 1.0) << "scan " << i; // bends are cut short
    height = std::max(height, poses[i].translation().z());
  }
  EXPECT_GT(height, 0.5);
}

TEST(Simulator, OdometryDriftsByOneToTwoMetres)
{
  EXPECT_GT(positionRms(corridor()), 1.0); // [m] with the default seed
  for (std::uint64_t seed = 1; seed <= 20; ++seed) {
    SimulationOptions options;
    options.seed = seed;
    const Simulator simulator = corridor(options);
    EXPECT_GT(positionRms(simulator), 0.5) << "seed " << seed;
    EXPECT_LT(positionRms(simulator), 2.0) << "seed " << seed;
    const auto& truth = simulator.truth().poses;
    const auto& odometry = simulator.odometry().poses;
    for (std::size_t i = 1; i < truth.size(); ++i) {
      const auto error = pcl6d::distanceBetween(
          truth[i - 1].inverse() * truth[i], odometry[i - 1].inverse() * odometry[i]);
      EXPECT_LT(error.translation, 0.2) << "seed " << seed << ", scan " << i;
      // 6.7 deg are the ramp, which the odometry cannot see.
      EXPECT_LT(error.rotation, 8 * M_PI / 180) << "seed " << seed << ", scan " << i;
    }
  }
}

TEST(Simulator, PointsMovedByTheTruthLieOnTheirSurfaces)
{
  SimulationOptions options;
  options.num_scans = 8;
  options.range.noise = 0.01;
  const Simulator simulator = corridor(options);
  const auto& scene = simulator.caster().scene();
  double sum_sq = 0;
  double count = 0;
  for (std::size_t i = 0; i < simulator.size(); ++i) {
    const auto scan = simulator.rangeScan(i);
    const auto cloud = simulator.scan(i);
    const Eigen::Isometry3d T_scene_scan =
        simulator.sceneFromWorld() * simulator.truth().poses[i];
    for (std::size_t k = 0; k < cloud.size(); ++k) {
      if (!std::isfinite(cloud[k].x))
        continue;
      const auto triangle = scan.samples[k].triangle;
      const Eigen::Vector3d p = T_scene_scan * cloud[k].getVector3fMap().cast<double>();
      const double off = scene.normal(triangle).dot(p - scene.corner(triangle, 0));
      // Noise acts along the ray: 6 sigma at most among 350 000 samples, plus float.
      ASSERT_LT(std::abs(off), 6 * options.range.noise + 1e-5);
      sum_sq += off * off;
      ++count;
    }
  }
  EXPECT_GT(count, 0.95 * 8 * 360 * 121);
  EXPECT_LT(std::sqrt(sum_sq / count), options.range.noise); // cosines below one
  EXPECT_GT(std::sqrt(sum_sq / count), 0.5 * options.range.noise);
}

TEST(Simulator, HasTheSameBytesForEveryThreadCount)
{
  SimulationOptions options;
  options.num_scans = 3;
  options.range.num_threads = 1;
  const Simulator expected = corridor(options);
  for (const unsigned threads : {2u, 8u}) {
    options.range.num_threads = threads;
    const Simulator simulator = corridor(options);
    for (std::size_t i = 0; i < 3; ++i) {
      EXPECT_TRUE(sameBytes(simulator.scan(i), expected.scan(i)));
      EXPECT_EQ(simulator.odometry().poses[i].matrix(),
                expected.odometry().poses[i].matrix());
    }
  }
}

TEST(Simulator, HasOtherNoiseForAnotherSeed)
{
  SimulationOptions options;
  options.num_scans = 2;
  const Simulator first = corridor(options);
  options.seed = 2;
  const Simulator second = corridor(options);
  EXPECT_FALSE(sameBytes(first.scan(0), second.scan(0)));
  EXPECT_NE(first.odometry().poses[1].matrix(), second.odometry().poses[1].matrix());
  EXPECT_EQ(first.truth().poses[1].matrix(), second.truth().poses[1].matrix());
}

TEST(Simulator, TakesAnyScanner)
{
  SimulationOptions options;
  options.num_scans = 1;
  options.scanner = std::make_shared<pcl6d::DrivenScanner>(pcl6d::pitchingScanner());
  const auto cloud = corridor(options).scan(0);
  EXPECT_EQ(cloud.width, 181u);
  EXPECT_EQ(cloud.height, 241u);
}

TEST(Simulator, RefusesBrokenOptions)
{
  SimulationOptions options;
  options.num_scans = 0;
  EXPECT_THROW(corridor(options), pcl6d::BadArgument);
  options.num_scans = 100001;
  EXPECT_THROW(corridor(options), pcl6d::BadArgument);
  options = {};
  options.range.noise = -1;
  EXPECT_THROW(corridor(options), pcl6d::BadArgument);
  options = {};
  options.num_scans = 2;
  EXPECT_THROW(corridor(options).scan(2), pcl6d::BadArgument);
}

// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d on scans whose points lie far from the origin of their coordinates.
#include "support/run_program.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/io/far_points.h>
#include <pcl6d/io/pcd_io.h>
#include <pcl6d/io/scan_fields.h>
#include <pcl6d/io/scan_folder.h>
#include <pcl6d/io/scan_name.h>
#include <pcl6d/io/trajectory_io.h>
#include <pcl6d/run/run_summary.h>

#include <gtest/gtest.h>

#include <fstream>
#include <iomanip>

namespace {
namespace fs = std::filesystem;
using namespace pcl6d;
using pcl6d::test::Outcome;
using pcl6d::test::runProgram;
using pcl6d::test::TempFolder;

const Eigen::Vector3d kUtm(512345, 5403210, 317);
const Eigen::Vector3d kOff(1000, 0, 0);
const Eigen::Vector3d kNone(0, 0, 0);
using Poses = std::vector<Eigen::Isometry3d>;

/** The start of a drive, and a run over it. */
class Far : public testing::Test {
protected:
  static constexpr int kScans = 5;

  static void
  SetUpTestSuite()
  {
    folder_ = new TempFolder;
    ASSERT_EQ(runProgram("pcl_slam6d_simulate",
                         {"corridor",
                          "-o",
                          at("drive"),
                          "--scans",
                          "30",
                          "--resolution",
                          "2",
                          "--quiet"})
                  .exit_code,
              0);
    const ScanFolder drive(at("drive"));
    for (int i = 0; i < kScans; ++i) {
      scans().push_back(drive.read(static_cast<std::size_t>(i)).points);
      odometry().push_back(drive.initialPose(static_cast<std::size_t>(i)));
    }
    write("near", {}, kNone, odometry());
    ASSERT_EQ(slam("near").exit_code, 0);
    near() = finalPoses("near");
  }
  static void
  TearDownTestSuite()
  {
    delete folder_;
    folder_ = nullptr;
  }

  static std::string
  at(const std::string& name)
  {
    return (*folder_ / name).string();
  }
  static std::vector<Points>&
  scans()
  {
    static std::vector<Points> points;
    return points;
  }
  static Poses&
  odometry()
  {
    static Poses poses;
    return poses;
  }
  static Poses&
  near()
  {
    static Poses poses;
    return poses;
  }

  /** Writes the scans as text, each moved by its T, on a grid of a millimetre that float and
   * double tell without rounding, and moved by whole metres. */
  static void
  write(const std::string& name,
        const Poses& T,
        const Eigen::Vector3d& offset,
        const Poses& poses)
  {
    fs::create_directories(at(name));
    for (std::size_t i = 0; i < scans().size(); ++i) {
      std::ofstream file(at(name) + '/' + scanName(static_cast<int>(i)) + ".xyz");
      file << std::setprecision(17);
      for (const auto& p : scans()[i]) {
        Eigen::Vector3d q = T.empty() ? p.cast<double>() : T[i] * p.cast<double>();
        q = Eigen::Vector3d((1024 * q).array().round() / 1024) + offset;
        file << q.x() << ' ' << q.y() << ' ' << q.z() << '\n';
      }
    }
    if (!poses.empty())
      writeTrajectoryKitti(at(name) + "/odometry.txt", {poses, {}});
  }

  static Outcome
  slam(const std::string& name, std::vector<std::string> options = {})
  {
    options.insert(options.begin(),
                   {at(name), "-o", at("run_" + name), "--no-picture"});
    return runProgram("pcl_slam6d", options);
  }
  static RunResult
  summary(const std::string& name)
  {
    return readRunSummary(fs::path(at("run_" + name)) / "summary.json");
  }
  static Poses
  finalPoses(const std::string& name)
  {
    Poses poses;
    for (const auto& scan : summary(name).scans)
      poses.push_back(scan.T_world_scan);
    return poses;
  }
  static Poses
  trajectory(const std::string& name)
  {
    return readTrajectory(at("run_" + name) + "/trajectory.kitti").poses;
  }

  /** Expects the poses of the run over the near scans, with near points moved back. */
  static void
  expectNearPoses(const std::string& name, double tolerance)
  {
    const RunResult run = summary(name);
    ASSERT_TRUE(run.moved);
    for (std::size_t i = 0; i < near().size(); ++i) {
      // The middle of the points is not where the scanner stood: near points are q - rest.
      const Eigen::Isometry3d T =
          run.scans[i].T_world_scan * Eigen::Translation3d(kRest - run.moved->offset);
      EXPECT_LT((T.translation() - near()[i].translation()).norm(), tolerance) << i;
      EXPECT_TRUE(T.linear().isApprox(near()[i].linear(), tolerance)) << i;
    }
  }

  static inline Eigen::Vector3d kRest =
      Eigen::Vector3d::Zero(); ///< offset in the files
  static TempFolder* folder_;
};
TempFolder* Far::folder_ = nullptr;
} // namespace

// Near points differ by a whole metre from those of the scanner's frame at most, which moves
// the ranges that are taken, so the same poses within what a registration of them varies by.
TEST_F(Far, AnOffsetOfThePointsChangesNoPose)
{
  for (const auto& [name, offset] :
       {std::pair{std::string("utm"), kUtm}, {std::string("off"), kOff}}) {
    write(name, {}, offset, odometry());
    const Outcome outcome = slam(name);
    ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
    EXPECT_NE(outcome.err.find(" km from the origin of their coordinates: moved by (-"),
              std::string::npos)
        << outcome.err;
    EXPECT_EQ(summary(name).moved->reading, PoseReading::kScanner);
    kRest = offset;
    expectNearPoses(name, 0.02);
    // Trajectories mean what the odometry meant.
    EXPECT_TRUE(trajectory(name)[3].isApprox(finalPoses(name)[3], 1e-12));
  }
}

TEST_F(Far, PosesOfThePointsInTheFilesKeepTheirMeaning)
{
  Poses given;
  for (const auto& pose : odometry())
    given.push_back(pose * Eigen::Translation3d(-kUtm));
  write("file", {}, kUtm, given);
  const Outcome outcome = slam("file");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_EQ(summary("file").moved->reading, PoseReading::kFile);
  kRest = kUtm;
  expectNearPoses("file", 0.02);
  for (std::size_t i = 0; i < scans().size(); ++i) { // T p with p as in the file
    const Eigen::Vector3d p = scans()[i][7].cast<double>();
    EXPECT_LT((trajectory("file")[i] * (p + kUtm) - near()[i] * p).norm(), 0.1);
  }
  // The same files and that trajectory: the same map.
  const Outcome verified = runProgram(
      "pcl_slam6d_evaluate",
      {"verify", at("file"), "--poses", at("run_file") + "/trajectory.kitti"});
  EXPECT_EQ(verified.exit_code, 0) << verified.out << verified.err;
}

TEST_F(Far, PointsInTheWorldOfTheirStationsAreTakenBack)
{
  Poses stations;
  for (const auto& pose : odometry())
    stations.push_back(Eigen::Translation3d(kUtm) * pose);
  write("stations", odometry(), kUtm, stations);
  const Outcome outcome = slam("stations");
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(
      outcome.err.find("points lie 5427.4 km from the origin of their coordinates, "
                       "in the world of their poses (odometry.txt): taken back into "
                       "the frames of the scanner"),
      std::string::npos)
      << outcome.err;
  const RunResult run = summary("stations");
  EXPECT_EQ(run.moved->reading, PoseReading::kStation);
  EXPECT_EQ(run.world_offset, kUtm);
  for (std::size_t i = 0; i < scans().size(); ++i)
    EXPECT_LT((run.scans[i].T_world_scan.translation() - kUtm - near()[i].translation())
                  .norm(),
              0.03);
}

// A room in the world, without poses: the law is exact, as near points are the same floats.
TEST_F(Far, WithoutPosesTheMoveIsAllThatDiffers)
{
  write("probe", odometry(), kNone, {});
  const Eigen::Vector3d middle =
      placeOf(ScanFolder(at("probe")).readCloud(0).cloud)->middle.array().round();
  write("world", odometry(), -middle, {});
  write("utm_world", odometry(), kUtm - middle, {});
  const std::vector<std::string> options = {"--initial-guess", "odometry"};
  const Outcome outcome = slam("utm_world", options);
  EXPECT_EQ(outcome.exit_code, slam("world", options).exit_code) << outcome.err;
  const RunResult run = summary("utm_world");
  EXPECT_EQ(run.moved->offset, kUtm);
  EXPECT_EQ(run.world_offset, kUtm);
  const Poses expected = finalPoses("world");
  for (std::size_t i = 0; i < expected.size(); ++i)
    EXPECT_LT(
        (run.scans[i].T_world_scan.translation() - kUtm - expected[i].translation())
            .norm(),
        1e-6);
}

TEST_F(Far, ARunGoesOnWithFurtherScans)
{
  write("more", {}, kUtm, odometry());
  ASSERT_EQ(slam("more", {"--last", "3"}).exit_code, 0);
  const Outcome outcome = runProgram(
      "pcl_slam6d", {at("more"), "--continue", at("run_more"), "--no-picture"});
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  const RunResult run = summary("more");
  ASSERT_EQ(run.scans.size(), 5U);
  ASSERT_TRUE(run.moved);
  for (std::size_t i = 0; i < 5; ++i) {
    const fs::path file =
        fs::path(at("run_more")) / "scans" / (scanName(int(i)) + ".pcd");
    EXPECT_LT(coordinatesOf(readPcd(file))[0].norm(), 100) << i;
  }
}

TEST_F(Far, ConversionsLeavePointsWhereTheyAre)
{
  write("kept", {}, kUtm, odometry());
  const Outcome outcome = runProgram(
      "pcl_slam6d_convert", {"scans", at("kept"), "-o", at("pcd"), "--format", "pcd"});
  ASSERT_EQ(outcome.exit_code, 0) << outcome.err;
  ScanFolderOptions options;
  options.keep_coordinates = true;
  const ScanFolder folder(at("pcd"), options);
  const auto x = *fieldValues(folder.readCloud(1).cloud, "x");
  for (std::size_t i = 0; i < x.values.size(); i += 100)
    EXPECT_NEAR(x.values[i], static_cast<double>(scans()[1][i].x()) + kUtm.x(), 5e-4);

  EXPECT_LT((folder.initialPose(1).translation() - odometry()[1].translation()).norm(),
            1e-12);
}

// SPDX-License-Identifier: BSD-3-Clause
// Sweeps with times, corrected for the motion within by a driver or a recorder.
#include "apps/support/corridor_run.h"
#include "odometry/corridor_sweeps.h"

#include <pcl6d/io/scan_name.h>
#include <pcl6d/io/trajectory_io.h>

#include <nlohmann/json.hpp>

#include <fstream>

namespace {
namespace fs = std::filesystem;
using pcl6d::Sweep;
using pcl6d::test::CorridorSweeps;
using pcl6d::test::Outcome;
using pcl6d::test::readText;
using pcl6d::test::slam;
using pcl6d::test::TempFolder;

constexpr std::size_t kCount = 72; // two votes of MotionEvidence

/** Writes points with the field t. */
void
writeSweep(const fs::path& file, const Sweep& sweep)
{
  std::ofstream out(file, std::ios::binary);
  out << "VERSION 0.7\nFIELDS x y z t\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 "
         "1\nWIDTH "
      << sweep.points.size() << "\nHEIGHT 1\nPOINTS " << sweep.points.size()
      << "\nDATA binary\n";
  for (std::size_t i = 0; i < sweep.points.size(); ++i) {
    const Eigen::Vector4f point(sweep.points[i].x(),
                                sweep.points[i].y(),
                                sweep.points[i].z(),
                                static_cast<float>(sweep.times[i]));
    out.write(reinterpret_cast<const char*>(point.data()), sizeof(point));
  }
}

/** Writes a drive of corrected sweeps with their times and stamps. */
void
writeDrive(const fs::path& folder)
{
  CorridorSweeps corridor;
  fs::create_directory(folder);
  std::ofstream stamps(folder / "times.txt");
  std::size_t i = 0;
  for (Sweep sweep : corridor.drive(kCount)) {
    pcl6d::test::takeMotionOut(sweep);
    writeSweep(folder / (pcl6d::scanName(static_cast<int>(i++)) + ".pcd"), sweep);
    stamps << *sweep.stamp << '\n';
  }
}

/** \return [m] the largest distance of a pose from the truth */
double
largestError(const fs::path& run)
{
  const auto found = pcl6d::readTrajectory(run / "trajectory.tum").poses;
  EXPECT_EQ(found.size(), kCount);
  double largest = 0;
  for (std::size_t i = 0; i < found.size(); ++i) {
    const auto truth = CorridorSweeps::poseAt(0).inverse() *
                       CorridorSweeps::poseAt(0.1 * static_cast<double>(i));
    largest = std::max(
        largest,
        pcl6d::distanceBetween(truth, found[0].inverse() * found[i]).translation);
  }
  return largest;
}
} // namespace

TEST(CorrectedSweeps, AreNotCorrectedAgain)
{
  const TempFolder folder;
  writeDrive(folder / "in");
  const std::vector<std::string> quick = {"--no-verification", "--no-picture"};
  const Outcome outcome = slam(folder / "in", folder / "out", quick);
  EXPECT_EQ(outcome.exit_code, 0) << outcome.err;
  EXPECT_NE(outcome.err.find("the motion within the sweeps is corrected already"),
            std::string::npos)
      << outcome.err;
  EXPECT_EQ(outcome.err.find("motion during a scan is corrected"), std::string::npos);
  EXPECT_EQ(nlohmann::json::parse(readText(folder / "out/summary.json"))["pose_source"],
            "tracking in the order of the files (0 of 72 scans lost), the motion "
            "within the sweeps corrected already");
  EXPECT_LT(largestError(folder / "out"), 0.02);
}

TEST(CorrectedSweeps, AreTakenAsTheWordOfDeskewTells)
{
  const TempFolder folder;
  writeDrive(folder / "in");
  std::vector<std::string> options = {
      "--no-verification", "--no-picture", "--deskew", "no"};
  const Outcome as_rigid = slam(folder / "in", folder / "no", options);
  EXPECT_EQ(as_rigid.err.find("corrected"), std::string::npos) << as_rigid.err;
  EXPECT_LT(largestError(folder / "no"), 0.02);
  options.back() = "odometry";
  const Outcome as_moving = slam(folder / "in", folder / "moving", options);
  EXPECT_NE(as_moving.err.find("motion during a scan is corrected"), std::string::npos)
      << as_moving.err;
}

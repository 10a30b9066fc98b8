// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d_convert scans --full: runs and folders joined.
#include "apps/convert/convert_test.h"
#include "support/poses.h"
#include "support/sanitizer.h"

#include <pcl6d/io/scan_reader.h>
#include <pcl6d/io/trajectory_io.h>
#include <pcl6d/run/run_summary.h>

#include <sys/resource.h>

namespace fs = std::filesystem;
using pcl6d::test::cloudOf;
using pcl6d::test::converted;
using pcl6d::test::expectConvertError;
using pcl6d::test::floatOf;
using pcl6d::test::TempFolder;

namespace {
const Eigen::Vector3d kOffset(691234, 5336789, 100); // [m]

/** \brief The folder of a run of two scans with a large world offset. */
struct RunFolder : TempFolder {
  RunFolder()
  {
    pcl6d::Random random(2);
    pcl6d::RunResult summary;
    summary.generator = "pcl_slam6d";
    summary.world_offset = kOffset;
    summary.options = {{"min-range", "0.5", "derived", ""},
                       {"max-range", "30", "derived", ""}};
    fs::create_directories(folder / "scans");
    for (int i = 0; i < 2; ++i) {
      poses.push_back(pcl6d::test::randomPose(random, 100, 2));
      scans.push_back({1.f + static_cast<float>(i),
                       2,
                       3,
                       0.5f,
                       0,
                       0,
                       1,
                       0.1f,
                       0,
                       0,
                       0.25f,
                       0,
                       0,
                       1, // nearer than min-range
                       -4,
                       5,
                       6,
                       1,
                       0,
                       1,
                       0,
                       NAN,
                       0,
                       0,
                       0,
                       0,
                       0,
                       1,
                       40,
                       0,
                       0,
                       0,
                       0,
                       0,
                       1});    // farther than max-range
      const int index = 3 * i; // of a run with --every 3
      const std::string file = "scan00" + std::to_string(index) + ".pcd";
      pcl6d::writePcd(folder / "scans" / file, cloudOf(kNames, scans.back()), poses[i]);
      summary.scans.emplace_back();
      summary.scans.back().file = "raw" + file;
      summary.scans.back().index = index;
      summary.scans.back().T_world_scan = poses[i];
      summary.scans.back().T_world_scan.translation() += kOffset;
    }
    writeRunSummary(folder / "summary.json", summary);
  }

  const std::vector<std::string> kNames =
      {"x", "y", "z", "intensity", "normal_x", "normal_y", "normal_z"};
  const fs::path folder = *this / "a run";
  std::vector<Eigen::Isometry3d> poses; ///< relative to the offset
  std::vector<std::vector<float>> scans;
};

/** Expects the two surface points of each scan at their places. */
void
expectMap(const RunFolder& run, const pcl::PCLPointCloud2& map, bool all_fields)
{
  ASSERT_EQ(map.width, 4u);
  for (std::size_t i = 0; i < 4; ++i) {
    const std::size_t scan = i / 2, point = i % 2 ? 2 : 0;
    const float* const value = &run.scans[scan][7 * point];
    const Eigen::Vector3d place =
        run.poses[scan] * Eigen::Vector3f(value).cast<double>();
    const Eigen::Vector3d normal =
        run.poses[scan].linear() * Eigen::Vector3f(value + 4).cast<double>();
    for (int axis = 0; axis < 3; ++axis) {
      const std::string name(1, "xyz"[axis]);
      EXPECT_EQ(floatOf(map, i, name), static_cast<float>(place[axis]));
      if (all_fields) {
        EXPECT_EQ(floatOf(map, i, "normal_" + name), static_cast<float>(normal[axis]));
      }
    }
    if (!all_fields)
      continue;
    EXPECT_EQ(floatOf(map, i, "intensity"), value[3]);
    const float index = floatOf(map, i, "scan"); // its bits are a uint32
    std::uint32_t bits = 0;
    std::memcpy(&bits, &index, sizeof bits);
    EXPECT_EQ(bits, 3 * scan);
  }
}
} // namespace

TEST(ConvertFull, JoinsTheScansOfARunInEveryFormat)
{
  const RunFolder run;
  for (const std::string file :
       {"map.ply", "map.pcd", "map.xyz", "map.bin", "map.3d"}) {
    SCOPED_TRACE(file);
    const std::string out =
        converted({"scans", run.folder, "-o", run / file, "--full", "--quiet"});
    EXPECT_EQ(out.rfind("2 scans, 4 points: pcd to ", 0), 0u) << out;
    EXPECT_NE(
        out.find(
            "\nposes from the run\nworld_offset 691234 5336789 100: subtracted from "
            "every point [m]\ndropped 4 points outside the ranges of the run, 0.5 to "
            "30 m\ndropped 2 points with an x, y or z that is not finite\n"),
        std::string::npos)
        << out;
    expectMap(
        run, pcl6d::readScan(run / file).cloud, file == "map.ply" || file == "map.pcd");
  }
}

TEST(ConvertFull, OfScansWithSeveralFieldsTheCommonOnesStay)
{
  const TempFolder folder;
  fs::create_directory(folder / "in");
  const std::string in = folder / "in", map = folder / "map.pcd";
  pcl6d::writePcd(folder / "in/a.pcd", cloudOf({"x", "y", "z", "scan"}, {1, 2, 3, 9}));
  pcl6d::writePcd(folder / "in/b.pcd",
                  cloudOf({"intensity", "scan", "z", "y", "x"}, {7, 9, 6, 5, 4}));
  EXPECT_EQ(converted({"scans", in, "-o", map, "--full", "--quiet"}),
            "2 scans, 2 points: pcd to pcd\n"
            "poses from identity\n"
            "world_offset 0 0 0: subtracted from every point [m]\n"
            "dropped field 'intensity', missing or different in a scan\n"
            "replaced field 'scan' by the index of the scan\n");
  const auto read = pcl6d::readPcd(map);
  ASSERT_EQ(read.fields.size(), 4u);
  EXPECT_EQ(floatOf(read, 1, "x"), 4);
  EXPECT_EQ(floatOf(read, 1, "z"), 6);
}

TEST(ConvertFull, PosesFarAwayGiveAWorldOffset)
{
  const TempFolder folder;
  fs::create_directory(folder / "in");
  pcl6d::test::writeText(folder / "in/a.xyz", "0.125 0 0\n");
  pcl6d::test::writeText(folder / "in/poses.txt",
                         "1 0 0 691234.25 0 1 0 5336789 0 0 1 100\n");
  const std::string in = folder / "in", map = folder / "map.xyz";
  const std::string out = converted({"scans", in, "-o", map, "--full"});
  EXPECT_NE(out.find("world_offset 691234 5336789 100"), std::string::npos) << out;
  EXPECT_EQ(pcl6d::test::readText(map), "0.375 0 0\n");
}

TEST(ConvertFull, TheScansOfARunGetTheirFullCoordinates)
{
  const RunFolder run;
  const std::string out = run / "out";
  converted({"scans", run.folder, "-o", out, "--format", "kitti"});
  const auto trajectory = pcl6d::readTrajectory(run / "out/poses.txt");
  ASSERT_EQ(trajectory.poses.size(), 2u);
  for (std::size_t i = 0; i < 2; ++i)
    EXPECT_LT((trajectory.poses[i].translation() - run.poses[i].translation() - kOffset)
                  .norm(),
              1e-8); // of 5e6 m
}

TEST(ConvertFull, RunsThatHoldNoScansAreNamed)
{
  const RunFolder run;
  const std::string map = run / "map.ply";
  const auto full = [&](std::vector<std::string> more = {}) {
    std::vector<std::string> arguments = {"scans", run.folder, "-o", map, "--full"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return arguments;
  };
  expectConvertError(full({"--poses", "x"}), 2, {"--poses = x", "poses of its own"});
  expectConvertError(
      {"scans", run.folder, "-o", run.folder / "scans/scan000.pcd", "--full"},
      2,
      {"is an input"});
  const std::string summary = pcl6d::test::readText(run.folder / "summary.json");
  pcl6d::test::writeText(run.folder / "summary.json", "{}");
  expectConvertError(full(), 1, {"summary.json", "schema_version"});
  pcl6d::test::writeText(run.folder / "summary.json", summary);
  fs::copy(run.folder / "scans/scan000.pcd", run.folder / "scans/scan001.pcd");
  expectConvertError(full(), 1, {"scan001.pcd", "lacks the scan"});
  fs::remove_all(run.folder / "scans");
  expectConvertError(full(), 1, {"a run", "interrupted", "no scans"});
  EXPECT_FALSE(fs::exists(map));
}

TEST(ConvertFull, TakesTheMemoryOfOneScan)
{
  if (pcl6d::test::isUnderAddressSanitizer())
    GTEST_SKIP() << "the address sanitizer keeps freed memory";
  const TempFolder folder;
  fs::create_directory(folder / "in");
  const std::vector<float> values(4 * 250000, 1.5f); // 4 MB
  const std::string first = folder / "in/scan00.pcd";
  pcl6d::writePcd(first,
                  cloudOf({"x", "y", "z", "intensity"}, values),
                  Eigen::Isometry3d::Identity(),
                  pcl6d::PcdEncoding::kBinary);
  const auto join = [&](const std::string& map) {
    converted({"scans", folder / "in", "-o", folder / map, "--full", "--quiet"});
    rusage usage{};
    ::getrusage(RUSAGE_CHILDREN, &usage); // of the largest child so far
    return usage.ru_maxrss / 1024.0;      // [MB]
  };
  for (const std::string map : {"map.ply", "map.pcd", "map.xyz"}) {
    const double one = join(map);
    for (int i = 1; i < 16; ++i)
      fs::create_hard_link(first,
                           folder / ("in/scan" + std::to_string(i + 10) + ".pcd"));
    EXPECT_LT(join(map), one + 8) << map;                      // all of them have 64 MB
    EXPECT_GE(fs::file_size(folder / map), 16u * 250000 * 12); // it has all points
    for (int i = 1; i < 16; ++i)
      fs::remove(folder / ("in/scan" + std::to_string(i + 10) + ".pcd"));
  }
}

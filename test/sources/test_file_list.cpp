// SPDX-License-Identifier: BSD-3-Clause
// Several files as one run, PTX among them.
#include "sources/made_e57.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/pcd_io.h>
#include <pcl6d/io/scan_reader.h>
#include <pcl6d/sources/file_list_source.h>
#include <pcl6d/sources/open_source.h>

#include <gtest/gtest.h>

namespace {

using namespace pcl6d::test;
using pcl6d::FileListSource;
using pcl6d::openScanFiles;

namespace fs = std::filesystem;

const std::string kPtxRotation = "1 0 0\n0 1 0\n0 0 1\n1 0 0 0\n0 1 0 0\n0 0 1 0\n";

/** \return a scan of PTX with one point (a, 0, 0), moved by x */
std::string
ptxAt(double x, double a)
{
  const std::string t = std::to_string(x) + " 0 0";
  return "1\n1\n" + t + "\n" + kPtxRotation + t + " 1\n" + std::to_string(a) +
         " 0 0 0.5\n";
}

class FileList : public testing::Test {
protected:
  FileList()
  {
    MadeScan lobby = scanOfPoints({{1, 0, 0}, {0, 2, 0}});
    lobby.about =
        "<name type=\"String\">Lobby</name><pose type=\"Structure\"><translation "
        "type=\"Structure\"><x type=\"Float\">7</x></translation></pose>";
    makeE57(e57_, {lobby});
    writeText(ptx_, ptxAt(0, 3) + ptxAt(2, 4));
    writeText(xyz_, "1 2 3\n4 5 6\n7 8 9\n");
  }

  /** Writes a scan with its pose. */
  fs::path
  pcdAt(const std::string& name, double x)
  {
    pcl6d::writePcd(folder_ / name,
                    pcl6d::readScan(xyz_).cloud,
                    Eigen::Isometry3d(Eigen::Translation3d(x, 0, 0)));
    return folder_ / name;
  }

  TempFolder folder_;
  const fs::path e57_ = folder_ / "a.e57", ptx_ = folder_ / "b.ptx",
                 xyz_ = folder_ / "c.xyz";
};

TEST_F(FileList, ScansComeInTheOrderGiven)
{
  const FileListSource source({xyz_, ptx_, e57_});
  std::vector<std::string> names;
  for (const auto& scan : source.scans())
    names.push_back(scan.name);
  EXPECT_EQ(names, (std::vector<std::string>{"c.xyz", "b_000", "b_001", "Lobby"}));
  EXPECT_EQ(source.format(), "xyz, ptx, e57");
  EXPECT_EQ(source.read(0).cloud.width, 3U);
  EXPECT_EQ(source.read(2).cloud.width, 1U);
  EXPECT_EQ(source.fileOf(2), ptx_);
  EXPECT_EQ(source.titleOf(0), xyz_.string());
  EXPECT_EQ(source.titleOf(2), ptx_.string() + ": scan 1 (b_001)");
  EXPECT_THROW(source.read(4), pcl6d::BadArgument);
}

TEST_F(FileList, PosesOfAllFilesAreKept)
{
  const auto scans = openScanFiles({ptx_, e57_, pcdAt("d.pcd", 0), pcdAt("e.pcd", 5)});
  std::vector<double> x;
  for (std::size_t i = 0; i < scans.size(); ++i)
    x.push_back(scans.initialPose(i).translation().x());
  EXPECT_EQ(
      x, (std::vector<double>{0, 2, 7, 0, 5})); // d.pcd: identity, as e.pcd has a pose
  EXPECT_EQ(scans.poseSource(), "the files");
  EXPECT_TRUE(scans.hasPoses());
  EXPECT_EQ(scans.note(), "");
  EXPECT_EQ(scans.read(1).points, (pcl6d::Points{{4, 0, 0}}));
}

TEST_F(FileList, PosesOfSomeFilesAreNotUsedAndThatIsSaid)
{
  const auto scans = openScanFiles({xyz_, ptx_});
  EXPECT_FALSE(scans.hasPoses());
  EXPECT_EQ(scans.note(),
            "poses of the files are not used: b_000 has one, but c.xyz has no pose; "
            "--poses FILE gives a pose for each scan");
  pcl6d::ScanFolderOptions options;
  options.poses_file = folder_ / "given.txt";
  std::string rows;
  for (int i = 0; i < 3; ++i)
    rows += "1 0 0 " + std::to_string(i) + " 0 1 0 0 0 0 1 0\n";
  writeText(options.poses_file, rows);
  const auto given = openScanFiles({xyz_, ptx_}, options);
  EXPECT_EQ(given.initialPose(2).translation().x(), 2);
  EXPECT_EQ(given.note(), "");
}

TEST_F(FileList, APoseThatIsTheIdentityEverywhereIsNone)
{
  const auto scans = openScanFiles({pcdAt("d.pcd", 0), xyz_, pcdAt("e.pcd", 0)});
  EXPECT_FALSE(scans.hasPoses());
  EXPECT_EQ(scans.note(), "");
}

TEST_F(FileList, EqualNamesGetTheirNumber)
{
  fs::create_directory(folder_ / "other");
  fs::copy(xyz_, folder_ / "other/c.xyz");
  const FileListSource source({xyz_, folder_ / "other/c.xyz", xyz_});
  EXPECT_EQ(source.scans()[0].name, "c.xyz");
  EXPECT_EQ(source.scans()[1].name, "c.xyz (1)");
  EXPECT_EQ(source.scans()[2].name, "c.xyz (2)");
}

TEST_F(FileList, PointsLeftOutTwiceAreCountedOnce)
{
  // Far points are moved when they are read: (0, 0, 0) becomes a missing return then.
  writeText(
      folder_ / "far.xyz",
      "500000 5400000 300\n0 0 0\nnan 0 0\n500001 5400001 301\n500002 5400000 300\n");
  const auto scans = openScanFiles({folder_ / "far.xyz", folder_ / "far.xyz"});
  const auto scan = scans.read(1);
  EXPECT_EQ(scan.points.size(), 3U);
  EXPECT_EQ(scan.dropped, 2U);
}

TEST_F(FileList, WhatCannotBeAScanIsNamed)
{
  const auto message = [](const std::vector<fs::path>& files) {
    try {
      openScanFiles(files);
    } catch (const std::exception& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  fs::create_directory(folder_ / "folder");
  EXPECT_EQ(message({xyz_, folder_ / "folder"}),
            (folder_ / "folder").string() +
                ": is a folder, but several inputs are given: each must be a file");
  EXPECT_EQ(message({xyz_, folder_ / "none.pcd"}),
            (folder_ / "none.pcd").string() + ": No such file or directory");
  writeText(folder_ / "a.dxf", "1 2 3\n");
  EXPECT_EQ(message({xyz_, folder_ / "a.dxf"}),
            (folder_ / "a.dxf").string() + ": unknown format of scans '.dxf'");
  EXPECT_THROW(FileListSource({}), pcl6d::BadArgument);
}

TEST_F(FileList, AFolderOfSuchFilesIsASource)
{
  fs::remove(xyz_);
  writeText(folder_ / "notes.txt", "no scan\n");
  EXPECT_TRUE(pcl6d::holdsSourceScans(folder_.path()));
  const auto scans = pcl6d::openScanFolder(folder_.path());
  EXPECT_EQ(scans.size(), 3U);
  EXPECT_EQ(scans.name(0), "Lobby");
  EXPECT_EQ(scans.initialPose(2).translation().x(), 2);
  writeText(xyz_, "1 2 3\n");
  EXPECT_FALSE(pcl6d::holdsSourceScans(folder_.path()));
}

TEST_F(FileList, APtxFileIsASource)
{
  const auto source = pcl6d::openSource(ptx_);
  ASSERT_EQ(source->scans().size(), 2U);
  EXPECT_EQ(source->format(), "ptx");
  EXPECT_EQ(source->path(), ptx_);
  EXPECT_EQ(*source->scans()[1].num_points, 1U);
  EXPECT_THROW(source->read(2), pcl6d::BadArgument);
  writeText(ptx_, ptxAt(0, 3));
  EXPECT_EQ(pcl6d::openSource(ptx_)->scans()[0].name, "b");
}

} // namespace

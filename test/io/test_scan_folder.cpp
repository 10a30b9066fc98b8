// SPDX-License-Identifier: BSD-3-Clause
#include "pcd_samples.h"

#include <pcl6d/io/scan_folder.h>

namespace fs = std::filesystem;
using pcl6d::ScanFolder;
using pcl6d::ScanFolderOptions;
using pcl6d::ScanFormat;
using pcl6d::test::expectIoFailed;
using pcl6d::test::messageOf;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;

namespace {

/** \brief A folder with scans of one point each. */
class ScanFolderTest : public testing::Test {
protected:
  void
  add(const std::vector<std::string>& names)
  {
    for (const auto& name : names)
      writeText(folder_ / name, "1 2 3\n");
  }

  /** \return the names of the selected scans, each followed by a blank */
  std::string
  names(const ScanFolderOptions& options = {}) const
  {
    const ScanFolder scans(folder_.path(), options);
    std::string all;
    for (std::size_t i = 0; i < scans.size(); ++i)
      all += scans.file(i).filename().string() + ' ';
    return all;
  }

  void
  expectMessage(const std::string& message, const ScanFolderOptions& options = {}) const
  {
    expectIoFailed(folder_.path(), message, [&] { names(options); });
  }

  const TempFolder folder_;
};

ScanFolderOptions
selection(int first, std::optional<int> last, int every)
{
  ScanFolderOptions options;
  options.first = first;
  options.last = last;
  options.every = every;
  return options;
}

} // namespace

TEST_F(ScanFolderTest, ScansComeInNaturalOrder)
{
  add({"scan10.xyz",
       "scan2.xyz",
       "scan1.xyz",
       "scan02b.xyz",
       "a.xyz",
       "scan2a.xyz",
       "scan99999999999999999999999.xyz",
       "scan100.xyz",
       "Scan3.xyz",
       "scan.xyz"});
  EXPECT_EQ(names(),
            "Scan3.xyz a.xyz scan.xyz scan1.xyz scan2.xyz scan2a.xyz scan02b.xyz "
            "scan10.xyz scan100.xyz scan99999999999999999999999.xyz ");
}

TEST_F(ScanFolderTest, OnlyFilesThatAreScansCount)
{
  add({"scan0.xyz",
       "scan1.XYZ",
       ".hidden.xyz",
       "notes.txt",
       "groundtruth.xyz",
       "xyz",
       "Groundtruth_map.xyz",
       "scan2.xyz~"});
  EXPECT_EQ(names(), "scan0.xyz scan1.XYZ ");
}

TEST_F(ScanFolderTest, AFolderWithTheNameOfAScanIsNotSkipped)
{
  add({"scan0.xyz", "scan2.xyz"});
  fs::create_directory(folder_ / "scan1.xyz");
  const ScanFolder scans(folder_.path());
  ASSERT_EQ(scans.size(), 3u);
  EXPECT_THROW(scans.read(1), pcl6d::IoFailed);
}

TEST_F(ScanFolderTest, ALinkToAScanIsAScanAndALinkToNowhereIsNotSkipped)
{
  add({"scan0.xyz"});
  fs::create_symlink("scan0.xyz", folder_ / "scan1.xyz");
  fs::create_symlink("nowhere", folder_ / "scan2.xyz");
  const ScanFolder scans(folder_.path());
  ASSERT_EQ(scans.size(), 3u);
  EXPECT_EQ(scans.read(1).points.size(), 1u);
  expectIoFailed(folder_ / "scan2.xyz",
                 "is a link to 'nowhere', which is not there",
                 [&] { scans.read(2); });
}

TEST_F(ScanFolderTest, FirstLastAndEverySelect)
{
  for (int i = 0; i < 10; ++i)
    add({"s" + std::to_string(i) + ".xyz"});
  EXPECT_EQ(names(selection(2, 8, 3)), "s2.xyz s5.xyz s8.xyz ");
  EXPECT_EQ(names(selection(8, 100, 1)), "s8.xyz s9.xyz ");
  EXPECT_EQ(names(selection(3, 3, 5)), "s3.xyz ");
  EXPECT_EQ(names(selection(7, {}, 2)), "s7.xyz s9.xyz ");
  const ScanFolder scans(folder_.path(), selection(2, 8, 3));
  EXPECT_EQ(scans.index(0), 2);
  EXPECT_EQ(scans.index(2), 8);
}

TEST_F(ScanFolderTest, SelectionsThatBreakARuleOrSelectNothingAreTheCallersMistake)
{
  add({"s0.xyz", "s1.xyz"});
  const auto message = [&](const ScanFolderOptions& options) {
    return messageOf<pcl6d::BadArgument>([&] { names(options); });
  };
  EXPECT_EQ(message(selection(-1, {}, 1)), "first = -1, but must be >= 0");
  EXPECT_EQ(message(selection(1, 0, 1)), "last = 0, but must be >= first = 1");
  EXPECT_EQ(message(selection(0, {}, 0)), "every = 0, but must be >= 1");
  EXPECT_EQ(message(selection(2, {}, 1)), "first = 2, but the folder holds 2 scans");
}

TEST_F(ScanFolderTest, FoldersThatCannotBeUsedAreNamed)
{
  expectMessage("no scans found (looked for .pcd .ply .3d .bin .xyz .las .laz .ptx "
                ".pts .csv .txt .asc)");
  add({"a.txt", "scan0.xyz"});
  ScanFolderOptions options;
  options.format = ScanFormat::kUos;
  expectMessage("no scans found (looked for .3d)", options);
  const auto missing = folder_ / "missing";
  expectIoFailed(missing, "no such folder", [&] { ScanFolder{missing}; });
  const auto file = folder_ / "scan0.xyz";
  expectIoFailed(file,
                 "is a file, but must be a folder of scans: give its folder",
                 [&] { ScanFolder{file}; });
  expectIoFailed(file / "below", "no such folder", [&] { ScanFolder{file / "below"}; });
}

TEST_F(ScanFolderTest, AFolderWithoutScansNamesTheFolderBelowWithScans)
{
  const std::string looked = "no scans found (looked for .pcd .ply .3d .bin .xyz .las "
                             ".laz .ptx .pts .csv .txt .asc)";
  std::filesystem::create_directories(folder_ / "b" / "deep");
  std::filesystem::create_directories(folder_ / "a");
  add({"a/notes.txt", "b/deep/scan0.ply"});
  expectMessage(looked + "; scans lie in " + (folder_ / "b" / "deep").string() +
                ": give this folder");
  ScanFolderOptions options;
  options.format = ScanFormat::kUos;
  expectMessage("no scans found (looked for .3d)", options);
}

TEST_F(ScanFolderTest, SeveralFormatsNeedAChoice)
{
  add({"scan0.xyz", "scan1.xyz", "scan1.3d"});
  expectMessage("holds scans of several formats, .xyz (scan0.xyz) and .3d (scan1.3d); "
                "choose one of them");
  ScanFolderOptions options;
  options.format = ScanFormat::kXyz;
  EXPECT_EQ(names(options), "scan0.xyz scan1.xyz ");
  options.format = ScanFormat::kUos;
  EXPECT_EQ(names(options), "scan1.3d ");
}

TEST_F(ScanFolderTest, SomeOfTheSelectedScansAreKeptWithTheirPosesAndIndices)
{
  add({"a.xyz", "b.xyz", "c.xyz", "d.xyz", "e.xyz"});
  writeText(folder_ / "poses.tum",
            "1.5 0 0 0 0 0 0 1\n2.5 1 0 0 0 0 0 1\n3.5 2 0 0 0 0 0 1\n"
            "4.5 3 0 0 0 0 0 1\n5.5 4 0 0 0 0 0 1\n");
  ScanFolderOptions options = selection(1, 4, 1);
  options.poses_file = folder_ / "poses.tum";
  ScanFolder scans(folder_.path(), options);
  scans.keepOnly({0, 2, 3});
  ASSERT_EQ(scans.size(), 3u);
  EXPECT_EQ(scans.name(1), "d.xyz");
  EXPECT_EQ(scans.index(1), 3);
  EXPECT_EQ(scans.initialPose(2).translation().x(), 4);
  EXPECT_EQ(scans.stamps(), (std::vector<double>{2.5, 4.5, 5.5}));
  EXPECT_EQ(scans.odometry().poses.size(), 5u) << "those of all scans";
  writeText(folder_ / "d.xyz", "7 8 9\n");
  scans.keepOnly({1, 2});
  EXPECT_EQ(scans.read(0).points.at(0).x(), 7) << "not the scan that was first before";
}

TEST_F(ScanFolderTest, KeepingNoScansOrOthersThanThereAreIsTheCallersMistake)
{
  add({"a.xyz", "b.xyz", "c.xyz"});
  ScanFolder scans(folder_.path());
  for (const std::vector<std::size_t>& places :
       {std::vector<std::size_t>{}, {0, 3}, {1, 1}, {2, 0}})
    EXPECT_THROW(scans.keepOnly(places), pcl6d::BadArgument);
  EXPECT_EQ(scans.size(), 3u);
}

TEST_F(ScanFolderTest, AScanIsReadOnlyWhenItIsAskedFor)
{
  pcl6d::writePcd(folder_ / "scan0.pcd", pcl6d::test::makeRichCloud(3));
  const std::string content = pcl6d::test::readText(folder_ / "scan0.pcd");
  writeText(folder_ / "scan1.pcd", content.substr(0, content.size() - 1));
  const ScanFolder scans(folder_.path());
  EXPECT_EQ(scans.size(), 2u);
  EXPECT_EQ(scans.read(0).points.size(), 2u);
  const std::string message = messageOf<pcl6d::IoFailed>([&] { scans.read(1); });
  EXPECT_NE(message.find("scan1.pcd: expected "), std::string::npos) << message;
  EXPECT_THROW(scans.read(2), std::out_of_range);
}

TEST_F(ScanFolderTest, OpeningAndReadingChangesNoFile)
{
  add({"scan0.xyz"});
  writeText(folder_ / "odometry.txt", "1 0 0 0 0 1 0 0 0 0 1 0\n");
  const auto time = fs::last_write_time(folder_ / "scan0.xyz");
  ScanFolder(folder_.path()).read(0);
  EXPECT_EQ(pcl6d::test::namesIn(folder_.path()).size(), 2u);
  EXPECT_EQ(pcl6d::test::readText(folder_ / "scan0.xyz"), "1 2 3\n");
  EXPECT_EQ(fs::last_write_time(folder_ / "scan0.xyz"), time);
}

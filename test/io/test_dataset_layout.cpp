// SPDX-License-Identifier: BSD-3-Clause
// Layouts of published data sets, with made scans of known points, times and stamps.
#include "dataset_folder.h"
#include "pcd_samples.h"

#include <cmath>
#include <cstdint>

namespace {
namespace fs = std::filesystem;
using pcl6d::BinLayout;
using pcl6d::ScanFolder;
using pcl6d::ScanFolderOptions;
using pcl6d::test::expectIoFailed;
using pcl6d::test::fieldNames;
using pcl6d::test::floats;
using pcl6d::test::kittiScan;
using pcl6d::test::layoutName;
using pcl6d::test::messageOf;
using pcl6d::test::valuesOf;
using pcl6d::test::writeFile;

using DatasetLayouts = pcl6d::test::DatasetFolder;

/** \return the bytes of a number, lowest first */
template <typename T>
std::string
bytesOfNumber(T value)
{
  return pcl6d::test::bytesOf(std::vector<T>{value});
}
} // namespace

TEST_F(DatasetLayouts, MulRanHasTimesByOrder)
{
  std::string turn;
  for (int i = 0; i < 64 * 1024; ++i)
    turn += floats({1, static_cast<float>(i), 2, 3});
  const std::int64_t first = 1564718063056072512;
  for (int i = 0; i < 2; ++i)
    writeFile(root() / "Ouster" / (std::to_string(first + i * 100000000) + ".bin"),
              turn);
  writeFile(root() / "Ouster" / (std::to_string(first + 200000000) + ".bin"),
            kittiScan());
  writeFile(root() / "global_pose.csv", "1,1,0,0,0,0,1,0,0,0,0,1,0\n");
  const ScanFolder scans(root());
  EXPECT_EQ(layoutName(scans), "MulRan");
  EXPECT_FALSE(scans.hasPoses());
  EXPECT_NEAR(scans.stamps()[0], 1564718063.056072512, 1e-6);
  const auto times = valuesOf(scans.read(1).cloud, "time");
  ASSERT_EQ(times.size(), 64u * 1024);
  for (const std::size_t i : {0u, 63u, 64u, 32768u, 65535u})
    EXPECT_NEAR(times[i], 0.1 * std::floor(i / 64.0) / 1024, 1e-6) << i;
  EXPECT_EQ(valuesOf(scans.read(2).cloud, "time"), std::vector<double>(4, 0.0));
}

TEST_F(DatasetLayouts, ScansOfOddSizeAreNamed)
{
  const fs::path file = root() / "Ouster/1564718063056072512.bin";
  writeFile(file, kittiScan() + "x");
  const ScanFolder scans(root());
  expectIoFailed(
      file,
      "its size of 65 bytes is not a multiple of 16 (float32 x y z intensity)",
      [&] { scans.read(0); });
}

TEST_F(DatasetLayouts, HeliprHasFourRecords)
{
  const std::string point = floats({1, -2, 3});
  const std::string name = "1691936557946849180.bin"; // with the intensity of Aeva
  const auto write = [&](const std::string& sensor,
                         const std::string& behind,
                         const std::string& file) {
    writeFile(root() / "LiDAR" / sensor / file, point + behind + point + behind);
  };
  const auto read = [&](const std::string& sensor) {
    const ScanFolder scans(root() / "LiDAR" / sensor);
    EXPECT_EQ(layoutName(scans), "HeLiPR (" + sensor + ")");
    return scans.read(0).cloud;
  };
  const std::uint8_t byte = 7;
  write("Avia",
        bytesOfNumber(byte) + bytesOfNumber(byte) + bytesOfNumber(byte) +
            bytesOfNumber(std::uint32_t{90000000}),
        name);
  const auto avia = read("Avia");
  EXPECT_EQ(fieldNames(avia), "x y z intensity tag line time");
  EXPECT_EQ(valuesOf(avia, "y"), (std::vector<double>{-2, -2}));
  EXPECT_EQ(valuesOf(avia, "time"), (std::vector<double>{9e7, 9e7}));
  const std::string aeva =
      floats({0.5f, -1.5f}) + bytesOfNumber(std::int32_t{-5}) + "\x03";
  write("Aeva", aeva + floats({9}), name);
  EXPECT_EQ(fieldNames(read("Aeva")),
            "x y z reflectivity velocity time line intensity");
  EXPECT_EQ(valuesOf(read("Aeva"), "time"), (std::vector<double>{-5, -5}));
  fs::remove(root() / "LiDAR/Aeva" / name);
  write("Aeva", aeva, "1691936557946849179.bin");
  EXPECT_EQ(fieldNames(read("Aeva")), "x y z reflectivity velocity time line");
  EXPECT_EQ(valuesOf(read("Aeva"), "velocity"), (std::vector<double>{-1.5, -1.5}));
  write("Ouster",
        floats({4}) + bytesOfNumber(std::uint32_t{42}) +
            bytesOfNumber(std::uint16_t{1}) + bytesOfNumber(std::uint16_t{63}) +
            bytesOfNumber(std::uint16_t{3}),
        name);
  EXPECT_EQ(fieldNames(read("Ouster")),
            "x y z intensity time reflectivity ring ambient");
  EXPECT_EQ(valuesOf(read("Ouster"), "ring"), (std::vector<double>{63, 63}));
  write("Velodyne",
        floats({4}) + bytesOfNumber(std::uint16_t{15}) + floats({-0.05f}),
        name);
  EXPECT_EQ(fieldNames(read("Velodyne")), "x y z intensity ring time");
  EXPECT_NEAR(valuesOf(read("Velodyne"), "time")[1], -0.05, 1e-9);
  const std::string message =
      messageOf<pcl6d::IoFailed>([&] { const ScanFolder scans(root()); });
  EXPECT_NE(message.find("LiDAR/Aeva (HeLiPR (Aeva)), LiDAR/Avia (HeLiPR (Avia))"),
            std::string::npos)
      << message;
  writeFile(root() / "LiDAR/Ouster" / name, point);
  expectIoFailed(root() / "LiDAR/Ouster" / name,
                 "its size of 12 bytes is not a multiple of 26 (--bin-layout "
                 "helipr-ouster)",
                 [&] { read("Ouster"); });
}

TEST_F(DatasetLayouts, NcltBoreasAndNuscenesHaveMicrosecondsAsNames)
{
  const std::string record = {0, 0, 0, 0, 0, 0, 9, 3};
  writeFile(folder_ / "2012-01-08/velodyne_sync/1326030975726043.bin", record);
  const ScanFolder nclt(folder_ / "2012-01-08");
  EXPECT_EQ(layoutName(nclt), "NCLT");
  EXPECT_EQ(valuesOf(nclt.read(0).cloud, "y"), (std::vector<double>{100}));
  EXPECT_NEAR(nclt.stamps()[0], 1326030975.726043, 1e-6);

  writeFile(folder_ / "boreas/lidar/1598986495171337.bin",
            floats({1, 2, 3, 4, 5, 0.01f}));
  writeFile(folder_ / "boreas/applanix/lidar_poses.csv", "GPSTime,easting\n");
  const ScanFolder boreas(folder_ / "boreas");
  EXPECT_EQ(layoutName(boreas), "Boreas");
  EXPECT_EQ(fieldNames(boreas.read(0).cloud), "x y z intensity ring time");
  EXPECT_NE(boreas.note().find("reference applanix/lidar_poses.csv, not read"),
            std::string::npos);

  const std::string name = "n015-2018-07-24-11-22-45+0800__LIDAR_TOP__153240292764795";
  for (const char* const folder : {"samples", "sweeps"})
    for (const char* const digit : {"1", "2"})
      writeFile(folder_ / "nu" / folder / "LIDAR_TOP" / (name + digit + ".pcd.bin"),
                floats({1, 2, 3, 4, 5}));
  const ScanFolder nuscenes(folder_ / "nu");
  EXPECT_EQ(layoutName(nuscenes), "nuScenes");
  EXPECT_EQ(nuscenes.layout()->scans, folder_ / "nu/sweeps/LIDAR_TOP");
  EXPECT_EQ(fieldNames(nuscenes.read(0).cloud), "x y z intensity ring");
  EXPECT_NEAR(nuscenes.stamps()[1], 1532402927.647952, 1e-6);
  EXPECT_EQ(layoutName(ScanFolder(folder_ / "nu/samples/LIDAR_TOP")), "nuScenes");
}

TEST_F(DatasetLayouts, NewerCollegeAndOxfordSpiresArePcdWithStampsAsNames)
{
  const auto cloud = pcl6d::test::makeRichCloud(3);
  const auto writeCloud = [&](const fs::path& path) {
    fs::create_directories(path.parent_path());
    pcl6d::writePcd(path, cloud);
  };
  const fs::path newer = folder_ / "01_short";
  writeCloud(newer / "raw_format/ouster_scan/cloud_1583836591_82590976.pcd");
  writeCloud(newer / "raw_format/ouster_scan/cloud_1583836591_182590976.pcd");
  writeFile(newer / "ground_truth/registered_poses.csv", "#sec,nsec,x\n");
  const ScanFolder college(newer);
  EXPECT_EQ(layoutName(college), "Newer College");
  EXPECT_NEAR(college.stamps()[0], 1583836591.082590976, 1e-6);
  EXPECT_NEAR(college.stamps()[1], 1583836591.182590976, 1e-6);

  const fs::path spires = folder_ / "spires/sequences/2024-03-12-keble-college-02";
  writeCloud(spires / "raw/lidar-clouds/1710252326.122305000.pcd");
  writeCloud(spires / "raw/lidar-clouds/1710252326.222260000.pcd");
  writeCloud(spires /
             "processed/vilens-slam/undist-clouds/cloud_1710252326_122305000.pcd");
  const ScanFolder keble(folder_ / "spires");
  EXPECT_EQ(layoutName(keble), "Oxford Spires");
  EXPECT_EQ(keble.size(), 2u);
  EXPECT_NEAR(keble.stamps()[1], 1710252326.22226, 1e-6);
}

TEST_F(DatasetLayouts, OtherFoldersStayAsTheyAre)
{
  writeFile(root() / "velodyne/000000.bin", kittiScan()); // no times, no calibration
  EXPECT_EQ(layoutName(ScanFolder(root())), "");
  writeFile(root() / "calib.txt", "P0: 1\n");
  EXPECT_EQ(layoutName(ScanFolder(root())), "KITTI odometry");
  writeFile(root() / "velodyne/a.xyz", "1 2 3\n");
  expectIoFailed(root(),
                 "holds scans of several formats, .bin (000000.bin) and .xyz (a.xyz); "
                 "choose one of them",
                 [&] { const ScanFolder scans(root()); });
  ScanFolderOptions options;
  options.format = pcl6d::ScanFormat::kXyz; // what is named counts, not the layout
  EXPECT_EQ(layoutName(ScanFolder(root(), options)), "");
  fs::remove(root() / "velodyne/a.xyz");
  options.format = pcl6d::ScanFormat::kAuto;
  options.bin_layout = BinLayout::kXyz;
  EXPECT_THROW(ScanFolder(root(), options).read(0), pcl6d::IoFailed); // 64 bytes
  fs::create_directory(folder_ / "empty");
  EXPECT_THROW(ScanFolder(folder_ / "empty"), pcl6d::IoFailed);
}

TEST_F(DatasetLayouts, TwoLayoutsClash)
{
  writeFile(root() / "Ouster/1564718063056072512.bin", kittiScan());
  writeFile(root() / "velodyne_sync/1326030975726043.bin", std::string(8, '\0'));
  const std::string message =
      messageOf<pcl6d::IoFailed>([&] { const ScanFolder scans(root()); });
  EXPECT_EQ(message,
            root().string() +
                ": holds several sequences of scans: Ouster (MulRan), velodyne_sync "
                "(NCLT); give the folder of a single sequence");
}

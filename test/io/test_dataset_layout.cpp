// SPDX-License-Identifier: BSD-3-Clause
// Layouts of published data sets, with made scans of known points, times and stamps.
#include "pcd_samples.h"

#include <pcl6d/io/scan_fields.h>
#include <pcl6d/io/scan_folder.h>
#include <pcl6d/io/trajectory_io.h>

#include <cmath>

namespace {
namespace fs = std::filesystem;
using pcl6d::BinLayout;
using pcl6d::fieldValues;
using pcl6d::ScanFolder;
using pcl6d::ScanFolderOptions;
using pcl6d::test::expectIoFailed;
using pcl6d::test::messageOf;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;

/** \return the bytes of a number, lowest first */
template <typename T>
std::string
bytesOf(T value)
{
  std::string bytes(sizeof value, '\0');
  std::memcpy(bytes.data(), &value, sizeof value);
  return bytes;
}

std::string
floats(const std::vector<float>& values)
{
  std::string bytes;
  for (const float value : values)
    bytes += bytesOf(value);
  return bytes;
}

/** Four points of KITTI: ahead, left, right, and behind. */
std::string
kittiScan()
{
  return floats({5, 0, 1, 0.5f, 0, 4, 1, 0.25f, 0, -4, 1, 0.75f, -3, -3, 1, 1});
}

void
writeFile(const fs::path& path, const std::string& content)
{
  fs::create_directories(path.parent_path());
  writeText(path, content);
}

std::vector<double>
valuesOf(const pcl::PCLPointCloud2& cloud, const std::string& field)
{
  const auto values = fieldValues(cloud, field);
  return values ? values->values : std::vector<double>{};
}

std::string
fieldNames(const pcl::PCLPointCloud2& cloud)
{
  std::string names;
  for (const auto& field : cloud.fields)
    names += (names.empty() ? "" : " ") + field.name;
  return names;
}

/** \return the name of the layout; empty: none */
std::string
layoutName(const ScanFolder& scans)
{
  return scans.layout() ? scans.layout()->name : "";
}

class DatasetLayouts : public testing::Test {
protected:
  fs::path
  root() const
  {
    return folder_ / "data";
  }

  /** Writes a sequence of KITTI odometry with poses of reference. */
  void
  writeKitti(const std::string& sequence, int scans = 3) const
  {
    const fs::path path = root() / "sequences" / sequence;
    for (int i = 0; i < scans; ++i)
      writeFile(path / "velodyne" / ("00000" + std::to_string(i) + ".bin"),
                kittiScan());
    writeFile(path / "times.txt", "0\n0.1\n0.2\n");
    writeFile(path / "calib.txt", "Tr: 0 -1 0 0 0 0 -1 0 1 0 0 0\n");
    writeFile(root() / "poses" / (sequence + ".txt"), "1 0 0 7 0 1 0 0 0 0 1 0\n");
  }

  /** Writes three sweeps of KITTI raw or KITTI-360. */
  static void
  writeRaw(const fs::path& sequence)
  {
    for (int i = 0; i < 3; ++i)
      writeFile(sequence / "velodyne_points/data" /
                    ("000000000" + std::to_string(i) + ".bin"),
                kittiScan());
    writeFile(sequence / "velodyne_points/timestamps.txt",
              "2011-09-26 13:02:25.500000000\n2011-09-26 13:02:25.600000000\n"
              "2011-09-26 13:02:25.700000000\n");
  }

  TempFolder folder_;
};
} // namespace

TEST_F(DatasetLayouts, KittiOdometryIsFoundFromAnyOfItsFolders)
{
  writeKitti("07");
  const fs::path sequence = root() / "sequences/07";
  for (const fs::path& path :
       {root(), root() / "sequences", sequence, sequence / "", sequence / "velodyne"}) {
    SCOPED_TRACE(path.string());
    const ScanFolder scans(path);
    EXPECT_EQ(layoutName(scans), "KITTI odometry");
    ASSERT_EQ(scans.size(), 3u);
    EXPECT_EQ(scans.stamps(), (std::vector<double>{0, 0.1, 0.2}));
    EXPECT_FALSE(scans.hasPoses()); // those of the reference are not taken
    EXPECT_EQ(fieldNames(scans.read(1).cloud), "x y z intensity");
    EXPECT_NE(
        scans.note().find(
            "data set KITTI odometry; points xyzi; x forward, y left, z up [m]; "
            "stamps of times.txt; times of points: none: sweeps are deskewed "
            "already; calibration calib.txt; reference ../../poses/07.txt, not read"),
        std::string::npos)
        << scans.note();
  }
}

TEST_F(DatasetLayouts, OfSeveralSequencesOneMustBeNamed)
{
  writeKitti("00");
  writeKitti("03");
  expectIoFailed(
      root(),
      "holds several sequences of scans: sequences/00/velodyne (KITTI odometry), "
      "sequences/03/velodyne (KITTI odometry); give the folder of a single sequence",
      [&] { const ScanFolder scans(root()); });
  EXPECT_EQ(ScanFolder(root() / "sequences/03").size(), 3u);
}

TEST_F(DatasetLayouts, StampsOfMissingScansAreLeftOut)
{
  writeKitti("00");
  fs::remove(root() / "sequences/00/velodyne/000001.bin");
  EXPECT_EQ(ScanFolder(root()).stamps(), (std::vector<double>{0, 0.2}));
  writeFile(root() / "sequences/00/times.txt", "0\n");
  expectIoFailed(root() / "sequences/00/times.txt",
                 "1 time stamp, but the folder holds 2 scans",
                 [&] { const ScanFolder scans(root()); });
}

// The scanner turns clockwise and is stamped when it faces forward.
TEST_F(DatasetLayouts, KittiRawHasTimesByAzimuthAndStampsByDate)
{
  const fs::path drive = root() / "2011_09_26/2011_09_26_drive_0001_sync";
  writeRaw(drive);
  fs::create_directories(drive / "oxts/data");
  const double first = 1317042145.5; // date -u -d "2011-09-26 13:02:25.5" +%s
  for (const fs::path& path : {root(), drive, drive / "velodyne_points/data"}) {
    SCOPED_TRACE(path.string());
    const ScanFolder scans(path);
    EXPECT_EQ(layoutName(scans), "KITTI raw");
    ASSERT_EQ(scans.stamps().size(), 3u);
    EXPECT_EQ(scans.stamps()[0], first);
    EXPECT_NEAR(scans.stamps()[2], first + 0.2, 1e-6);
    const auto times = valuesOf(scans.read(0).cloud, "time");
    ASSERT_EQ(times.size(), 4u);
    const double period = 0.1, rounding = 1e-6; // of stamps as double
    EXPECT_NEAR(times[0], 0, rounding);
    EXPECT_NEAR(times[1], -period / 4, rounding);
    EXPECT_NEAR(times[2], period / 4, rounding);
    EXPECT_NEAR(times[3], period * 3 / 8, rounding);
  }
}

TEST_F(DatasetLayouts, Kitti360IsToldByItsFolder)
{
  const fs::path drive = root() / "data_3d_raw/2013_05_28_drive_0000_sync";
  writeRaw(drive);
  const std::string poses = "data_poses/2013_05_28_drive_0000_sync/poses.txt";
  writeFile(root() / poses, "0 1 0 0 0 0 1 0 0 0 0 1 0\n");
  const ScanFolder scans(root());
  EXPECT_EQ(layoutName(scans), "KITTI-360");
  EXPECT_EQ(scans.layout()->reference,
            (fs::absolute(root()) / poses).lexically_normal());
  EXPECT_FALSE(scans.hasPoses());
  EXPECT_EQ(valuesOf(scans.read(0).cloud, "time").size(), 4u);
}

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
        bytesOf(byte) + bytesOf(byte) + bytesOf(byte) +
            bytesOf(std::uint32_t{90000000}),
        name);
  const auto avia = read("Avia");
  EXPECT_EQ(fieldNames(avia), "x y z intensity tag line time");
  EXPECT_EQ(valuesOf(avia, "y"), (std::vector<double>{-2, -2}));
  EXPECT_EQ(valuesOf(avia, "time"), (std::vector<double>{9e7, 9e7}));
  const std::string aeva = floats({0.5f, -1.5f}) + bytesOf(std::int32_t{-5}) + "\x03";
  write("Aeva", aeva + floats({9}), name);
  EXPECT_EQ(fieldNames(read("Aeva")),
            "x y z reflectivity velocity time line intensity");
  EXPECT_EQ(valuesOf(read("Aeva"), "time"), (std::vector<double>{-5, -5}));
  fs::remove(root() / "LiDAR/Aeva" / name);
  write("Aeva", aeva, "1691936557946849179.bin");
  EXPECT_EQ(fieldNames(read("Aeva")), "x y z reflectivity velocity time line");
  EXPECT_EQ(valuesOf(read("Aeva"), "velocity"), (std::vector<double>{-1.5, -1.5}));
  write("Ouster",
        floats({4}) + bytesOf(std::uint32_t{42}) + bytesOf(std::uint16_t{1}) +
            bytesOf(std::uint16_t{63}) + bytesOf(std::uint16_t{3}),
        name);
  EXPECT_EQ(fieldNames(read("Ouster")),
            "x y z intensity time reflectivity ring ambient");
  EXPECT_EQ(valuesOf(read("Ouster"), "ring"), (std::vector<double>{63, 63}));
  write("Velodyne", floats({4}) + bytesOf(std::uint16_t{15}) + floats({-0.05f}), name);
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

TEST(NameStamps, AreReadOfAllKindsOrNotAtAll)
{
  using pcl6d::stampsOfNames;
  EXPECT_EQ(stampsOfNames({"a_1500000000_5.pcd", "a_1500000000_500000000.pcd"}),
            (std::vector<double>{1500000000 + 5e-9, 1500000000.5}));
  EXPECT_EQ(stampsOfNames({"1500000000.25.pcd", "1500000000.5.pcd"}),
            (std::vector<double>{1500000000.25, 1500000000.5}));
  EXPECT_EQ(stampsOfNames({"x_1500000000500000.ply"}),
            (std::vector<double>{1500000000.5}));
  EXPECT_EQ(stampsOfNames({"1500000000250000000.bin", "1500000000500000000.bin"}),
            (std::vector<double>{1500000000.25, 1500000000.5}));
  EXPECT_TRUE(stampsOfNames({"1500000000500000.bin", "scan001.bin"}).empty());
  EXPECT_TRUE(stampsOfNames({"1500000000500000.bin", "1500000000500000.bin"}).empty());
  for (const char* const name : {"scan001.pcd",
                                 "0000000001.bin",
                                 "0500000000500000.bin",
                                 "1500000000.pcd",
                                 "1500000000_.pcd",
                                 "1500000000_1234567890.pcd",
                                 "150000000_5.pcd",
                                 "20240312_101500.pcd",
                                 ".pcd"})
    EXPECT_TRUE(stampsOfNames({name}).empty()) << name;
}

TEST(DateStamps, AreSecondsSince1970)
{
  const TempFolder folder;
  const auto read = [&](const std::string& text) {
    writeText(folder / "timestamps.txt", text);
    return pcl6d::readStamps(folder / "timestamps.txt");
  };
  // date -u -d "..." +%s
  EXPECT_EQ(read("1970-01-01 00:00:00\n2000-02-29 23:59:59.25\n2000-03-01 00:00:00\n"),
            (std::vector<double>{0, 951868799.25, 951868800}));
  EXPECT_EQ(read("2013-05-28 08:46:02.900000000\r\n"),
            (std::vector<double>{1369730762.9}));
  for (const char* const line : {"2011-02-29 00:00:00",
                                 "2011-13-01 00:00:00",
                                 "2011-09-26 24:00:00",
                                 "2011-09-26 13:02",
                                 "2011-09-26",
                                 "2011-09-26 13:02:25.9e3",
                                 "2011-09-26 13:02:25 7"})
    EXPECT_THROW(read(line), pcl6d::IoFailed) << line;
}

// SPDX-License-Identifier: BSD-3-Clause
#include "support/temp_folder.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/frames_io.h>
#include <pcl6d/io/object_io.h>
#include <pcl6d/io/pcd_io.h>
#include <pcl6d/io/plane_io.h>
#include <pcl6d/io/scan_fields.h>
#include <pcl6d/io/trajectory_io.h>
#include <pcl6d/run/registered_scans.h>
#include <pcl6d/run/run_folder.h>
#include <pcl6d/run/run_links_io.h>
#include <pcl6d/run/run_summary.h>
#include <pcl6d/run/written_files.h>

#include <pcl/conversions.h>
#include <pcl/point_types.h>

#include <gtest/gtest.h>

namespace {
using pcl6d::IoFailed;
using pcl6d::RunFolder;
using pcl6d::RunLink;
using pcl6d::RunResult;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;

const Eigen::Vector3d kOffset(500000, 5400000, 0); // [m] national coordinates

Eigen::Isometry3d
at(double x, double y)
{
  Eigen::Isometry3d pose = Eigen::Isometry3d::Identity();
  pose.translation() = kOffset + Eigen::Vector3d(x, y, 0);
  return pose;
}

pcl::PCLPointCloud2
cloudOf(const std::vector<Eigen::Vector3f>& points)
{
  pcl::PointCloud<pcl::PointXYZ> cloud;
  for (const auto& p : points)
    cloud.push_back({p.x(), p.y(), p.z()});
  pcl::PCLPointCloud2 result;
  pcl::toPCLPointCloud2(cloud, result);
  return result;
}

/** Two scans, as a run writes them. */
struct RunFiles : TempFolder {
  RunFiles()
  {
    namespace fs = std::filesystem;
    summary.generator = "pcl_slam6d";
    summary.world_offset = kOffset;
    for (int i = 0; i < 2; ++i) {
      pcl6d::ScanResult scan;
      scan.file = i == 0 ? "a.pcd" : "b.pcd";
      scan.index = 3 * i;
      scan.initial_pose = at(i, 0.5 * i);
      scan.T_world_scan = at(i, 0);
      summary.scans.push_back(scan);
    }
    writeSummary();
    fs::create_directory(*this / "frames");
    fs::create_directory(*this / "scans");
    for (const char* const name : {"scan000", "scan003"}) {
      pcl6d::writeFrames(
          *this / ("frames/" + std::string(name) + ".frames"),
          {{at(0, 1), pcl6d::FrameKind::kInvalid}, {at(0, 0), pcl6d::FrameKind::kLum}});
      pcl6d::writePcd(*this / ("scans/" + std::string(name) + ".pcd"),
                      cloudOf({{1, 2, 3}}));
    }
    pcl6d::writeTrajectoryKitti(*this / "trajectory.kitti", {{at(0, 0), at(1, 0)}, {}});
    pcl::PCLPointCloud2 map = cloudOf({{0, 0, 0}, {1, 0, 2}});
    pcl6d::addField(map, "scan", pcl::PCLPointField::UINT32, {0, 3});
    pcl6d::addField(map, "intensity", pcl::PCLPointField::FLOAT32, {0.5, 7});
    pcl6d::writePcd(*this / "map.pcd", map);
    writeText(*this / "graph.g2o", "VERTEX_SE3:QUAT 0 0 0 0 0 0 0 1\n");
    pcl6d::writeRunLinks(*this / "links.csv", {link()});
  }
  static RunLink
  link()
  {
    return {0,
            3,
            pcl6d::LinkKind::kLoop,
            pcl6d::LinkVerdict::kRefused,
            pcl6d::Rejection::stated("few pairs, \"far\""),
            1.5,
            7,
            NAN,
            0.25,
            0.5,
            0};
  }
  void
  writeSummary() const
  {
    pcl6d::writeRunSummary(*this / "summary.json", summary);
  }
  std::string
  errorOfOpening() const
  {
    try {
      RunFolder{path()};
    } catch (const IoFailed& error) {
      return error.what();
    }
    return "";
  }
  RunResult summary;
};
} // namespace

TEST(RunFolder, GivesWhatARunLeft)
{
  const RunFiles files;
  const RunFolder run(files.path());
  EXPECT_TRUE(run.hasSummary());
  EXPECT_EQ(run.missing(), std::vector<std::string>());
  ASSERT_EQ(run.summary().scans.size(), 2u);
  EXPECT_EQ(run.trajectory().poses[1].translation(), Eigen::Vector3d(1, 0, 0));
  EXPECT_EQ(run.initialTrajectory().poses[1].translation(), Eigen::Vector3d(1, 0.5, 0));
  const auto history = run.readHistory();
  ASSERT_EQ(history[1].size(), 2u);
  EXPECT_LT(
      (history[1][0].T_world_scan.translation() - Eigen::Vector3d(0, 1, 0)).norm(),
      1e-6);
  const auto map = run.readMap();
  EXPECT_EQ(map.points[1], Eigen::Vector3f(1, 0, 2));
  EXPECT_EQ(map.scans, (std::vector<std::uint32_t>{0, 3}));
  EXPECT_EQ(map.intensities, (std::vector<float>{0.5F, 7}));
  EXPECT_EQ(run.readScan(1).front(), Eigen::Vector3f(1, 2, 3));
  EXPECT_TRUE(run.readPlanes().empty());
  EXPECT_TRUE(run.readPlanePoints().points.empty());
  EXPECT_TRUE(run.readObjects().empty());
}

TEST(RunFolder, DoesNotTakeLinksToNowhereForMissingFiles)
{
  const RunFiles files;
  for (const char* const target : {"nowhere", "planes.json"}) { // the other to itself
    std::filesystem::create_symlink(target, files.path() / "planes.json");
    EXPECT_THROW(RunFolder(files.path()).readPlanes(), IoFailed) << target;
    std::filesystem::remove(files.path() / "planes.json");
    std::filesystem::create_symlink(target, files.path() / "objects.json");
    EXPECT_THROW(RunFolder(files.path()).readObjects(), IoFailed) << target;
    std::filesystem::remove(files.path() / "objects.json");
  }
}

TEST(RunFolder, OfAFinishedRunNeedsASummary)
{
  const TempFolder empty;
  for (const std::filesystem::path& path : {empty.path(), empty / "missing"})
    try {
      RunFolder::finished(path, "unfinished");
      ADD_FAILURE() << path;
    } catch (const IoFailed& e) {
      EXPECT_EQ(e.what(),
                path.string() + ": holds no run of pcl_slam6d (no summary.json)");
    }
}

TEST(RunFolder, NoticesFilesThatAreNotThoseOfItsRun)
{
  const RunFiles files;
  auto summary = pcl6d::readRunSummary(files / "summary.json");
  summary.files = pcl6d::writtenFiles(files.path());
  EXPECT_EQ(summary.files.count("scans/scan003.pcd"), 1u);
  EXPECT_EQ(summary.files.count("summary.json"), 0u);
  pcl6d::writeRunSummary(files / "summary.json", summary);
  EXPECT_NO_THROW(RunFolder::finished(files.path(), "unfinished").requireWhole());
  const auto messageOf = [](const auto& call) {
    try {
      call();
    } catch (const IoFailed& e) {
      return std::string(e.what());
    }
    return std::string();
  };
  std::string scan = pcl6d::test::readText(files / "scans/scan003.pcd");
  scan.back() ^= 1;
  writeText(files / "scans/scan003.pcd", scan); // of the same size
  const RunFolder run = RunFolder::finished(files.path(), "unfinished");
  EXPECT_NO_THROW(run.readMap());
  const std::string changed = "scan003.pcd: differs from the file of the run";
  EXPECT_NE(messageOf([&] { run.readScan(1); }).find(changed), std::string::npos);
  EXPECT_NE(messageOf([&] { run.requireWhole(); }).find(changed), std::string::npos);
  EXPECT_NE(
      messageOf([&] { pcl6d::RegisteredScans scans(files.path()); }).find(changed),
      std::string::npos);
  writeText(files / "map.pcd", "of another run");
  const std::string resized = "map.pcd: has 14 bytes, but its run wrote ";
  EXPECT_NE(messageOf([&] { run.readMap(); }).find(resized), std::string::npos);
  EXPECT_NE(messageOf([&] { RunFolder::finished(files.path(), ""); }).find(resized),
            std::string::npos);
  EXPECT_NO_THROW(RunFolder(files.path())); // what is whole can still be read
}

TEST(RunFolder, GivesTheCloudOfAScan)
{
  const RunFiles files;
  const RunFolder run(files.path());
  const auto plain = run.readScanCloud(1);
  EXPECT_EQ(plain.points, run.readScan(1));
  EXPECT_EQ(plain.scans, std::vector<std::uint32_t>{3}) << "index, not place";
  EXPECT_TRUE(plain.intensities.empty());
  pcl::PCLPointCloud2 bright = cloudOf({{1, 2, 3}, {4, 5, 6}});
  pcl6d::addField(bright, "intensity", pcl::PCLPointField::FLOAT32, {9, 8});
  pcl6d::writePcd(files / "scans/scan003.pcd", bright);
  const auto cloud = run.readScanCloud(1);
  EXPECT_EQ(cloud.points[1], Eigen::Vector3f(4, 5, 6));
  EXPECT_EQ(cloud.scans, (std::vector<std::uint32_t>{3, 3}));
  EXPECT_EQ(cloud.intensities, (std::vector<float>{9, 8}));
  std::filesystem::remove(files / "scans/scan003.pcd");
  EXPECT_TRUE(run.readScanCloud(1).points.empty());
  writeText(files / "scans/scan003.pcd", "rubbish");
  EXPECT_THROW(run.readScanCloud(1), IoFailed);
}

TEST(RunFolder, GivesPlanesAndObjectsIfThereAreAny)
{
  const RunFiles files;
  pcl6d::writePlanes(files / "planes.json", {pcl6d::Plane()});
  pcl::PCLPointCloud2 cloud = cloudOf({{0, 0, 0}, {1, 0, 2}});
  pcl6d::addField(cloud, "plane_id", pcl::PCLPointField::UINT32, {0, 1});
  pcl6d::writePcd(files / "planes.pcd", cloud);
  pcl6d::ObjectPose chair;
  chair.object_class = "chair";
  chair.T_world_object = at(1, 2);
  chair.box = Eigen::AlignedBox3d(Eigen::Vector3d(-1, 0, 0), Eigen::Vector3d(1, 2, 3));
  chair.points = 8;
  pcl6d::writeObjects(files / "objects.json", {chair});
  const RunFolder run(files.path());
  EXPECT_EQ(run.readPlanes().size(), 1u);
  EXPECT_EQ(run.readPlanePoints().plane_of, (std::vector<std::uint32_t>{0, 1}));
  const auto objects = run.readObjects();
  ASSERT_EQ(objects.size(), 1u);
  EXPECT_EQ(objects[0].object_class, "chair");
  EXPECT_EQ(objects[0].T_world_object.matrix(), chair.T_world_object.matrix());
  EXPECT_EQ(objects[0].box.min(), chair.box.min());
  EXPECT_EQ(objects[0].box.max(), chair.box.max());
  EXPECT_EQ(objects[0].points, 8u);
}

TEST(RunFolder, NamesWhatIsMissing)
{
  const RunFiles files;
  for (const char* const name : {"map.pcd", "links.csv", "scans/scan003.pcd"})
    std::filesystem::remove(files / name);
  const RunFolder run(files.path());
  EXPECT_EQ(run.missing(),
            (std::vector<std::string>{"map.pcd", "links.csv", "scans/scan003.pcd"}));
  EXPECT_TRUE(run.readMap().points.empty());
  EXPECT_TRUE(run.readLinks().empty());
  EXPECT_TRUE(run.readScan(1).empty());
}

TEST(RunFolder, MissesWhatMovedOnlyWhereSomethingDid)
{
  RunFiles files;
  files.summary.moving.emplace();
  files.summary.moving->points = {0, 0};
  files.writeSummary();
  EXPECT_EQ(RunFolder(files.path()).missing(), std::vector<std::string>());
  files.summary.scans[1].points = 5;
  files.summary.moving->points = {0, 1};
  files.writeSummary();
  EXPECT_EQ(RunFolder(files.path()).missing(), std::vector<std::string>{"moving.pcd"});
  EXPECT_TRUE(RunFolder(files.path()).readMoving().points.empty());
}

TEST(RunFolder, TellsThatARunWasInterrupted)
{
  RunFiles files;
  files.summary.complete = false;
  files.writeSummary();
  std::filesystem::remove(files / "map.pcd");
  EXPECT_EQ(RunFolder(files.path()).missing(),
            std::vector<std::string>{"map.pcd (the run was interrupted)"});
}

TEST(RunFolder, TakesThePosesWhereTheSummaryIsGone)
{
  const RunFiles files;
  std::filesystem::remove(files / "summary.json");
  const RunFolder run(files.path());
  EXPECT_FALSE(run.hasSummary());
  EXPECT_FALSE(run.summary().trusted);
  EXPECT_EQ(run.missing().front(), "summary.json");
  EXPECT_EQ(run.trajectory().poses[1].translation(), Eigen::Vector3d(1, 0, 0));
  EXPECT_LT((run.initialTrajectory().poses[0].translation() - Eigen::Vector3d(0, 1, 0))
                .norm(),
            1e-6);
}

TEST(RunFolder, RefusesWhatIsNoRun)
{
  const TempFolder empty;
  EXPECT_THROW(RunFolder(empty.path() / "gone"), IoFailed);
  EXPECT_THROW(RunFolder(empty.path()), IoFailed);
  RunFiles files;
  files.summary.generator = "another";
  files.writeSummary();
  EXPECT_NE(files.errorOfOpening().find("is of 'another'"), std::string::npos);
  writeText(files / "summary.json", "{");
  EXPECT_NE(files.errorOfOpening().find("summary.json: "), std::string::npos);
}

TEST(RunLinks, ComeBackAsTheyWereWritten)
{
  const RunFiles files;
  const auto links = RunFolder(files.path()).readLinks();
  ASSERT_EQ(links.size(), 1u);
  EXPECT_EQ(links[0].from, 0u);
  EXPECT_EQ(links[0].to, 3u);
  EXPECT_EQ(links[0].kind, pcl6d::LinkKind::kLoop);
  EXPECT_FALSE(links[0].counts());
  EXPECT_EQ(toWords(links[0].rejection), toWords(RunFiles::link().rejection));
  EXPECT_EQ(links[0].distance, 1.5);
  EXPECT_EQ(links[0].pairs, 7u);
  EXPECT_TRUE(std::isnan(links[0].rms));
  EXPECT_EQ(links[0].overlap, 0.25);
}

TEST(RunLinks, NameThePlaceOfAnError)
{
  const TempFolder folder;
  const auto messageOf = [&](const std::string& content) -> std::string {
    writeText(folder / "links.csv", content);
    try {
      pcl6d::readRunLinks(folder / "links.csv");
    } catch (const IoFailed& error) {
      return error.what();
    }
    return "";
  };
  const std::string header =
      "from,to,kind,verdict,reason,distance,pairs,rms,overlap,condition,weight\n";
  EXPECT_NE(messageOf(header + "0,1,loop\n").find("line 2: expected 11 columns, got 3"),
            std::string::npos);
  EXPECT_NE(messageOf(header + "0,x,loop,used,,1,2,3,4,5,6\n").find("line 2: to = 'x'"),
            std::string::npos);
  for (const char* rows : {"", "0,loop\n"}) // without links, too
    EXPECT_NE(
        messageOf(std::string("from,kind\n") + rows).find("line 1: has no column 'to'"),
        std::string::npos);
  EXPECT_NE(messageOf("").find("links.csv: is empty"), std::string::npos);
}

TEST(ObjectIo, NamesTheObjectAndTheField)
{
  const TempFolder folder;
  writeText(folder / "o.json", R"({"objects": [{"class": "chair"}]})");
  try {
    pcl6d::readObjects(folder / "o.json");
    FAIL();
  } catch (const IoFailed& error) {
    EXPECT_NE(std::string(error.what()).find("/objects/0: key 'T_world_object'"),
              std::string::npos)
        << error.what();
  }
}

// SPDX-License-Identifier: BSD-3-Clause
// pcl_slam6d_convert scans as a user runs it.
#include "apps/convert/convert_test.h"
#include "support/poses.h"

#include <pcl6d/io/scan_folder.h>
#include <pcl6d/io/trajectory_io.h>

namespace fs = std::filesystem;
using pcl6d::ScanFolder;
using pcl6d::ScanFolderOptions;
using pcl6d::test::cloudOf;
using pcl6d::test::converted;
using pcl6d::test::convertedWithEmptyScan;
using pcl6d::test::floatOf;
using pcl6d::test::randomScan;
using pcl6d::test::readText;
using pcl6d::test::TempFolder;
using pcl6d::test::writeText;

namespace {
const std::vector<std::string> kFormats = {"pcd", "ply", "uos", "uosr", "kitti", "xyz"};

/** \brief A folder of PCD scans: random with NaN, one point, none, random. */
struct Scans : TempFolder {
  Scans()
  {
    pcl6d::Random random(5);
    const std::size_t counts[] = {3000, 1, 0, 50};
    fs::create_directory(in);
    for (std::size_t i = 0; i < 4; ++i) {
      auto cloud = randomScan(counts[i], i + 1);
      if (i == 1) // the only point
        cloud = cloudOf({"x", "y", "z", "intensity"}, {0.1f, -2, 3, 7});
      poses.push_back(pcl6d::test::randomPose(random, 100, 2));
      pcl6d::writePcd(in / ("scan ä" + std::to_string(i) + ".pcd"), cloud, poses[i]);
    }
  }

  std::string
  name(const std::string& file) const
  {
    return *this / file;
  }

  const fs::path in = *this / "Flur Süd 1";
  std::vector<Eigen::Isometry3d> poses;
};

/** \return the scans of a folder in that format */
ScanFolder
openAs(const fs::path& folder, const std::string& format)
{
  ScanFolderOptions options;
  options.format = pcl6d::scanFormatFromName(format);
  return ScanFolder(folder, options);
}

/** Expects the same finite points, to the last bit, and the same poses. */
void
expectSameScans(const ScanFolder& expected, const ScanFolder& found, bool intensity)
{
  ASSERT_EQ(expected.size(), found.size());
  for (std::size_t i = 0; i < expected.size(); ++i) {
    EXPECT_EQ(expected.file(i).stem(), found.file(i).stem());
    const auto a = expected.read(i), b = found.read(i);
    EXPECT_EQ(a.points, b.points);
    for (std::size_t k = 0; k < a.points.size() && intensity; ++k)
      EXPECT_EQ(floatOf(a.cloud, k, "intensity"), floatOf(b.cloud, k, "intensity"));
    const auto error =
        pcl6d::distanceBetween(expected.initialPose(i), found.initialPose(i));
    EXPECT_LT(error.translation, 1e-12); // times and by 100
    EXPECT_LT(error.rotation, 1e-13);    // by way of angles and back
  }
}
} // namespace

TEST(ConvertScans, EveryPairOfFormatsKeepsScansNamesAndPoses)
{
  const Scans scans;
  const ScanFolder original(scans.in);
  for (const auto& first : kFormats) {
    const fs::path there = scans / ("über " + first);
    convertedWithEmptyScan({"scans", scans.in, "-o", there, "--format", first});
    for (const auto& second : kFormats) {
      SCOPED_TRACE(first + " to " + second);
      const fs::path back = scans / (first + " " + second);
      convertedWithEmptyScan({"scans",
                              there,
                              "-o",
                              back,
                              "--format",
                              second,
                              "--input-format",
                              first,
                              "--quiet"});
      const auto holds = [](const std::string& format) {
        return format != "uos" && format != "xyz";
      };
      expectSameScans(original, openAs(back, second), holds(first) && holds(second));
      fs::remove_all(back);
    }
  }
}

TEST(ConvertScans, TellsWhatIsDropped)
{
  const Scans scans;
  EXPECT_EQ(convertedWithEmptyScan(
                {"scans", scans.in, "-o", scans.name("out"), "--format", "xyz"}),
            "4 scans, 2746 points: pcd to xyz\n"
            "poses from PCD VIEWPOINT, now in poses.txt\n"
            "dropped 305 points with an x, y or z that is not finite\n"
            "dropped field 'intensity' (4 of 4 scans)\n");
  EXPECT_EQ(converted({"scans", scans.in / "scan ä1.pcd", "-o", scans.name("a.bin")}),
            "1 point to kitti\ndropped the pose\n");
  EXPECT_EQ(converted({"scans", scans.name("a.bin"), "-o", scans.name("a.3d")}),
            "1 point to uos\ndropped field 'intensity'\n");
  EXPECT_EQ(readText(scans / "a.3d"), "200 300 10\n");
  EXPECT_EQ(
      converted(
          {"scans", scans.name("a.3d"), "-o", scans.name("b.3d"), "--format", "uosr"}),
      "1 point to uosr\nwrote 0 for the missing field 'intensity'\n");
  EXPECT_EQ(converted({"scans", scans.name("b.3d"), "-o", scans.name("b.ply")}),
            "1 point to ply\ndid not read columns behind the first 3 (line 1)\n");
}

TEST(ConvertScans, ShowsFieldsWithoutTheirControlCharacters)
{
  const Scans scans;
  writeText(
      scans / "a.pcd",
      "FIELDS x y z a\x1b[31m\nSIZE 4 4 4 4\nTYPE F F F F\nCOUNT 1 1 1 1\nWIDTH 1\n"
      "HEIGHT 1\nPOINTS 1\nDATA ascii\n1 2 3 4\n");
  EXPECT_EQ(converted({"scans", scans.name("a.pcd"), "-o", scans.name("a.xyz")}),
            "1 point to xyz\ndropped field 'a\\x1b[31m'\n");
}

TEST(ConvertScans, ASinglePoseGoesAlong)
{
  const Scans scans;
  const std::string pcd = scans.in / "scan ä1.pcd";
  converted({"scans", pcd, "-o", scans.name("a.3d")});
  converted({"scans", scans.name("a.3d"), "-o", scans.name("b.pcd")});
  const auto error =
      pcl6d::distanceBetween(pcl6d::readPcdViewpoint(scans / "b.pcd"), scans.poses[1]);
  EXPECT_LT(error.translation, 1e-12);
  EXPECT_LT(error.rotation, 1e-13);
  writeText(scans / "a.pose", "1 2 3\n4 5 6\n"); // an input is never touched
  converted({"scans", scans.name("a.3d"), "-o", scans.name("c.pcd")});
  fs::rename(scans / "c.pcd", scans / "a.pcd");
  converted({"scans", scans.name("a.pcd"), "-o", scans.name("a.3d")});
  EXPECT_EQ(readText(scans / "a.pose"), "1 2 3\n4 5 6\n");
}

TEST(ConvertScans, APoseOfSomethingElseIsNotReplaced)
{
  const Scans scans;
  const std::string pcd = scans.in / "scan ä1.pcd";
  writeText(scans / "k.pose", "mine");
  pcl6d::test::expectConvertError(
      {"scans", pcd, "-o", scans.name("k.3d")}, 1, {"k.pose: already exists"});
  EXPECT_EQ(readText(scans / "k.pose"), "mine");
  EXPECT_FALSE(fs::exists(scans / "k.3d"));
  fs::create_directory(scans / "k2.pose"); // cannot be written
  writeText(scans / "k2.3d", "before");
  pcl6d::test::expectConvertError(
      {"scans", pcd, "-o", scans.name("k2.3d")}, 1, {"k2.pose"});
  EXPECT_EQ(readText(scans / "k2.3d"), "before");
  fs::rename(scans / "k.pose", scans / "a.pose"); // that of the input is no other
  fs::copy_file(pcd, scans / "a.pcd");
  writeText(scans / "a.pose", "1 2 3\n4 5 6\n");
  converted({"scans", scans.name("a.pcd"), "-o", scans.name("a.3d")});
  EXPECT_EQ(readText(scans / "a.pose"), "1 2 3\n4 5 6\n");
}

TEST(ConvertScans, StampsStayWhereTheFormatHasAPlace)
{
  const Scans scans;
  pcl6d::Trajectory trajectory{scans.poses, {1.5, 2.5, 3.25, 1e9}};
  writeTrajectoryTum(scans / "given.txt", trajectory);
  for (const std::string format : {"pcd", "ply", "uos"}) {
    const std::string out = convertedWithEmptyScan({"scans",
                                                    scans.in,
                                                    "-o",
                                                    scans.name(format),
                                                    "--format",
                                                    format,
                                                    "--poses",
                                                    scans.name("given.txt"),
                                                    "--last",
                                                    "2",
                                                    "--every",
                                                    "2"});
    const ScanFolder folder(scans / format);
    ASSERT_EQ(folder.size(), 2u);
    const bool stamped = format != "uos";
    EXPECT_EQ(folder.stamps(),
              stamped ? std::vector<double>({1.5, 3.25}) : std::vector<double>());
    EXPECT_EQ(out.find("dropped the stamps") != std::string::npos, !stamped) << out;
    EXPECT_LT(pcl6d::distanceBetween(folder.initialPose(1), scans.poses[2]).rotation,
              1e-13);
  }
}

TEST(ConvertScans, NoPosesAreInvented)
{
  const TempFolder folder;
  fs::create_directory(folder / "in");
  writeText(folder / "in/a.xyz", "1 2 3\n");
  const std::string in = folder / "in", out = folder / "out";
  EXPECT_EQ(converted({"scans", in, "-o", out, "--format", "uos"}),
            "1 scan, 1 point: xyz to uos\nno poses found or written\n");
  EXPECT_FALSE(fs::exists(folder / "out/a.pose"));
}

TEST(ConvertScans, EncodingsOfPcdAndPly)
{
  const Scans scans;
  const std::string in = scans.in / "scan ä3.pcd";
  const auto wrote = [&](const std::string& file, const std::string& encoding) {
    converted({"scans", in, "-o", scans.name(file), "--encoding", encoding});
    return readText(scans / file);
  };
  for (const std::string encoding : {"ascii", "binary", "binary_compressed"})
    EXPECT_NE(wrote("a.pcd", encoding).find("\nDATA " + encoding + "\n"),
              std::string::npos);
  EXPECT_NE(wrote("a.pcd", "auto").find("DATA binary_compressed\n"), std::string::npos);
  EXPECT_NE(wrote("a.ply", "ascii").find("format ascii"), std::string::npos);
  EXPECT_NE(wrote("a.ply", "auto").find("binary_little_endian"), std::string::npos);
  const auto outcome = pcl6d::test::convert(
      {"scans", in, "-o", scans.name("a.xyz"), "--encoding", "ascii"});
  EXPECT_EQ(outcome.exit_code, 0);
  EXPECT_NE(outcome.err.find("no effect in this run: --encoding"), std::string::npos);
}

TEST(ConvertScans, TextsAreReadByNamedColumns)
{
  const TempFolder folder;
  pcl6d::test::writeText(folder / "a.csv", "7,1,x,2,3\n8,4,y,5,6\n");
  EXPECT_EQ(
      pcl6d::test::converted(
          {"scans", folder / "a.csv", "-o", folder / "a.pcd", "--columns", "i,x,,y,z"}),
      "2 points to pcd\n");
  EXPECT_EQ(pcl6d::readScan(folder / "a.pcd").points,
            (pcl6d::Points{{1, 2, 3}, {4, 5, 6}}));
  pcl6d::test::expectConvertError(
      {"scans", folder / "a.csv", "-o", folder / "b.pcd", "--columns", "x,y"},
      2,
      {"columns", "z is missing"});
  pcl6d::test::expectConvertError(
      {"scans", folder / "a.pcd", "-o", folder / "b.csv"}, 2, {"only read"});
}

TEST(ConvertScans, PtxKeepsPosesOnTheWayThereAndBack)
{
  const Scans scans;
  const TempFolder folder;
  const auto out = pcl6d::test::convert(
      {"scans", scans.in, "-o", folder / "ptx", "--format", "ptx"});
  EXPECT_NE(out.out.find("now in the headers"), std::string::npos)
      << out.out << out.err;
  const pcl6d::ScanFolder before(scans.in), after(folder / "ptx");
  ASSERT_EQ(before.size(), after.size());
  for (std::size_t i = 0; i < before.size(); ++i) {
    EXPECT_TRUE(after.initialPose(i).isApprox(before.initialPose(i), 1e-14));
    EXPECT_EQ(after.read(i).points, before.read(i).points);
  }
}

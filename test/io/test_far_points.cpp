// SPDX-License-Identifier: BSD-3-Clause
// Points far from the origin of their coordinates: told apart, and read in double.
#include "far_samples.h"

#include <pcl6d/common/pose.h>
#include <pcl6d/io/far_points.h>
#include <pcl6d/io/scan_reader.h>

#include <cmath>

using namespace pcl6d;
using namespace pcl6d::test;
using Field = pcl::PCLPointField;

TEST(PointsPlace, IsFarWhereNoScannerSees)
{
  PointsPlace place;
  place.radius = 5;
  const auto isFar = [&](double distance) {
    place.middle = {0, distance, 0};
    return place.isFarFrom(Eigen::Vector3d::Zero());
  };
  EXPECT_FALSE(isFar(0));
  EXPECT_FALSE(isFar(499)); // a small thing, but some scanner may see it
  EXPECT_TRUE(isFar(501));
  place.radius = 100;
  EXPECT_FALSE(isFar(1500)); // a mountain side
  EXPECT_TRUE(isFar(1700));  // less than 7 degrees of it
  place.radius = 5000;
  EXPECT_FALSE(isFar(9999));
  EXPECT_TRUE(isFar(10001)); // float has no millimetre there
  EXPECT_FALSE(place.isFarFrom(Eigen::Vector3d(0, 10000, 0)));
}

TEST(PointsPlace, StandsAmidThePointsWhateverElseIsInTheFile)
{
  Places places = moved(room(), kUtm);
  const std::size_t measured = places.size();
  places.insert(places.end(), 2 * measured, Eigen::Vector3d::Zero()); // no returns
  places.insert(places.end(), 9, Eigen::Vector3d::Constant(NAN));
  places.insert(places.end(), 9, Eigen::Vector3d::Constant(1e30));
  places.insert(places.end(), 9, Eigen::Vector3d(0, 1e7, 0));
  const auto place = placeOf(cloudOf(places));
  ASSERT_TRUE(place);
  EXPECT_LT((place->middle - kUtm).norm(), 4); // in the room
  EXPECT_GT(place->radius, 2);
  EXPECT_LT(place->radius, 9);
  EXPECT_LT(place->step, 1e-8); // of double
  const Eigen::Vector3d offset = offsetOfFar(cloudOf(places));
  EXPECT_EQ(offset, Eigen::Vector3d(offset.array().round()));
  EXPECT_LT((offset - kUtm).norm(), 5);
}

TEST(PointsPlace, NearPointsHaveNoOffset)
{
  EXPECT_TRUE(offsetOfFar(cloudOf(room())).isZero(0));
  EXPECT_TRUE(offsetOfFar(cloudOf(moved(room(), {100, 0, 0}))).isZero(0));
  EXPECT_TRUE(offsetOfFar(pcl::PCLPointCloud2()).isZero(0));
  EXPECT_FALSE(placeOf(cloudOf({Eigen::Vector3d::Zero()})));
  EXPECT_FALSE(placeOf(cloudOf({Eigen::Vector3d::Constant(1e20)}))); // no place at all
}

TEST(MoveCloud, MovesNormalsAndMarksWhatWasNotMeasured)
{
  const TempFolder folder;
  writeText(folder / "a.pcd",
            "VERSION 0.7\nFIELDS normal_x x y z normal_y normal_z\nSIZE 4 8 8 8 4 4\n"
            "TYPE F F F F F F\nCOUNT 1 1 1 1 1 1\nWIDTH 2\nHEIGHT 1\nPOINTS 2\n"
            "DATA ascii\n1 1000000.25 0 0 0 0\n1 0 0 0 0 0\n");
  pcl::PCLPointCloud2 cloud = readPcd(folder / "a.pcd");
  const Eigen::Isometry3d turned = planarPose(0, 0, M_PI / 2);
  moveCloud(turned * Eigen::Translation3d(-1000000, 0, 0), cloud);
  EXPECT_NEAR(fieldValues(cloud, "y")->values[0], 0.25, 1e-9);
  EXPECT_NEAR(fieldValues(cloud, "x")->values[0], 0, 1e-9);
  EXPECT_NEAR(fieldValues(cloud, "normal_y")->values[0], 1, 1e-7);
  EXPECT_TRUE(std::isnan(fieldValues(cloud, "x")->values[1]));
  EXPECT_EQ(messageOf<BadArgument>([] {
              pcl::PCLPointCloud2 none;
              moveCloud(Eigen::Isometry3d::Identity(), none);
            }),
            "fields = others, but must be x, y, z of floating point");
}

TEST(FarText, KeepsItsDigitsInEveryFormat)
{
  const TempFolder folder;
  const Places places = moved(room(), kUtm + Eigen::Vector3d(0.123, 0.456, 0.789));
  Places uos;
  for (const auto& p : places)
    uos.emplace_back(-p.y(), p.z(), p.x());
  const std::string vertices = std::to_string(places.size());
  writeText(folder / "a.xyz", rowsOf(places));
  writeText(folder / "a.3d", rowsOf(uos, 100));
  writeText(folder / "a.pcd", pcdHeader(places.size(), 4, "ascii") + rowsOf(places));
  writeText(folder / "a.ply",
            "ply\nformat ascii 1.0\nelement vertex " + vertices +
                "\nproperty float x\nproperty float y\nproperty float z\nend_header\n" +
                rowsOf(places));
  for (const char* const name : {"a.xyz", "a.3d", "a.pcd", "a.ply"}) {
    const ScanCloud scan = readScanCloud(folder / name);
    EXPECT_EQ(typeOf(scan.cloud, "x"), Field::FLOAT64) << name;
    EXPECT_LT(distanceOf(scan.cloud, places), 1e-8) << name;
    const NearScan near = readNearScan(folder / name);
    EXPECT_LT(distanceOf(near.points, moved(places, -near.offset)), 1e-6) << name;
    EXPECT_LT((near.offset - kUtm).norm(), 2.5) << name;
    EXPECT_EQ(near.description.rfind("points lie 5427.4 km from the origin of their "
                                     "coordinates: moved by (-51234",
                                     0),
              0U)
        << near.description;
  }
}

TEST(FarText, OtherFieldsOfAPcdStayWhereTheyBelong)
{
  const TempFolder folder;
  std::ostringstream rows;
  rows << std::setprecision(12);
  const Places places = moved(room(), kUtm);
  for (std::size_t i = 0; i < places.size(); ++i)
    rows << i % 7 << ' ' << places[i].z() << ' ' << 0.5 << ' ' << places[i].x() << ' '
         << 1 << ' ' << 2 << ' ' << i << ' ' << places[i].y() << '\n';
  const std::string n = std::to_string(places.size());
  writeText(folder / "a.pcd",
            "VERSION 0.7\nFIELDS ring z intensity x pair number y\nSIZE 1 4 4 4 2 4 4\n"
            "TYPE U F F F U U F\nCOUNT 1 1 1 1 2 1 1\nWIDTH " +
                n + "\nHEIGHT 1\nPOINTS " + n + "\nDATA ascii\n" + rows.str());
  const pcl::PCLPointCloud2 cloud = readPcd(folder / "a.pcd");
  EXPECT_LT(distanceOf(cloud, places), 1e-5);
  for (const std::size_t i : {0U, 11U, 4499U}) {
    EXPECT_EQ(valueOf<std::uint8_t>(cloud, i, "ring"), i % 7);
    EXPECT_EQ(valueOf<float>(cloud, i, "intensity"), 0.5F);
    EXPECT_EQ(valueOf<std::uint16_t>(cloud, i, "pair", 1), 2);
    EXPECT_EQ(valueOf<std::uint32_t>(cloud, i, "number"), i);
  }
  writePcd(folder / "b.pcd", cloud); // and it can be written again
  EXPECT_LT(distanceOf(readPcd(folder / "b.pcd"), places), 1e-5);
}

TEST(FarText, NearTextIsReadAsFloatWithTheSameBits)
{
  const TempFolder folder;
  const Places places = room();
  writeText(folder / "a.xyz", rowsOf(places));
  writeText(folder / "a.pcd", pcdHeader(places.size(), 4, "ascii") + rowsOf(places));
  for (const char* const name : {"a.xyz", "a.pcd"}) {
    const ScanCloud scan = readScanCloud(folder / name);
    EXPECT_EQ(typeOf(scan.cloud, "x"), Field::FLOAT32) << name;
    EXPECT_EQ(distanceOf(scan.cloud, places), 0) << name;
    const NearScan near = readNearScan(folder / name);
    EXPECT_EQ(near.cloud.data, scan.cloud.data);
    EXPECT_TRUE(near.description.empty());
  }
}

TEST(FarText, FloatsOfABinaryFileTellWhatTheyHaveLost)
{
  const TempFolder folder;
  const Places places = moved(room(), kUtm);
  writeText(folder / "a.pcd",
            pcdHeader(places.size(), 4, "binary") + binaryOf<float>(places));
  const NearScan near = readNearScan(folder / "a.pcd");
  EXPECT_EQ(typeOf(near.cloud, "x"), Field::FLOAT32);
  EXPECT_NE(
      near.description.find(
          ", where float has steps of 0.500 m: digits in between are lost: moved by"),
      std::string::npos)
      << near.description;
}

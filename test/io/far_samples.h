// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "io_test.h"

#include <pcl6d/io/pcd_io.h>
#include <pcl6d/io/scan_fields.h>

#include <algorithm>
#include <iomanip>
#include <random>
#include <sstream>

/** \file Scans of a room in national coordinates. */
namespace pcl6d::test {

inline const Eigen::Vector3d kUtm(512345, 5403210, 317);
using Places = std::vector<Eigen::Vector3d>;

/** Points of a room of 8 m x 6 m x 3 m around the scanner, exact in float. */
inline Places
room(unsigned int seed = 1)
{
  std::mt19937 random(seed);
  const auto part = [&] { return static_cast<double>(random() % 1024) / 1024 - 0.5; };
  Places places;
  for (int i = 0; i < 1500; ++i) {
    places.emplace_back(8 * part(), 6 * part(), -1.5);
    places.emplace_back(i % 2 == 0 ? -4 : 4, 6 * part(), 3 * part());
    places.emplace_back(8 * part(), i % 2 == 0 ? -3 : 3, 3 * part());
  }
  return places;
}

inline Places
moved(Places places, const Eigen::Isometry3d& motion)
{
  for (Eigen::Vector3d& p : places)
    p = motion * p;
  return places;
}

inline Places
moved(const Places& places, const Eigen::Vector3d& by)
{
  return moved(places, Eigen::Isometry3d(Eigen::Translation3d(by)));
}

inline std::string
rowsOf(const Places& places, double scale = 1)
{
  std::ostringstream rows;
  rows << std::fixed << std::setprecision(10);
  for (const auto& p : places)
    rows << scale * p.x() << ' ' << scale * p.y() << ' ' << scale * p.z() << '\n';
  return rows.str();
}

inline std::string
pcdHeader(std::size_t points, int size, const std::string& data)
{
  const std::string n = std::to_string(points), s = std::to_string(size);
  return "VERSION 0.7\nFIELDS x y z\nSIZE " + s + ' ' + s + ' ' + s +
         "\nTYPE F F F\nCOUNT 1 1 1\nWIDTH " + n +
         "\nHEIGHT 1\nVIEWPOINT 0 0 0 1 0 0 0\nPOINTS " + n + "\nDATA " + data + "\n";
}

template <typename T>
inline std::string
binaryOf(const Places& places)
{
  std::vector<T> numbers;
  for (const auto& p : places)
    for (int axis = 0; axis < 3; ++axis)
      numbers.push_back(static_cast<T>(p[axis]));
  return bytesOf(numbers);
}

inline pcl::PCLPointCloud2
cloudOf(const Places& places)
{
  const TempFolder folder;
  writeText(folder / "a.pcd",
            pcdHeader(places.size(), 8, "binary") + binaryOf<double>(places));
  return readPcd(folder / "a.pcd");
}

inline std::uint8_t
typeOf(const pcl::PCLPointCloud2& cloud, const std::string& name)
{
  for (const auto& field : cloud.fields)
    if (field.name == name)
      return field.datatype;
  return 0;
}

/** \return the largest distance of two points of a number [m] */
inline double
distanceOf(const pcl::PCLPointCloud2& cloud, const Places& places)
{
  const auto x = *fieldValues(cloud, "x"), y = *fieldValues(cloud, "y"),
             z = *fieldValues(cloud, "z");
  EXPECT_EQ(x.values.size(), places.size());
  double distance = 0;
  for (std::size_t i = 0; i < std::min(places.size(), x.values.size()); ++i)
    distance = std::max(
        distance,
        (Eigen::Vector3d(x.values[i], y.values[i], z.values[i]) - places[i]).norm());
  return distance;
}

inline double
distanceOf(const Points& points, const Places& places)
{
  EXPECT_EQ(points.size(), places.size());
  double distance = 0;
  for (std::size_t i = 0; i < std::min(places.size(), points.size()); ++i)
    distance = std::max(distance, (points[i].cast<double>() - places[i]).norm());
  return distance;
}

} // namespace pcl6d::test

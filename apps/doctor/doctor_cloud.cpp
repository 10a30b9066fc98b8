// SPDX-License-Identifier: BSD-3-Clause
#include "doctor/doctor_cloud.h"

#include <pcl6d/common/error.h>
#include <pcl6d/io/pcd_io.h>
#include <pcl6d/io/scan_fields.h>
#include <pcl6d/io/text.h>

#include <pcl/conversions.h>
#include <pcl/point_cloud.h>
#include <pcl/point_types.h>

#include <algorithm>
#include <array>
#include <numeric>

namespace pcl6d::app {

namespace {
/** \return three fields of every row; empty if a field is missing */
std::vector<Eigen::Vector3d>
rowsOf(const pcl::PCLPointCloud2& cloud, const std::array<const char*, 3>& names)
{
  std::vector<Eigen::Vector3d> rows;
  for (int axis = 0; axis < 3; ++axis) {
    const auto field = fieldValues(cloud, names[static_cast<std::size_t>(axis)]);
    if (!field)
      return {};
    rows.resize(field->values.size());
    for (std::size_t i = 0; i < rows.size(); ++i)
      rows[i][axis] = field->values[i];
  }
  return rows;
}

bool
isDoubleField(const pcl::PCLPointCloud2& cloud)
{
  return std::any_of(
      cloud.fields.begin(), cloud.fields.end(), [](const pcl::PCLPointField& f) {
        return f.name == "x" && f.datatype == pcl::PCLPointField::FLOAT64;
      });
}

/** \return number of rows whose coordinates are changed by PCL's conversion */
std::size_t
lostByPcl(const pcl::PCLPointCloud2& cloud, const std::vector<Eigen::Vector3d>& rows)
{
  pcl::PointCloud<pcl::PointXYZ> converted;
  pcl::fromPCLPointCloud2(cloud, converted);
  if (converted.size() != rows.size())
    return rows.size();
  std::size_t lost = 0;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Eigen::Vector3f p = converted[i].getVector3fMap();
    if (rows[i].allFinite() ? p != rows[i].cast<float>() : p.allFinite())
      ++lost;
  }
  return lost;
}

bool
isIdentity(const Eigen::Isometry3d& pose)
{
  return pose.matrix() == Eigen::Matrix4d::Identity();
}

void
addPcd(const std::string& file, pcl::PCLPointCloud2& cloud, DoctorCloud& read)
{
  cloud = readPcd(file);
  read.left_out = 0;
  const Eigen::Isometry3d viewpoint = readPcdViewpoint(file);
  if (!isIdentity(viewpoint))
    read.viewpoint = viewpoint;
}
} // namespace

std::vector<std::size_t>
DoctorCloud::finiteRows(bool chosen) const
{
  std::vector<std::size_t> candidates;
  if (chosen && indices)
    candidates.assign(indices->begin(), indices->end());
  else {
    candidates.resize(rows.size());
    std::iota(candidates.begin(), candidates.end(), std::size_t(0));
  }
  candidates.erase(
      std::remove_if(candidates.begin(),
                     candidates.end(),
                     [this](std::size_t i) { return !rows[i].allFinite(); }),
      candidates.end());
  return candidates;
}

Points
DoctorCloud::localPoints(const std::vector<std::size_t>& of) const
{
  Points points;
  points.reserve(of.size());
  for (const std::size_t i : of)
    points.push_back((rows[i] - offset).cast<float>());
  return points;
}

std::size_t
DoctorCloud::numNotFinite() const
{
  return static_cast<std::size_t>(std::count_if(
      rows.begin(), rows.end(), [](const auto& p) { return !p.allFinite(); }));
}

DoctorCloud
readDoctorCloud(const std::string& file, ScanFormat format)
{
  const ScanFormat known =
      format == ScanFormat::kAuto ? scanFormatOfExtension(file) : format;
  ScanCloud scan = readScanCloud(file, format); // throws naming the error of the file
  DoctorCloud read;
  read.file = file;
  read.left_out = scan.dropped;
  const bool is_pcd = known == ScanFormat::kPcd;
  if (is_pcd)
    addPcd(file, scan.cloud, read);
  read.rows = rowsOf(scan.cloud, {"x", "y", "z"});
  for (const auto& n : rowsOf(scan.cloud, {"normal_x", "normal_y", "normal_z"}))
    read.normals.push_back(n.cast<float>());
  for (const auto& field : scan.cloud.fields)
    read.fields.push_back(field.name);
  read.width = scan.cloud.width;
  read.height = scan.cloud.height;
  read.in_double = isDoubleField(scan.cloud);
  if (is_pcd)
    read.lost_by_pcl = lostByPcl(scan.cloud, read.rows);
  return read;
}

pcl::Indices
readRowNumbers(const std::string& file, const DoctorCloud& cloud)
{
  if (cloud.left_out > 0)
    throw IoFailed(file + ": " + cloud.file + " has " +
                   text::counted(cloud.left_out, "row") +
                   " without finite coordinates, left out by the reader of the format: "
                   "the numbers of points are not unique");
  const std::string content = text::readFile(file);
  pcl::Indices numbers;
  for (text::Lines lines(content); lines.next();) {
    text::Tokens tokens(lines.line());
    for (auto token = tokens.next(); !token.empty(); token = tokens.next()) {
      long long number = 0;
      if (!text::parseNumber(token, number))
        text::failAt(
            file, lines.number(), text::quoted(token) + " is no number of a point");
      if (number < 0 || static_cast<std::size_t>(number) >= cloud.rows.size())
        text::failAt(file,
                     lines.number(),
                     std::to_string(number) + ", but must be >= 0 and below the " +
                         text::counted(cloud.rows.size(), "point") + " of " +
                         cloud.file);
      numbers.push_back(static_cast<pcl::index_t>(number));
    }
  }
  return numbers;
}

} // namespace pcl6d::app

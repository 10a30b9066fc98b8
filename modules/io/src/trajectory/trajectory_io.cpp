// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory/rigid_pose.h"
#include "trajectory/uos_frame.h"

#include <pcl6d/common/angle.h>
#include <pcl6d/common/error.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/trajectory_io.h>

#include <cmath>
#include <ostream>

namespace pcl6d {

using namespace io;

namespace {

constexpr std::size_t kKittiColumns = 12;
constexpr std::size_t kTumColumns = 8;
Eigen::Isometry3d
poseFromKitti(const std::filesystem::path& path,
              std::size_t line,
              const std::vector<double>& row)
{
  const Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>> T(row.data());
  return rigidPose(
      path, line, Eigen::Matrix3d(T.leftCols<3>()), Eigen::Vector3d(T.col(3)));
}

Eigen::Isometry3d
poseFromTum(const std::filesystem::path& path,
            std::size_t line,
            const std::vector<double>& row)
{
  return rigidPose(path,
                   line,
                   Eigen::Quaterniond(row[7], row[4], row[5], row[6]),
                   Eigen::Vector3d(row[1], row[2], row[3]));
}

void
addStamp(const std::filesystem::path& path,
         std::size_t line,
         double stamp,
         std::vector<double>& stamps)
{
  std::string shown;
  text::appendNumber(shown, stamp);
  if (!std::isfinite(stamp))
    text::failAt(path, line, "the stamp " + shown + " is not finite");
  if (!stamps.empty() && !(stamp > stamps.back())) {
    shown += " does not follow ";
    text::appendNumber(shown, stamps.back());
    text::failAt(path, line, "the stamp " + shown + "; stamps must increase");
  }
  stamps.push_back(stamp);
}

/** \return the number of columns that all rows must have, from the first row */
std::size_t
columnsOf(const std::filesystem::path& path, std::size_t line, std::size_t columns)
{
  if (columns != kKittiColumns && columns != kTumColumns)
    text::failAt(path,
                 line,
                 "expected 12 numbers (KITTI) or 8 (TUM), got " +
                     std::to_string(columns));
  return columns;
}

void
appendRow(std::string& text, const double* begin, const double* end)
{
  for (const double* value = begin; value != end; ++value) {
    if (value != begin)
      text += ' ';
    text::appendNumber(text, *value);
  }
  text += '\n';
}

} // namespace

Trajectory
readTrajectory(const std::filesystem::path& path)
{
  const std::string content = text::readFile(path);
  Trajectory trajectory;
  std::vector<double> row;
  std::size_t columns = 0;
  for (text::Lines lines(content); lines.next();) {
    const auto first = text::Tokens(lines.line()).next();
    if (first.empty() || first.front() == '#')
      continue;
    text::readRow(path, lines, row);
    if (columns == 0)
      columns = columnsOf(path, lines.number(), row.size());
    if (row.size() != columns)
      text::failAt(path,
                   lines.number(),
                   "expected " + std::to_string(columns) + " numbers, got " +
                       std::to_string(row.size()));
    if (columns == kTumColumns)
      addStamp(path, lines.number(), row[0], trajectory.stamps);
    trajectory.poses.push_back(columns == kTumColumns
                                   ? poseFromTum(path, lines.number(), row)
                                   : poseFromKitti(path, lines.number(), row));
  }
  if (trajectory.poses.empty())
    text::fail(path, "holds no pose");
  return trajectory;
}

void
writeTrajectoryKitti(const std::filesystem::path& path, const Trajectory& trajectory)
{
  std::string text;
  for (const auto& pose : trajectory.poses) {
    const Eigen::Matrix<double, 3, 4, Eigen::RowMajor> T = pose.matrix().topRows<3>();
    appendRow(text, T.data(), T.data() + T.size());
  }
  writeFileAtomically(path, [&](std::ostream& stream) { stream << text; });
}

void
writeTrajectoryTum(const std::filesystem::path& path, const Trajectory& trajectory)
{
  if (trajectory.stamps.size() != trajectory.poses.size())
    throw BadArgument("a TUM trajectory needs one stamp per pose, but there are " +
                      text::counted(trajectory.stamps.size(), "stamp") + " and " +
                      text::counted(trajectory.poses.size(), "pose"));
  std::string text;
  for (std::size_t i = 0; i < trajectory.poses.size(); ++i) {
    const Eigen::Vector3d t = trajectory.poses[i].translation();
    const Eigen::Quaterniond q =
        canonical(Eigen::Quaterniond(trajectory.poses[i].linear()));
    const double row[] = {
        trajectory.stamps[i], t.x(), t.y(), t.z(), q.x(), q.y(), q.z(), q.w()};
    appendRow(text, std::begin(row), std::end(row));
  }
  writeFileAtomically(path, [&](std::ostream& stream) { stream << text; });
}

std::vector<double>
readStamps(const std::filesystem::path& path)
{
  const std::string content = text::readFile(path);
  std::vector<double> stamps;
  std::vector<double> row;
  for (text::Lines lines(content); lines.next();) {
    const auto first = text::Tokens(lines.line()).next();
    if (first.empty() || first.front() == '#')
      continue;
    text::readRow(path, lines, row);
    if (row.size() != 1)
      text::failAt(path,
                   lines.number(),
                   "expected 1 number (a time stamp), got " +
                       std::to_string(row.size()));
    addStamp(path, lines.number(), row[0], stamps);
  }
  if (stamps.empty())
    text::fail(path, "holds no time stamp");
  return stamps;
}

void
writeStamps(const std::filesystem::path& path, const std::vector<double>& stamps)
{
  std::string text;
  for (const double stamp : stamps)
    appendRow(text, &stamp, &stamp + 1);
  writeFileAtomically(path, [&](std::ostream& stream) { stream << text; });
}

Eigen::Isometry3d
readUosPose(const std::filesystem::path& path)
{
  const std::string content = text::readFile(path);
  std::vector<double> values;
  std::vector<double> row;
  for (text::Lines lines(content); lines.next();) {
    text::readRow(path, lines, row);
    for (const double value : row)
      if (!std::isfinite(value))
        text::failAt(path, lines.number(), "a number is not finite");
    values.insert(values.end(), row.begin(), row.end());
  }
  if (values.size() != 6)
    text::fail(path,
               "expected 6 numbers (position in cm, angles in degrees), got " +
                   std::to_string(values.size()));
  // 3DTK turns about x first in its own axes: R = Rx(a) Ry(b) Rz(c).
  const Eigen::Vector3d angles = kDegree * Eigen::Vector3d(&values[3]);
  const Eigen::Matrix3d R =
      rotationFromEuler({-angles.x(), -angles.y(), -angles.z()}).transpose();
  if (!R.allFinite())
    text::fail(path, "an angle is out of range");
  return poseFromUos(R, Eigen::Vector3d(&values[0]));
}

void
writeUosPose(const std::filesystem::path& path, const Eigen::Isometry3d& T_world_scan)
{
  const Eigen::Matrix4d T = poseToUos(T_world_scan);
  const EulerAngles e =
      eulerFromRotation(Eigen::Matrix3d(T.topLeftCorner<3, 3>().transpose()));
  const Eigen::Vector3d angles =
      Eigen::Vector3d(-e.roll, -e.pitch, -e.yaw) / kDegree; // see readUosPose()
  const Eigen::Vector3d t = T.topRightCorner<3, 1>();
  std::string text;
  appendRow(text, t.data(), t.data() + 3);
  appendRow(text, angles.data(), angles.data() + 3);
  writeFileAtomically(path, [&](std::ostream& stream) { stream << text; });
}

} // namespace pcl6d

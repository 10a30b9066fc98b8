// SPDX-License-Identifier: BSD-3-Clause
#include "layout/date_stamp.h"
#include "scan/table/table_columns.h"
#include "trajectory/pose_rows.h"
#include "trajectory/uos_frame.h"

#include <pcl6d/common/angle.h>
#include <pcl6d/common/error.h>
#include <pcl6d/common/rotation.h>
#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/text.h>
#include <pcl6d/io/trajectory_io.h>

#include <cctype>
#include <cmath>
#include <optional>
#include <ostream>

namespace pcl6d {

using namespace io;

namespace {

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

/** Reads a row of numbers separated by blanks, tabs or commas. \return false for a heading: the
 * row begins with a word */
bool
readPoseNumbers(const std::filesystem::path& path,
                const text::Lines& lines,
                std::vector<double>& row)
{
  row.clear();
  if (const auto token = unclearDecimalComma(lines.line()); !token.empty())
    text::failAt(path, lines.number(), text::quoted(token) + " is not a number");
  text::Tokens tokens(lines.line(), ",");
  for (auto token = tokens.next(); !token.empty(); token = tokens.next()) {
    double value = 0;
    const bool is_number = text::parseNumber(token, value);
    if (!is_number && row.empty() && std::isalpha(static_cast<unsigned char>(token[0])))
      return false;
    if (!is_number)
      text::failAt(path, lines.number(), text::quoted(token) + " is not a number");
    row.push_back(value);
  }
  return true;
}

/** \return the order of the numbers in all rows, from the first row */
PoseRow
kindOfRows(const std::filesystem::path& path,
           std::size_t line,
           const std::vector<double>& row,
           const PoseHeading& heading)
{
  const auto kind = poseRowOf(row, heading);
  if (!kind && row.size() == 16)
    text::failAt(path, line, "the last four of 16 numbers are not 0 0 0 1");
  if (!kind)
    text::failAt(path,
                 line,
                 "expected 12 numbers (KITTI) or 8 (TUM), or 9, 13, 16 or 17, got " +
                     std::to_string(row.size()));
  return *kind;
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
  std::optional<PoseRow> kind;
  std::size_t columns = 0;
  PoseHeading heading;
  for (text::Lines lines(content); lines.next();) {
    const auto first = text::Tokens(lines.line()).next();
    if (first.empty() || first.front() == '#') {
      readPoseHeading(lines.line(), heading);
      continue;
    }
    if (!readPoseNumbers(path, lines, row)) {
      if (kind)
        text::failAt(path, lines.number(), text::quoted(first) + " is not a number");
      readPoseHeading(lines.line(), heading);
      continue;
    }
    heading.has_commas = lines.line().find(',') != std::string_view::npos;
    if (!kind) {
      kind = kindOfRows(path, lines.number(), row, heading);
      columns = row.size();
    }
    if (row.size() != columns)
      text::failAt(path,
                   lines.number(),
                   "expected " + std::to_string(columns) + " numbers, got " +
                       std::to_string(row.size()));
    if (const auto stamp = stampOfRow(*kind, row))
      addStamp(path, lines.number(), *stamp, trajectory.stamps);
    trajectory.poses.push_back(poseOfRow(path, lines.number(), *kind, row));
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
    throw BadArgument("a TUM trajectory needs a stamp per pose, but has " +
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
    if (const auto date = secondsOfDate(lines.line())) {
      addStamp(path, lines.number(), *date, stamps);
      continue;
    }
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
  // 3DTK turns about x first, in the rotated axes: R = Rx(a) Ry(b) Rz(c).
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

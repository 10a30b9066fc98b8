// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory/rigid_pose.h"
#include "trajectory/uos_frame.h"

#include <pcl6d/io/atomic_file.h>
#include <pcl6d/io/frames_io.h>

#include <ostream>

namespace pcl6d {

using namespace io;

namespace {

constexpr std::size_t kColumns = 17; // 4x4 matrix and the kind
constexpr int kLastKind = static_cast<int>(FrameKind::kElch);

Frame
frameFromRow(const std::filesystem::path& path,
             std::size_t line,
             const std::vector<double>& row)
{
  const Eigen::Map<const Eigen::Matrix4d> T(row.data()); // column by column
  if (T.row(3) != Eigen::RowVector4d(0, 0, 0, 1))
    text::failAt(path, line, "not a rigid motion (the last row must be 0 0 0 1)");
  const int kind =
      static_cast<int>(row[16] >= 0 && row[16] <= kLastKind ? row[16] : -1);
  if (kind != row[16]) {
    std::string shown;
    text::appendNumber(shown, row[16]);
    text::failAt(path,
                 line,
                 "unknown kind of frame " + shown + ", must be 0 to " +
                     std::to_string(kLastKind));
  }
  const Eigen::Isometry3d pose = poseFromUos(Eigen::Matrix3d(T.topLeftCorner<3, 3>()),
                                             Eigen::Vector3d(T.topRightCorner<3, 1>()));
  return {rigidPose(path, line, pose.linear(), pose.translation()),
          static_cast<FrameKind>(kind)};
}

} // namespace

void
writeFrames(const std::filesystem::path& path, const std::vector<Frame>& frames)
{
  std::string text;
  for (const auto& frame : frames) {
    const Eigen::Matrix4d T = poseToUos(frame.T_world_scan);
    for (Eigen::Index i = 0; i < T.size(); ++i) {
      text::appendNumber(text, T.data()[i]); // column by column
      text += ' ';
    }
    text += std::to_string(static_cast<int>(frame.kind)) + '\n';
  }
  writeFileAtomically(path, [&](std::ostream& stream) { stream << text; });
}

std::vector<Frame>
readFrames(const std::filesystem::path& path)
{
  const std::string content = text::readFile(path);
  std::vector<Frame> frames;
  std::vector<double> row;
  for (text::Lines lines(content); lines.next();) {
    text::readRow(path, lines, row);
    if (row.empty())
      continue;
    if (row.size() != kColumns)
      text::failAt(path,
                   lines.number(),
                   "expected 17 numbers, got " + std::to_string(row.size()));
    frames.push_back(frameFromRow(path, lines.number(), row));
  }
  return frames;
}

} // namespace pcl6d

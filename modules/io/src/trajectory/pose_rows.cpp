// SPDX-License-Identifier: BSD-3-Clause
#include "trajectory/pose_rows.h"
#include "trajectory/rigid_pose.h"

#include <cmath>

namespace pcl6d::io {

namespace {
// [s] Larger stamps are nanoseconds: three million years from 1970 in seconds, 28 hours in
// nanoseconds.
constexpr double kLatestSecond = 1e14;
constexpr double kNanosecond = 1e-9; // [s]

bool
isLastMatrixRow(const double* row)
{
  return row[0] == 0 && row[1] == 0 && row[2] == 0 && row[3] == 1;
}

/** \param[in] T the first three rows of a matrix */
Eigen::Isometry3d
poseFromMatrix(const std::filesystem::path& path, std::size_t line, const double* T)
{
  const Eigen::Map<const Eigen::Matrix<double, 3, 4, Eigen::RowMajor>> rows(T);
  return rigidPose(
      path, line, Eigen::Matrix3d(rows.leftCols<3>()), Eigen::Vector3d(rows.col(3)));
}

/** \return the position of a quaternion part's name in the heading, for the names used by
 * several programs */
std::size_t
placeOfPart(std::string_view line, char part)
{
  for (const std::string_view before : {"q_RS_", "q_", "q", "qrs_"})
    if (const std::size_t at = line.find(std::string(before) + part);
        at != std::string_view::npos)
      return at;
  return std::string_view::npos;
}
} // namespace

void
readPoseHeading(std::string_view line, PoseHeading& heading)
{
  const std::size_t w = placeOfPart(line, 'w'), x = placeOfPart(line, 'x');
  if (w != std::string_view::npos && x != std::string_view::npos)
    heading.scalar_first = w < x;
}

std::optional<PoseRow>
poseRowOf(const std::vector<double>& row, const PoseHeading& heading)
{
  // Without a heading, EuRoC's order is recognised by commas and nanoseconds.
  const bool scalar_first =
      heading.scalar_first ||
      (heading.has_commas && !row.empty() && row[0] > kLatestSecond);
  switch (row.size()) {
  case 8:
    return scalar_first ? PoseRow::kScalarFirst : PoseRow::kTum;
  case 9:
    return PoseRow::kTumId;
  case 12:
    return PoseRow::kKitti;
  case 13:
    return PoseRow::kStampKitti;
  case 16:
    if (isLastMatrixRow(&row[12]))
      return PoseRow::kMatrix;
    break;
  case 17:
    return isLastMatrixRow(&row[13]) ? PoseRow::kStampMatrix : PoseRow::kGroundTruth17;
  default:
    break;
  }
  return std::nullopt;
}

std::optional<double>
stampOfRow(PoseRow kind, const std::vector<double>& row)
{
  if (kind == PoseRow::kKitti || kind == PoseRow::kMatrix)
    return std::nullopt;
  return row[0] > kLatestSecond ? row[0] * kNanosecond : row[0];
}

Eigen::Isometry3d
poseOfRow(const std::filesystem::path& path,
          std::size_t line,
          PoseRow kind,
          const std::vector<double>& row)
{
  switch (kind) {
  case PoseRow::kKitti:
  case PoseRow::kMatrix:
    return poseFromMatrix(path, line, row.data());
  case PoseRow::kStampKitti:
  case PoseRow::kStampMatrix:
    return poseFromMatrix(path, line, row.data() + 1);
  case PoseRow::kScalarFirst:
  case PoseRow::kGroundTruth17:
    return rigidPose(path,
                     line,
                     Eigen::Quaterniond(row[4], row[5], row[6], row[7]),
                     Eigen::Vector3d(row[1], row[2], row[3]));
  default:
    return rigidPose(path,
                     line,
                     Eigen::Quaterniond(row[7], row[4], row[5], row[6]),
                     Eigen::Vector3d(row[1], row[2], row[3]));
  }
}

} // namespace pcl6d::io

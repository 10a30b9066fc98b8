// SPDX-License-Identifier: BSD-3-Clause
#include "graph/constraint_rows.h"
#include "trajectory/rigid_pose.h"

#include <pcl6d/common/information.h>
#include <pcl6d/common/pose.h>
#include <pcl6d/common/rotation.h>

#include <cmath>

namespace pcl6d::io {

namespace {
using Matrix6 = Eigen::Matrix<double, 6, 6>;
constexpr std::size_t kPoseNumbers = 7, kTriangle6 = 21, kTriangle3 = 6, kTriangle2 = 3;
constexpr bool kQuaternion = true, kPlanar = true;

constexpr ConstraintTag kConstraintTags[] = {
    {{"VERTEX_TRACKXYZ", false, false, 1, 3}, ConstraintKind::kLandmark},
    {{"EDGE_SE3_TRACKXYZ", true, false, 3, 3 + kTriangle3}, ConstraintKind::kSighting},
    {{"EDGE_SE3_PRIOR", true, kQuaternion, 2, kPoseNumbers + kTriangle6},
     ConstraintKind::kPrior},
    {{"EDGE_SE2_PRIOR", true, false, 1, 3 + kTriangle3, kPlanar},
     ConstraintKind::kPlanarPrior},
    {{"EDGE_PRIOR_SE2", true, false, 1, 3 + kTriangle3, kPlanar},
     ConstraintKind::kPlanarPrior},
    {{"EDGE_PRIOR_SE2_XY", true, false, 1, 2 + kTriangle2, kPlanar},
     ConstraintKind::kPositionPrior},
    {{"VERTEX_SWITCH", false, false, 1, 1}, ConstraintKind::kSwitch},
    {{"EDGE_SWITCH_PRIOR", true, false, 1, 2}, ConstraintKind::kSwitchPrior},
    {{"EDGE_SE3_SWITCHABLE", true, kQuaternion, 3, kPoseNumbers + kTriangle6},
     ConstraintKind::kSwitchedLink},
    {{"EDGE_SE2_SWITCHABLE", true, false, 3, 3 + kTriangle3, kPlanar},
     ConstraintKind::kSwitchedLink}};

/** \return the information about the first axes from an upper triangle */
template <int N>
Matrix6
informationOfTriangle(const std::filesystem::path& path,
                      const GraphRow& row,
                      const double* entry)
{
  Matrix6 information = Matrix6::Zero();
  for (int i = 0; i < N; ++i)
    for (int j = i; j < N; ++j)
      information(i, j) = information(j, i) = *entry++;
  const std::string fault = informationFault(information);
  if (!fault.empty())
    text::failAt(path, row.line, "the information matrix is " + fault);
  return semidefinite(information);
}

/** \return the prior of a position in the plane, with equal information about z, roll and pitch,
 * which agree in all planar poses */
PosePrior
positionPrior(const std::filesystem::path& path, const GraphRow& row)
{
  PosePrior prior;
  prior.T_world_pose = planarPose(row.numbers[0], row.numbers[1], 0);
  prior.information = informationOfTriangle<2>(path, row, row.numbers.data() + 2);
  const double mean = 0.5 * (prior.information(0, 0) + prior.information(1, 1));
  prior.information(2, 2) = prior.information(3, 3) = prior.information(4, 4) = mean;
  return prior;
}

/** \return the prior of a sensor, converted to the pose of the sensor's carrier: exact for pure
 * rotations, else to first order of the error */
PosePrior
priorOfSensor(const PosePrior& of_sensor, const Eigen::Isometry3d& T_pose_sensor)
{
  PosePrior prior = of_sensor;
  const Eigen::Isometry3d back = T_pose_sensor.inverse();
  prior.T_world_pose = of_sensor.T_world_pose * back;
  // The error at the sensor is back * error at the pose * back^-1.
  const Eigen::Vector3d t = back.translation();
  Eigen::Matrix3d cross;
  cross << 0, -t.z(), t.y(), t.z(), 0, -t.x(), -t.y(), t.x(), 0;
  Matrix6 J = Matrix6::Zero();
  J.topLeftCorner<3, 3>() = J.bottomRightCorner<3, 3>() = back.linear();
  J.topRightCorner<3, 3>() = cross * back.linear();
  const Matrix6 information = J.transpose() * of_sensor.information * J;
  prior.information = 0.5 * (information + information.transpose());
  return prior;
}

std::size_t
indexOf(const std::filesystem::path& path,
        const ConstraintRows::Index& known,
        std::size_t id,
        std::size_t line,
        const std::string& what)
{
  const auto found = known.find(id);
  if (found == known.end())
    text::failAt(path, line, "there is no " + what + " " + std::to_string(id));
  return found->second;
}

void
addId(const std::filesystem::path& path,
      const GraphRow& row,
      const ConstraintRows::Index& poses,
      std::size_t index,
      ConstraintRows::Index& known)
{
  if (poses.count(row.ids[0]) > 0 || !known.emplace(row.ids[0], index).second)
    text::failAt(
        path, row.line, "vertex " + std::to_string(row.ids[0]) + " is given twice");
}
} // namespace

const ConstraintTag*
constraintTag(std::string_view name)
{
  for (const auto& tag : kConstraintTags)
    if (tag.row.name == name)
      return &tag;
  return nullptr;
}

void
ConstraintRows::addOffset(const std::filesystem::path& path,
                          const text::Lines& lines,
                          text::Tokens& tokens)
{
  static constexpr GraphTag kOffset = {
      "PARAMS_SE3OFFSET", false, true, 1, kPoseNumbers};
  GraphRow row;
  readGraphRow(path, lines, tokens, kOffset, row);
  offsets_[row.ids[0]] = poseOfRow(path, row);
}

void
ConstraintRows::add(const std::filesystem::path& path,
                    ConstraintKind kind,
                    const GraphRow& row,
                    std::size_t link)
{
  for (const double number : row.numbers)
    if (!std::isfinite(number))
      text::failAt(path, row.line, "a number is not finite");
  rows_.push_back({row, kind, link});
}

Eigen::Isometry3d
ConstraintRows::offsetOf(const std::filesystem::path& path,
                         const GraphRow& row,
                         std::size_t id) const
{
  const auto found = offsets_.find(id);
  if (found == offsets_.end())
    text::failAt(path, row.line, "no line is PARAMS_SE3OFFSET " + std::to_string(id));
  return found->second;
}

void
ConstraintRows::addLandmarks(const std::filesystem::path& path,
                             const Index& poses,
                             GraphConstraints& found) const
{
  Index known;
  std::vector<std::size_t> lines;
  for (const auto& [row, kind, link] : rows_)
    if (kind == ConstraintKind::kLandmark) {
      addId(path, row, poses, found.landmarks.size(), known);
      found.landmarks.emplace_back(row.numbers[0], row.numbers[1], row.numbers[2]);
      found.landmark_ids.push_back(row.ids[0]);
      lines.push_back(row.line);
    }
  for (const auto& [row, kind, link] : rows_)
    if (kind == ConstraintKind::kSighting) {
      LandmarkSighting sighting;
      sighting.pose = indexOf(path, poses, row.ids[0], row.line, "vertex");
      sighting.landmark = indexOf(path, known, row.ids[1], row.line, "VERTEX_TRACKXYZ");
      const Eigen::Isometry3d T_pose_sensor = offsetOf(path, row, row.ids[2]);
      const double* const n = row.numbers.data();
      sighting.position = T_pose_sensor * Eigen::Vector3d(n[0], n[1], n[2]);
      const Eigen::Matrix3d R = T_pose_sensor.linear();
      const Eigen::Matrix3d information =
          R * informationOfTriangle<3>(path, row, n + 3).topLeftCorner<3, 3>() *
          R.transpose();
      sighting.information = 0.5 * (information + information.transpose());
      lines[sighting.landmark] = 0;
      found.sightings.push_back(sighting);
    }
  for (const std::size_t line : lines)
    if (line > 0)
      text::failAt(path, line, "no EDGE_SE3_TRACKXYZ leads to this landmark");
}

void
ConstraintRows::addPriors(const std::filesystem::path& path,
                          const Index& poses,
                          GraphConstraints& found) const
{
  for (const auto& [row, kind, link] : rows_) {
    PosePrior prior;
    if (kind == ConstraintKind::kPositionPrior)
      prior = positionPrior(path, row);
    else if (kind == ConstraintKind::kPrior || kind == ConstraintKind::kPlanarPrior) {
      prior.T_world_pose = poseOfRow(path, row);
      prior.information = informationOfRow(path, row);
    }
    else
      continue;
    if (kind == ConstraintKind::kPrior)
      prior = priorOfSensor(prior, offsetOf(path, row, row.ids[1]));
    prior.pose = indexOf(path, poses, row.ids[0], row.line, "vertex");
    found.priors.push_back(prior);
  }
}

void
ConstraintRows::addSwitches(const std::filesystem::path& path,
                            const Index& poses,
                            GraphConstraints& found) const
{
  Index known, priors, linked;
  for (std::size_t k = 0; k < rows_.size(); ++k) {
    const auto& [row, kind, link] = rows_[k];
    if (kind == ConstraintKind::kSwitch)
      addId(path, row, poses, k, known);
    else if (kind == ConstraintKind::kSwitchPrior &&
             !priors.emplace(row.ids[0], k).second)
      text::failAt(
          path, row.line, "switch " + std::to_string(row.ids[0]) + " has two priors");
  }
  for (const auto& [row, kind, link] : rows_) {
    if (kind != ConstraintKind::kSwitchedLink)
      continue;
    const std::size_t id = row.ids[2];
    LinkSwitch one;
    one.id = id;
    one.link = link;
    one.value =
        rows_[indexOf(path, known, id, row.line, "VERTEX_SWITCH")].row.numbers[0];
    const GraphRow& prior =
        rows_[indexOf(path, priors, id, row.line, "EDGE_SWITCH_PRIOR of switch")].row;
    one.prior = prior.numbers[0];
    one.information = prior.numbers[1];
    if (one.information <= 0)
      text::failAt(path, prior.line, "the information of a switch must be > 0");
    if (!linked.emplace(id, link).second)
      text::failAt(path, row.line, "switch " + std::to_string(id) + " has two links");
    found.switches.push_back(one);
  }
}

GraphConstraints
ConstraintRows::resolved(const std::filesystem::path& path, const Index& poses) const
{
  GraphConstraints found;
  addLandmarks(path, poses, found);
  addPriors(path, poses, found);
  addSwitches(path, poses, found);
  return found;
}

} // namespace pcl6d::io

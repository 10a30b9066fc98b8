// SPDX-License-Identifier: BSD-3-Clause
#include "graph/pose_graph_row.h"
#include "trajectory/rigid_pose.h"

#include <pcl6d/common/information.h>
#include <pcl6d/common/rotation.h>

namespace pcl6d::io {

namespace {
using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr std::size_t kTriangle = 21;      // numbers of a symmetric 6x6 matrix
constexpr std::size_t kPlanarTriangle = 6; // of a symmetric 3x3 matrix
constexpr GraphTag kTags[] = {{"VERTEX_SE3:QUAT", false, true, 1, 7},
                              {"EDGE_SE3:QUAT", true, true, 2, 7 + kTriangle},
                              {"VERTEX_SE2", false, false, 1, 3, true},
                              {"EDGE_SE2", true, false, 2, 3 + kPlanarTriangle, true},
                              {"VERTEX3", false, false, 1, 6},
                              {"EDGE3", true, false, 2, 6 + kTriangle}};

/** Factor from the rotation vector to the rotation of the file: 0.5 for g2o. */
double
rotationScale(const GraphTag& tag)
{
  return tag.has_quaternion ? 0.5 : 1.0;
}

Matrix6
scaledRotation(Matrix6 information, double scale)
{
  information.topRightCorner<3, 3>() *= scale;
  information.bottomLeftCorner<3, 3>() *= scale;
  information.bottomRightCorner<3, 3>() *= scale * scale;
  return information;
}
} // namespace

const GraphTag*
graphTag(std::string_view name)
{
  for (const auto& tag : kTags)
    if (tag.name == name)
      return &tag;
  return nullptr;
}

std::size_t
readVertexId(const std::filesystem::path& path,
             const text::Lines& lines,
             std::string_view token)
{
  std::size_t id = 0;
  if (!text::parseNumber(token, id))
    text::failAt(path, lines.number(), text::quoted(token) + " is not a vertex id");
  return id;
}

void
readGraphRow(const std::filesystem::path& path,
             const text::Lines& lines,
             text::Tokens& tokens,
             const GraphTag& tag,
             GraphRow& row)
{
  row.tag = &tag;
  row.line = lines.number();
  row.numbers.clear();
  std::size_t count = 0;
  for (auto token = tokens.next(); !token.empty(); token = tokens.next(), ++count) {
    if (count < tag.ids) {
      row.ids[count] = readVertexId(path, lines, token);
      continue;
    }
    double value = 0;
    if (!text::parseNumber(token, value))
      text::failAt(path, row.line, text::quoted(token) + " is not a number");
    row.numbers.push_back(value);
  }
  if (count != tag.ids + tag.numbers)
    text::failAt(path,
                 row.line,
                 "expected " + std::to_string(tag.ids + tag.numbers) +
                     " numbers after " + std::string(tag.name) + ", got " +
                     std::to_string(count));
}

Eigen::Isometry3d
poseOfRow(const std::filesystem::path& path, const GraphRow& row)
{
  const double* const n = row.numbers.data();
  if (row.tag->is_planar)
    return rigidPose(path,
                     row.line,
                     rotationFromEuler({0, 0, n[2]}),
                     Eigen::Vector3d(n[0], n[1], 0));
  const Eigen::Vector3d t(n[0], n[1], n[2]);
  if (row.tag->has_quaternion)
    return rigidPose(path, row.line, Eigen::Quaterniond(n[6], n[3], n[4], n[5]), t);
  return rigidPose(path, row.line, rotationFromEuler({n[3], n[4], n[5]}), t);
}

namespace {
/** \return the information about x, y and yaw, with equal information about z, roll and pitch,
 * which agree in all planar poses */
Matrix6
planarInformation(const double* entry)
{
  constexpr int kPlaces[] = {0, 1, 5}; // x, y, yaw
  Matrix6 information = Matrix6::Zero();
  for (int i = 0; i < 3; ++i)
    for (int j = i; j < 3; ++j)
      information(kPlaces[i], kPlaces[j]) = information(kPlaces[j], kPlaces[i]) =
          *entry++;
  information(2, 2) = (information(0, 0) + information(1, 1)) / 2;
  information(3, 3) = information(4, 4) = information(5, 5);
  return information;
}
} // namespace

Matrix6
informationOfRow(const std::filesystem::path& path, const GraphRow& row)
{
  if (row.tag->is_planar) {
    const Matrix6 information = planarInformation(row.numbers.data() + 3);
    const std::string fault = informationFault(information);
    if (!fault.empty())
      text::failAt(path, row.line, "the information matrix is " + fault);
    return semidefinite(information);
  }
  const double* entry = row.numbers.data() + row.tag->numbers - kTriangle;
  Matrix6 information;
  for (int i = 0; i < 6; ++i)
    for (int j = i; j < 6; ++j)
      information(i, j) = information(j, i) = *entry++;
  const std::string fault = informationFault(information);
  if (!fault.empty())
    text::failAt(path, row.line, "the information matrix is " + fault);
  return scaledRotation(semidefinite(information), rotationScale(*row.tag));
}

void
appendPose(std::string& text, const GraphTag& tag, const Eigen::Isometry3d& pose)
{
  const auto append = [&](double value) {
    text += ' ';
    text::appendNumber(text, value);
  };
  for (int axis = 0; axis < 3; ++axis)
    append(pose.translation()(axis));
  if (tag.has_quaternion) {
    const Eigen::Quaterniond q = canonical(Eigen::Quaterniond(pose.linear()));
    for (const double value : {q.x(), q.y(), q.z(), q.w()})
      append(value);
    return;
  }
  const EulerAngles angles = eulerFromRotation(pose.linear());
  for (const double value : {angles.roll, angles.pitch, angles.yaw})
    append(value);
}

void
appendInformation(std::string& text, const GraphTag& tag, const Matrix6& information)
{
  const Matrix6 scaled = scaledRotation(information, 1 / rotationScale(tag));
  for (int i = 0; i < 6; ++i)
    for (int j = i; j < 6; ++j) {
      text += ' ';
      text::appendNumber(text, scaled(i, j));
    }
}

} // namespace pcl6d::io

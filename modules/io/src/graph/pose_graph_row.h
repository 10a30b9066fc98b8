// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/graph_constraints.h>
#include <pcl6d/common/pose_graph.h>
#include <pcl6d/io/text.h>

#include <string_view>
#include <vector>

/** \file Single lines of pose graph files. */
namespace pcl6d::io {

/** First word of a line. */
struct GraphTag {
  std::string_view name;
  bool is_link = false;        ///< else a vertex
  bool has_quaternion = false; ///< g2o; else Euler angles (TORO)
  std::size_t ids = 1;
  std::size_t numbers = 0; ///< behind the ids
  bool is_planar = false;  ///< x y yaw
};

/** \return the tag by name, nullptr if unknown */
const GraphTag*
graphTag(std::string_view name);

/** \brief A line, parsed into numbers. */
struct GraphRow {
  const GraphTag* tag = nullptr;
  std::size_t line = 0;
  std::size_t ids[3] = {0, 0, 0};
  std::vector<double> numbers;
};

/** \brief Reads a vertex id. \throws IoFailed naming file and line */
std::size_t
readVertexId(const std::filesystem::path& path,
             const text::Lines& lines,
             std::string_view token);

/** \brief Reads the numbers after the tag. \throws IoFailed naming file and line */
void
readGraphRow(const std::filesystem::path& path,
             const text::Lines& lines,
             text::Tokens& tokens,
             const GraphTag& tag,
             GraphRow& row);

/** \return the pose of a vertex or link \throws IoFailed the numbers are not a rigid motion */
Eigen::Isometry3d
poseOfRow(const std::filesystem::path& path, const GraphRow& row);

/** \return the information of a link in the convention of PoseLink
 * \throws IoFailed the information is not finite or not positive semidefinite */
Eigen::Matrix<double, 6, 6>
informationOfRow(const std::filesystem::path& path, const GraphRow& row);

/** \brief writePoseGraphG2o() with rows of the constraints. */
void
writeConstrainedG2o(const std::filesystem::path& path,
                    const PoseGraph& graph,
                    const GraphConstraints& constraints);

/** \brief Appends position and orientation. */
void
appendPose(std::string& text, const GraphTag& tag, const Eigen::Isometry3d& pose);

/** \brief Appends the upper triangle in the convention of the file. */
void
appendInformation(std::string& text,
                  const GraphTag& tag,
                  const Eigen::Matrix<double, 6, 6>& information);

} // namespace pcl6d::io

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "e57/e57_layout.h"
#include "e57/record_writer.h"

#include <pcl6d/sources/e57_writer.h>

#include <string>
#include <vector>

namespace pcl6d::sources {

/** \brief Properties of a written scan for the XML section. */
struct WrittenScan {
  std::string name;
  std::string guid;
  std::optional<Eigen::Isometry3d> pose;
  std::optional<double> stamp;
  std::uint64_t offset = 0; ///< physical, of the points
  std::uint64_t count = 0;
  std::vector<E57Field> fields;
  Eigen::Vector3d least = Eigen::Vector3d::Zero(); ///< of the coordinates [m]
  Eigen::Vector3d most = Eigen::Vector3d::Zero();
  E57Limits intensity;
  std::optional<std::pair<std::int64_t, std::int64_t>> rows, columns;
  std::vector<std::string> losses;
};

/** \brief Writes the points of a station. */
WrittenScan
encodeStation(const E57Station& station, PageWriter& file);

/** \return the XML section for the scans */
std::string
e57Text(const std::vector<WrittenScan>& scans,
        const std::string& coordinate_system = {});

/** \return the element <pose> */
std::string
e57PoseText(const Eigen::Isometry3d& pose);

} // namespace pcl6d::sources

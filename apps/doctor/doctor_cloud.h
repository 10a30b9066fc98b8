// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/points.h>
#include <pcl6d/filters/point_normals.h>
#include <pcl6d/io/scan_reader.h>

#include <pcl/point_types.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace pcl6d::app {

/** \brief A cloud as a program with PCL would get it: every row, including NaN. */
struct DoctorCloud {
  std::string file;
  std::vector<Eigen::Vector3d> rows; ///< [m] x y z as stored
  Normals normals;                   ///< one per row; empty: not in the file
  std::vector<std::string> fields;
  std::size_t width = 0, height = 1;
  bool in_double = false;   ///< x, y, z are stored as float64
  std::size_t left_out = 0; ///< rows without finite x, y, z, dropped by the reader
  /** number of rows of a PCD file with x, y, z changed by PCL's conversion to pcl::PointXYZ */
  std::size_t lost_by_pcl = 0;
  std::optional<Eigen::Isometry3d> viewpoint; ///< of a PCD file, if not the identity
  std::optional<pcl::Indices> indices;        ///< selected rows; empty: every row
  /** [m] taken off the coordinates to measure near 0, in double */
  Eigen::Vector3d offset = Eigen::Vector3d::Zero();

  /** \return the finite rows; if chosen is true, only rows selected by the indices */
  std::vector<std::size_t>
  finiteRows(bool chosen) const;

  /** \return the points of rows, less the offset */
  Points
  localPoints(const std::vector<std::size_t>& of) const;

  std::size_t
  numNotFinite() const;
};

/** \brief Reads a cloud; PCD files keep their NaN rows, other formats are read by
 * readScan().
 * \throws IoFailed as readScan() */
DoctorCloud
readDoctorCloud(const std::string& file, ScanFormat format);

/** \brief Reads numbers of rows, separated by white space.
 * \throws IoFailed naming the text: no number, or no row of the cloud; or the reader
 * dropped rows, which makes row numbers ambiguous */
pcl::Indices
readRowNumbers(const std::string& file, const DoctorCloud& cloud);

} // namespace pcl6d::app

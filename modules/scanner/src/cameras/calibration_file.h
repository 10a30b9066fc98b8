// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/scanner/pinhole_camera.h>

#include <opencv2/core.hpp>

#include <filesystem>
#include <string>
#include <vector>

namespace pcl6d::scanner {

/** \brief A file of named matrices in OpenCV's format: YAML, XML or JSON. */
class CalibrationFile {
public:
  /** \throws IoFailed the file cannot be read, or is not in OpenCV's format */
  explicit CalibrationFile(const std::filesystem::path& path);

  /** \throws IoFailed always, naming the file */
  [[noreturn]] void
  fail(const std::string& message) const;

  bool
  has(const std::string& name) const
  {
    return !storage_[name].empty();
  }

  /** \throws IoFailed naming the missing entries */
  void
  requireEntries(const std::vector<std::string>& names) const;

  /** \return the values of a matrix, row by row, each finite */
  std::vector<double>
  values(const std::string& name) const;
  std::vector<double>
  values(const std::string& name, std::size_t count) const;
  Eigen::Matrix3d
  matrix3(const std::string& name) const;

  /** \return a number \throws IoFailed the entry is missing, or not a whole number > 0 */
  int
  size(const std::string& name) const;

  /** \throws IoFailed the entry exists, but is another number */
  void
  requireSize(const std::string& name, int expected) const;

  /** \return a camera \param[in] matrix,distortion names of its entries
   * \throws IoFailed the entries are no valid camera */
  CameraIntrinsics
  camera(const std::string& matrix,
         const std::string& distortion,
         int width,
         int height) const;

private:
  void
  readDistortion(const std::string& name, CameraIntrinsics& lens) const;

  std::filesystem::path path_;
  cv::FileStorage storage_;
};

} // namespace pcl6d::scanner

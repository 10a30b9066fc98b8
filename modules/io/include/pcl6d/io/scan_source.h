// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/io/scan_reader.h>

#include <Eigen/Geometry>

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Properties of a scan known before reading the points. */
struct SourceScan {
  std::string name;                      ///< unique in the source
  std::optional<Eigen::Isometry3d> pose; ///< T_world_scan, exactly rigid
  std::optional<double> stamp;           ///< [s]
  std::vector<std::string> fields; ///< of the points in the file; empty: not known
  std::optional<std::uint64_t> num_points; ///< empty: not known before reading
};

/** \brief Several scans in one place, opened individually: a folder, or a file of many stations,
 * such as E57. ScanFolder selects scans from a source. Derive to add a kind of source.
 * \ingroup io */
class ScanSource {
public:
  virtual ~ScanSource();

  /** \return the file or folder, which exists */
  virtual const std::filesystem::path&
  path() const = 0;

  /** \return the name of the format, for people: "E57" */
  virtual std::string
  format() const = 0;

  /** \return all scans in order */
  virtual const std::vector<SourceScan>&
  scans() const = 0;

  /** \return the file of the i-th scan; several scans may share a file */
  virtual const std::filesystem::path&
  fileOf(std::size_t i) const;

  /** \return a name of the i-th scan for messages: "site.e57: scan 3 (Lobby)" */
  virtual std::string
  titleOf(std::size_t i) const;

  /** \return the origin of poses and stamps of the scans, for people */
  virtual std::string
  poseSource() const;

  /** \return a single-line remark for the user on the scans; may be empty */
  virtual std::string
  note() const;

  /** \brief Reads all points of the i-th scan, right-handed and in metres. Non-finite points are
   * allowed; in an organized cloud each row is a scan line. Must be thread-safe.
   * \throws IoFailed naming file, scan, position and rule
   * \throws BadArgument i is out of range */
  virtual ScanCloud
  read(std::size_t i) const = 0;
};

} // namespace pcl6d

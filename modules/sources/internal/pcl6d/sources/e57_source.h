// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/io/scan_source.h>

#include <memory>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The scans of an E57 file (ASTM E2807): a scan for each station.
 *
 * Coordinates are Cartesian or spherical, of any storage; the checksum of each page is
 * verified. Points without a return, marked by the invalid state or at (0, 0, 0), get NaN
 * coordinates. Fields are x, y, z (float, or double if far from the origin), intensity as in
 * the file, rgb, normal_x, normal_y, normal_z, time, row, column, return_index and
 * return_count; further fields are listed in ScanCloud::left_out. If row and column give each
 * point a separate cell, the cloud is organized.
 *
 * Names are taken from the file, with "_" for "/" and in one line; an unnamed scan is named by
 * number ("scan003"), and a repeated name gets the number appended. A missing pose, or a
 * missing part of a pose, has the standard's default, identity; if no scan has a pose, all
 * poses are empty. Stamps are the starts of the recording [s, GPS time], if strictly
 * increasing.
 * \ingroup sources */
class E57Source : public ScanSource {
public:
  /** \brief Reads the XML section of the file. \throws IoFailed naming file, position, value and
   * rule: not an E57 file, truncated or broken, or without a scan */
  explicit E57Source(const std::filesystem::path& path);
  ~E57Source() override;

  const std::filesystem::path&
  path() const override;
  std::string
  format() const override;
  const std::vector<SourceScan>&
  scans() const override;
  ScanCloud
  read(std::size_t i) const override;

private:
  struct Content;
  std::unique_ptr<const Content> content_;
};

} // namespace pcl6d

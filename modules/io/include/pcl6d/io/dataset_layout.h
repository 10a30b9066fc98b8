// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/io/point_times.h>
#include <pcl6d/io/scan_reader.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Folders and files of a published data set, recognised by name. */
struct DatasetLayout {
  std::string name;               ///< "KITTI odometry"
  std::filesystem::path scans;    ///< the folder of the scans
  std::filesystem::path sequence; ///< the folder around `scans` and all other files
  ScanFormat format = ScanFormat::kAuto;
  BinLayout bin_layout = BinLayout::kAuto; ///< of kKitti
  std::string frame;                       ///< axes and unit of the points as read
  std::filesystem::path stamps;      ///< file with a stamp for each scan, or empty
  bool names_are_stamps = false;     ///< the names of the scans are their stamps
  std::filesystem::path calibration; ///< empty: none
  std::filesystem::path
      reference; ///< reference poses, never used as initial poses; or empty
  PointTimeRule times = PointTimeRule::kNone; ///< of points, if the files have no times
  std::string times_text; ///< how times of points are known, for people
};

/** \return the layout of a folder of scans, recognised by the names of the folder and its
 * parents, by the files in the parents and by the name of a scan; empty: unknown layout
 * \ingroup io */
std::optional<DatasetLayout>
layoutOfScans(const std::filesystem::path& folder);

/** \brief Searches a folder for the scans of a data set: a sequence, or a whole data set. If
 * several folders of a sequence hold the same sweeps in one layout, the folder listed first in
 * the rules of the layout is used.
 * \return the layout, or empty if not found
 * \throws IoFailed several layouts match: the message lists the candidates \ingroup io */
std::optional<DatasetLayout>
findDataset(const std::filesystem::path& folder);

/** \return the layout in one line, for people: name, points, frame, stamps, times of points, and
 * the unused reference \ingroup io */
std::string
describe(const DatasetLayout& layout);

/** \return [s] time stamps parsed from the names of scans: 19 digits [ns] or 16 digits [us]
 * since 1970, seconds and nanoseconds of ten digits and up to nine
 * (`cloud_1583836591_182590976.pcd`), or decimal seconds (`1710246316.041921000.pcd`),
 * optionally after a word and `_`; empty unless every name has a stamp and the stamps increase
 * \ingroup io */
std::vector<double>
stampsOfNames(const std::vector<std::filesystem::path>& scans);

} // namespace pcl6d

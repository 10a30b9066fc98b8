// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/run/run_folder.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief A picture on a report. */
struct ReportPicture {
  std::string name;  ///< name of its file: "top_view.png"
  std::string title; ///< what it shows
  std::string png;   ///< the bytes of the file
};

/** \brief Content of a report of a run. \ingroup visualization */
struct ReportData {
  std::string title; ///< any text; bytes that are not UTF-8 are replaced
  RunResult
      summary; ///< with its links; poses in full coordinates; NaN poses are left out
  std::vector<std::string> missing; ///< missing or broken files, in words
  bool is_damaged = false;          ///< a file exists, but cannot be read
  RunMap map;                       ///< relative to the world offset; NaN is left out
  RunMap moving; ///< dynamic points, not part of the map; in the frame of the map
  std::vector<Plane> planes;       ///< in full coordinates
  std::vector<ObjectPose> objects; ///< in full coordinates
  std::vector<ReportPicture> pictures;
};

/** \brief Bounds of the size of a report. Beyond these parts, a report takes 0.6 MB,
 * and about 0.5 kB per scan and 0.2 kB per link. */
struct ReportOptions {
  /** of the map, 12 bytes each; thinned evenly; up to a quarter are for dynamic points; > 0 */
  std::size_t max_points = 400000;
  std::size_t max_picture_bytes = 4000000; ///< of all pictures together
  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief Reads the results of a run. Missing or broken files, and pictures (*.png in
 * the folder or in pictures/) beyond the budget, are listed without an error; a broken
 * file sets is_damaged.
 * \param[in] title by default the name of the folder */
ReportData
gatherReport(const RunFolder& run,
             const std::string& title = {},
             const ReportOptions& options = ReportOptions());

/** \brief Adds the content of a folder: missing files and pictures. Run, map, dynamic
 * points, planes and objects are taken from data. */
void
addFolder(const RunFolder& run,
          ReportData& data,
          const ReportOptions& options = ReportOptions());

/** \brief Writes a report as a self-contained HTML file: verdict, map in three
 * dimensions, plots, tables, pictures, options (share/doc/report.md). Atomically.
 *
 * The map is thinned and rounded to steps of the 65535th part of its extent; isolated
 * points farther away than the extent of the map are left out. Dynamic points are red
 * over the map, and can be switched off.
 * \code
 * const pcl6d::RunFolder run("out");
 * pcl6d::writeReport("out/report.html", pcl6d::gatherReport(run));
 * \endcode
 * \throws BadArgument an option is invalid, or fields of the map, fields of the dynamic
 * points, or scans and their dynamic counts differ in length
 * \throws IoFailed the file cannot be written \ingroup visualization */
void
writeReport(const std::filesystem::path& path,
            const ReportData& data,
            const ReportOptions& options = ReportOptions());

} // namespace pcl6d

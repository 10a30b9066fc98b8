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
  std::string name;  ///< of its file: "top_view.png"
  std::string title; ///< what it shows
  std::string png;   ///< the bytes of the file
};

/** \brief What a report tells of a run. \ingroup visualization */
struct ReportData {
  std::string title; ///< any text; bytes that are no UTF-8 are replaced
  RunResult
      summary; ///< with its links; poses in full coordinates; NaN ones are left out
  std::vector<std::string> missing; ///< what is not there or broken, in words
  bool is_damaged = false;          ///< some of that is there, but cannot be read
  RunMap map;                       ///< relative to the world offset; NaN is left out
  RunMap moving;                    ///< what moved, which is not in the map; as the map
  std::vector<Plane> planes;        ///< in full coordinates
  std::vector<ObjectPose> objects;  ///< in full coordinates
  std::vector<ReportPicture> pictures;
};

/** \brief Knobs of reports: what bounds their size. The rest of a report is 0.6 MB, and
 * about 0.5 kB per scan and 0.2 kB per link. */
struct ReportOptions {
  /** of the map, 12 bytes each; thinned evenly; up to a quarter are for what moved; > 0 */
  std::size_t max_points = 400000;
  std::size_t max_picture_bytes = 4000000; ///< of all pictures together
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief Gathers what a run left: what is missing or broken is named, not an error, and
 * so is a picture (*.png in the folder or in pictures/) that is too large for the budget;
 * of what is broken, is_damaged is set.
 * \param[in] title by default the name of the folder */
ReportData
gatherReport(const RunFolder& run,
             const std::string& title = {},
             const ReportOptions& options = ReportOptions());

/** \brief Adds what only a folder tells: which files are missing, and the pictures. Run, map,
 * what moved, planes and objects are taken as they are in data. */
void
addFolder(const RunFolder& run,
          ReportData& data,
          const ReportOptions& options = ReportOptions());

/** \brief Writes a report as one HTML file that needs nothing else: verdict, map in three
 * dimensions, plots, tables, pictures, options (share/doc/report.md). Atomically.
 *
 * The map is thinned and rounded to steps of the 65535th part of its extent; the few points
 * that lie farther from the others than the map is large are left out. What moved is red
 * over it, and can be switched off.
 * \code
 * const pcl6d::RunFolder run("out");
 * pcl6d::writeReport("out/report.html", pcl6d::gatherReport(run));
 * \endcode
 * \throws BadArgument an option breaks its rule, or the fields of the map or of what moved
 * differ in length, or the scans and the counts of what moved in each
 * \throws IoFailed the file cannot be written \ingroup visualization */
void
writeReport(const std::filesystem::path& path,
            const ReportData& data,
            const ReportOptions& options = ReportOptions());

} // namespace pcl6d

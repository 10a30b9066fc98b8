// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/pose_graph.h>
#include <pcl6d/common/run_result.h>

#include <pcl/PCLPointCloud2.h>

#include <filesystem>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Writes the folder of a run (share/doc/run_folder.md), which RunFolder reads.
 *
 * Poses are written first, to be available after an interruption; the summary is written last.
 * Each file is written atomically. Points and poses in scans/ and map.pcd are relative to the
 * world offset of the run.
 * \code
 * const pcl6d::RunWriter writer("out", run);
 * writer.writePoses(stamps);
 * for (std::size_t i = 0; i < clouds.size(); ++i)
 *   writer.writeScan(i, clouds[i]);
 * writer.writeMap(map);
 * run.verdict = pcl6d::verdictOf(run);
 * writer.writeSummary();
 * \endcode
 * All functions throw IoFailed if a file cannot be written. \ingroup run */
class RunWriter {
public:
  /** Keeps a reference to the run. */
  RunWriter(std::filesystem::path folder, const RunResult& run);

  /** \brief trajectory.kitti and trajectory.tum, with the poses of all scans, or of all sweeps of a
   * drive, in the frame of the given poses (RunResult::moved), and frames/.
   * \param[in] stamps of the scans [s]; empty: their indices */
  void
  writePoses(const std::vector<double>& stamps = {}) const;

  /** \brief graph.g2o and links.csv. \param[in] graph with links between indices of scans */
  void
  writeGraph(const PoseGraph& graph) const;

  /** \brief verification.csv, if the run was verified. */
  void
  writeVerification() const;

  /** \brief control.csv, if control points were given. */
  void
  writeControl() const;

  /** \brief Writes a scan, with its pose as VIEWPOINT, into scans/. Thread-safe.
   * \param[in] cloud all fields, in the scan's own frame [m] */
  void
  writeScan(std::size_t place, const pcl::PCLPointCloud2& cloud) const;

  /** \brief map.pcd. */
  void
  writeMap(const pcl::PCLPointCloud2& map) const;

  /** \brief moving.pcd: the dynamic points, left out of the map. */
  void
  writeMoving(const pcl::PCLPointCloud2& points) const;

  /** \brief summary.json. */
  void
  writeSummary() const;

private:
  void
  writeFramesOf(std::size_t place) const;
  std::filesystem::path
  in(const std::string& subfolder,
     std::size_t place,
     const std::string& extension) const;

  std::filesystem::path folder_;
  const RunResult& run_;
};

/** \return the verdict in words: number of registered scans, unreliable scans, worst numbers, and
 * the result of each stage \ingroup run */
std::string
verdictOf(const RunResult& run);

} // namespace pcl6d

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/object_pose.h>
#include <pcl6d/common/plane.h>
#include <pcl6d/common/points.h>
#include <pcl6d/common/pose_graph.h>
#include <pcl6d/common/run_result.h>
#include <pcl6d/common/trajectory.h>
#include <pcl6d/io/scan_reader.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

struct Frame;

/** \brief The map of a run: map.pcd. */
struct RunMap {
  Points points;                    ///< [m] relative to the world offset
  std::vector<std::uint32_t> scans; ///< index NNN of each point's scan; empty: unknown
  std::vector<float> intensities;   ///< for each point, or empty
};

/** \brief The points on the planes of a run: planes.pcd. */
struct RunPlanePoints {
  Points points; ///< [m] relative to the world offset
  std::vector<std::uint32_t>
      plane_of; ///< for each point: its plane's id (index + 1); 0: none
};

/** \brief The output folder of pcl_slam6d (share/doc/run_folder.md), complete or not: also of an
 * interrupted run, or with deleted files.
 *
 * The constructor reads the summary; the remaining files are read on request. Missing files give
 * empty results, and are listed by missing(). Broken files are errors when read, also files whose
 * size or checksum differs from the summary, because they belong to another run.
 * \code
 * const pcl6d::RunFolder run("out");
 * const pcl6d::RunMap map = run.readMap();
 * \endcode
 * \ingroup run */
class RunFolder {
public:
  /** \throws IoFailed the folder does not exist, contains no file of a run, or its summary is
   * broken or from another program */
  explicit RunFolder(const std::filesystem::path& path);

  /** \brief The folder of a run with known result; no file is read. */
  RunFolder(const std::filesystem::path& path, RunResult result);

  /** \brief Checks the content of the files listed in the summary.
   * \param[in] start beginning of their paths in the folder, e.g. "scans/"; by default every file
   * \throws IoFailed a file differs from the run's output */
  void
  requireWhole(const std::string& start = {}) const;

  /** \return the folder of a finished run \param[in] unfinished message for an interrupted run:
   * "the run was interrupted; run it again"
   * \throws IoFailed the summary is missing, broken, or from another program; the run was
   * interrupted; or the size of a file differs from the summary */
  static RunFolder
  finished(const std::filesystem::path& path, const std::string& unfinished);

  const std::filesystem::path&
  path() const
  {
    return path_;
  }

  /** \brief The summary of the run. Without summary.json, only the scans are in it, with poses from
   * trajectory.kitti and the first poses of frames/. */
  const RunResult&
  summary() const
  {
    return summary_;
  }

  bool
  hasSummary() const
  {
    return has_summary_;
  }

  /** \return the files missing in comparison with a finished run, each with the reason if known:
   * "map.pcd (the run was interrupted)" */
  std::vector<std::string>
  missing() const;

  /** \return whether a file or folder of this name exists */
  bool
  has(const std::string& name) const;

  /** \return the file of a scan in its own frame, or of the map: for access to all fields of the
   * points \throws IoFailed the file differs from the run's output */
  std::filesystem::path
  scanFile(std::size_t place) const;
  std::filesystem::path
  mapFile() const;
  /** \brief Checks that the file of a scan exists, without reading its content.
   * \throws IoFailed the file is missing */
  void
  requireScan(std::size_t place) const;

  /** \return the poses of the scans, relative to the world offset */
  Trajectory
  trajectory() const;

  /** \return the initial poses of the run, relative to the world offset */
  Trajectory
  initialTrajectory() const;

  /** \return for each scan its poses during the run from frames/, relative to the world offset; no
   * frames if the file is missing \throws IoFailed a file is broken */
  std::vector<std::vector<Frame>>
  readHistory() const;

  /** \throws IoFailed map.pcd is broken */
  RunMap
  readMap() const;

  /** \return the dynamic points of the scans, relative to the world offset; empty without dynamic
   * points, or without a search for them \throws IoFailed moving.pcd is broken */
  RunMap
  readMoving() const;

  /** \return a scan with all its fields, without dynamic points; empty if the file is missing
   * \param[in] place in summary().scans \throws IoFailed the file is broken */
  Scan
  readStandingScan(std::size_t place) const;

  /** \return the static points of a scan in its own frame [m]; empty if the file is missing
   * \param[in] place in summary().scans \throws IoFailed the file is broken */
  Points
  readScan(std::size_t place) const;

  /** \return readScan() with intensities and the scan's index for each point */
  RunMap
  readScanCloud(std::size_t place) const;

  /** \param[in] fault like in readRunLinks() \throws IoFailed links.csv is broken */
  std::vector<RunLink>
  readLinks(const std::function<std::string(const RunLink&)>& fault = {}) const;

  /** \return the poses and the measured relative poses; ids are indices NNN of scans
   * \throws IoFailed graph.g2o is broken */
  PoseGraph
  readGraph() const;

  /** \return the planes in full coordinates \throws IoFailed planes.json is broken */
  std::vector<Plane>
  readPlanes() const;

  /** \throws IoFailed planes.pcd is broken */
  RunPlanePoints
  readPlanePoints() const;

  /** \return the objects in full coordinates \throws IoFailed objects.json is broken */
  std::vector<ObjectPose>
  readObjects() const;

private:
  RunMap
  readMapOf(const char* name) const;
  void
  takeScansFromPoses();
  std::filesystem::path
  framesFile(std::size_t place) const;
  std::filesystem::path
  scanPath(std::size_t place) const;
  std::filesystem::path
  asWritten(const std::filesystem::path& file) const;
  void
  requireSizes() const;
  Eigen::Isometry3d
  relative(Eigen::Isometry3d pose) const;

  std::filesystem::path path_;
  bool has_summary_ = false;
  RunResult summary_;
};

} // namespace pcl6d

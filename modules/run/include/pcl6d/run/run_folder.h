// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/object_pose.h>
#include <pcl6d/common/plane.h>
#include <pcl6d/common/points.h>
#include <pcl6d/common/pose_graph.h>
#include <pcl6d/common/trajectory.h>
#include <pcl6d/io/frames_io.h>
#include <pcl6d/io/scan_reader.h>
#include <pcl6d/run/run_links_io.h>
#include <pcl6d/run/run_summary.h>

#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief The map of a run: map.pcd. */
struct RunMap {
  Points points; ///< [m] relative to the world offset
  std::vector<std::uint32_t>
      scans;                      ///< index NNN of each point's scan; empty: not known
  std::vector<float> intensities; ///< one per point, or empty
};

/** \brief The points on the planes of a run: planes.pcd. */
struct RunPlanePoints {
  Points points; ///< [m] relative to the world offset
  std::vector<std::uint32_t>
      plane_of; ///< per point its plane's id (place + 1); 0: none
};

/** \brief What pcl_slam6d left in a folder (share/doc/run_folder.md), as far as it is
 * there: also of an interrupted run, or of one of which files are gone.
 *
 * The summary is read at once, all else when it is asked for. What is not there is empty,
 * and named by missing(); what is there but broken is an error when it is read. So is a file
 * whose size or checksum is not that of the summary, as it is of another run.
 * \code
 * const pcl6d::RunFolder run("out");
 * const pcl6d::RunMap map = run.readMap();
 * \endcode
 * \ingroup run */
class RunFolder {
public:
  /** \throws IoFailed there is no such folder, it holds nothing of a run, or its summary is
   * broken or that of another program */
  explicit RunFolder(const std::filesystem::path& path);

  /** \brief The folder of a run whose result is known; nothing is read. */
  RunFolder(const std::filesystem::path& path, RunResult result);

  /** \brief Looks at the content of the files that the summary tells of.
   * \param[in] start of their paths in the folder, such as "scans/"; all by default
   * \throws IoFailed one differs from what the run wrote */
  void
  requireWhole(const std::string& start = {}) const;

  /** \return the folder of a finished run \param[in] unfinished what is wrong with one that
   * was interrupted: "the run was interrupted; run it again"
   * \throws IoFailed it has no summary, a broken one, or that of another program, was
   * interrupted, or a file has not the size that the summary tells */
  static RunFolder
  finished(const std::filesystem::path& path, const std::string& unfinished);

  const std::filesystem::path&
  path() const
  {
    return path_;
  }

  /** \brief What the run tells of itself; without summary.json only the scans are in it,
   * with poses from trajectory.kitti and the first ones of frames/. */
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

  /** \return the files that a finished run has and this one has not, each with the reason
   * if it is known: "map.pcd (the run was interrupted)" */
  std::vector<std::string>
  missing() const;

  /** \return whether the folder holds a file or folder of this name */
  bool
  has(const std::string& name) const;

  /** \return the file of a scan, in its own frame, and that of the map: for those that need
   * all fields of the points \throws IoFailed it does not hold what the run wrote */
  std::filesystem::path
  scanFile(std::size_t place) const;
  std::filesystem::path
  mapFile() const;
  /** \brief Makes sure that the file of a scan is there; its content is not looked at.
   * \throws IoFailed it is missing */
  void
  requireScan(std::size_t place) const;

  /** \return the poses of the scans, relative to the world offset */
  Trajectory
  trajectory() const;

  /** \return the poses that the run started from, relative to the world offset */
  Trajectory
  initialTrajectory() const;

  /** \return per scan its poses through the run as of frames/, relative to the world
   * offset; no frames where the file is missing \throws IoFailed a file is broken */
  std::vector<std::vector<Frame>>
  readHistory() const;

  /** \throws IoFailed map.pcd is broken */
  RunMap
  readMap() const;

  /** \return what moved while the scans were taken, relative to the world offset; empty if nothing
   * did, or nobody asked \throws IoFailed moving.pcd is broken */
  RunMap
  readMoving() const;

  /** \return a scan with all its fields, but without the points that moved; empty if the file is
   * missing \param[in] place in summary().scans \throws IoFailed the file is broken */
  Scan
  readStandingScan(std::size_t place) const;

  /** \return the points of a scan in its own frame [m], but those that moved; none if the file is
   * missing \param[in] place in summary().scans \throws IoFailed the file is broken */
  Points
  readScan(std::size_t place) const;

  /** \return the same with its intensities and its index for each point */
  RunMap
  readScanCloud(std::size_t place) const;

  /** \param[in] fault as of readRunLinks() \throws IoFailed links.csv is broken */
  std::vector<RunLink>
  readLinks(const std::function<std::string(const RunLink&)>& fault = {}) const;

  /** \return the poses and what was measured between them; its ids are indices NNN of scans
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

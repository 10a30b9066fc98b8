// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/moved_points.h>
#include <pcl6d/common/run_result.h>
#include <pcl6d/common/trajectory.h>
#include <pcl6d/io/far_points.h>
#include <pcl6d/io/other_scan_format.h>
#include <pcl6d/io/scan_reader.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Which scans of a folder to take, and where their initial poses come from. */
struct ScanFolderOptions {
  ScanFormat format = ScanFormat::kAuto; ///< auto: the one format found in the folder
  std::shared_ptr<const OtherScanFormat> other_format = {}; ///< in place of `format`
  std::filesystem::path poses_file; ///< KITTI or TUM; empty: search the folder
  int first = 0;                    ///< index of the first scan, >= 0
  std::optional<int>
      last;      ///< index of the last scan, >= first; none or beyond: the end
  int every = 1; ///< take each n-th scan, >= 1
  bool keep_coordinates = false; ///< leave far points where they are
  /** \throws BadArgument naming the first field that breaks its rule, with its value */
  void
  validate() const;
};

/** \brief Scans of a folder in natural order (scan2 before scan10), opened lazily: only
 * headers, poses and the first scan are read on construction.
 *
 * If the points of the first scan lie where no scanner that stands in the origin can have
 * measured them (PointsPlace::isFarFrom()), as national coordinates do, all scans are read
 * in double and brought near (moved()), and their poses accordingly: what is read are near
 * points in the frames of initialPose(). Three kinds of folders are told apart by their
 * poses. If the scanner of the first scan would stand amid its points, and poses are closer
 * to each other than the places to which they bring the middle of the points, the points are
 * in the world already (PoseReading::kStation). If only the latter holds, the points carry
 * an offset (kScanner). Else poses belong to the points as they are (kFile), as without any
 * poses.
 *
 * The initial poses come from the first of: the given file; one `scanNNN.pose` per scan
 * (3DTK); `odometry.txt`; `poses.txt` (KITTI rows T_world_scan, one per scan of the
 * folder); PCD VIEWPOINT if at least one differs from identity; identity. Files named
 * `groundtruth*` are never read. Time stamps come with TUM poses, else from `times.txt`
 * (KITTI: one per line). All scans of the folder count for the number of rows, also those
 * that first, last and every leave out. \ingroup io */
class ScanFolder {
public:
  /** \throws IoFailed the folder is missing or unreadable, holds no scan, holds scans
   * of several formats (with kAuto), or its poses are incomplete or broken \throws
   * BadArgument an option breaks its rule, or selects no scan */
  explicit ScanFolder(const std::filesystem::path& folder,
                      const ScanFolderOptions& options = {});

  /** \brief A scan that a finished run has registered, in the file that it wrote. */
  struct Registered {
    std::filesystem::path file;
    std::string name; ///< see name()
    int index = 0;    ///< see index()
    Eigen::Isometry3d initial_pose = Eigen::Isometry3d::Identity();
  };

  /** \brief Scans of finished runs in place of a folder's: all of them are registered.
   * \param[in] scans one at least \param[in] stamps [s] one per scan, or none
   * \param[in] moved how all the runs have brought points near
   * \param[in] source see poseSource()
   * \throws BadArgument no scan, or stamps for some */
  static ScanFolder
  ofRuns(const std::vector<Registered>& scans,
         std::vector<double> stamps,
         const std::optional<MovedPoints>& moved,
         const std::string& source);

  /** \brief Puts the scans of a finished run before those of the folder, and leaves out
   * those of the folder that the run holds, which it knows by the name of their file.
   * Indices go on behind the run's last one. Time stamps stay only if both have them.
   * \param[in] run its folder (share/doc/run_folder.md)
   * \param[in] summary of the run
   * \throws IoFailed a scan of the run is missing, or the folder holds no further one */
  void
  continueRun(const std::filesystem::path& run, const RunResult& summary);

  /** \return how many scans, the first ones, a finished run has registered; else 0 */
  std::size_t
  numRegistered() const
  {
    return num_registered_;
  }

  /** \return the number of selected scans, >= 1 */
  std::size_t
  size() const;

  /** \return the file of the i-th selected scan */
  const std::filesystem::path&
  file(std::size_t i) const;

  /** \return the name of the file in the folder that the i-th scan was recorded in */
  const std::string&
  name(std::size_t i) const;

  /** \return the place of the i-th selected scan among all scans of the folder */
  int
  index(std::size_t i) const;

  /** \return the initial pose of the i-th selected scan as read() returns it, exactly rigid */
  const Eigen::Isometry3d&
  initialPose(std::size_t i) const;

  /** \return the same of its points as the file has them: another one if they are moved */
  Eigen::Isometry3d
  poseOfFile(std::size_t i) const;

  /** \return time stamps [s] of the selected scans, or empty if the folder has none */
  const std::vector<double>&
  stamps() const;

  /** \return initial poses and stamps of all scans of the folder, selected or not */
  const Trajectory&
  odometry() const;

  /** \return where the poses come from, for people: "odometry.txt", "PCD VIEWPOINT",
   * "scan poses (*.pose)", "identity", or the name of the given file */
  const std::string&
  poseSource() const;

  /** \return false if no pose source was found, so that all poses are the identity */
  bool
  hasPoses() const;

  /** \return how points that lie far from the origin are brought near; none: they do not */
  const std::optional<MovedPoints>&
  moved() const
  {
    return moved_;
  }

  /** \return the same for people, one line; empty if nothing is moved */
  const std::string&
  coordinates() const
  {
    return coordinates_;
  }

  /** \brief Reads the i-th selected scan. \throws IoFailed as readScan() */
  Scan
  read(std::size_t i) const;

  /** \brief The same without a second copy of x, y, z. */
  ScanCloud
  readCloud(std::size_t i) const;

  /** \return the format of the first scan; kAuto if it is another one than those of the
   * suite (ScanFolderOptions::other_format) */
  ScanFormat
  format() const;

private:
  ScanFolder() = default;

  struct Entry {
    std::filesystem::path file;
    std::string name;
    int index = 0;
    Eigen::Isometry3d given = Eigen::Isometry3d::Identity();
    ScanFormat format = ScanFormat::kAuto; ///< auto: the other one
    bool is_far = false;                   ///< it is moved when it is read
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity(); ///< of the points as read
  };

  ScanCloud
  readEntry(const Entry& entry) const;
  void
  lookAtFirst();
  void
  bringNear(const PointsPlace& place);
  PoseReading
  readingOf(const PointsPlace& place, const Eigen::Vector3d& offset) const;
  void
  placeNear();

  std::vector<Entry> entries_;
  std::shared_ptr<const OtherScanFormat> other_format_;
  std::vector<double> stamps_;
  Trajectory odometry_;
  std::string pose_source_;
  std::size_t num_registered_ = 0;
  std::optional<MovedPoints> moved_;
  std::string coordinates_;
  mutable std::shared_ptr<ScanCloud> first_; ///< if it was read and not given away yet
};

/** \return the time stamps [s] of a run's scans, or nothing where indices stand for them
 * \throws IoFailed its trajectory.tum cannot be read, or has not one row per scan
 * \ingroup io */
std::vector<double>
stampsOfRun(const std::filesystem::path& run, const RunResult& summary);

/** \brief Looks for the pose of a scan that is not taken as part of a folder.
 * \return the pose in the `.pose` file beside it, or that of its PCD VIEWPOINT, unless it
 * is the identity \throws IoFailed they are broken \ingroup io */
std::optional<Eigen::Isometry3d>
findScanPose(const std::filesystem::path& scan, ScanFormat format = ScanFormat::kAuto);

} // namespace pcl6d

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/moved_points.h>
#include <pcl6d/common/run_result.h>
#include <pcl6d/common/trajectory.h>
#include <pcl6d/io/bag_options.h>
#include <pcl6d/io/dataset_layout.h>
#include <pcl6d/io/other_scan_format.h>
#include <pcl6d/io/scan_reader.h>
#include <pcl6d/io/scan_source.h>

#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

struct PointsPlace;

namespace io {
struct FoundScans;
}

/** \brief Selection of scans of a folder, and the source of the initial poses. */
struct ScanFolderOptions {
  ScanFormat format = ScanFormat::kAuto; ///< auto: the only format in the folder
  std::shared_ptr<const OtherScanFormat> other_format = {}; ///< replaces `format`
  std::vector<std::string> columns = {};                    ///< see ScanReaderOptions
  BinLayout bin_layout = BinLayout::kAuto;                  ///< see ScanReaderOptions
  BagOptions bag = {};                                      ///< of a robot's recording
  std::filesystem::path poses_file; ///< KITTI or TUM; empty: search the folder
  int first = 0;                    ///< index of the first scan, >= 0
  std::optional<int>
      last;      ///< index of the last scan, >= first; empty or beyond: the end
  int every = 1; ///< take each n-th scan, >= 1
  bool keep_coordinates = false; ///< do not move far points towards the origin
  /** \throws BadArgument naming the first invalid field, with the value */
  void
  validate() const;
};

/** \brief Scans of a folder in natural order (scan2 before scan10), opened lazily: only
 * headers, poses and the first scan are read on construction.
 *
 * The points of the first scan may be too far away for a scanner at the origin
 * (PointsPlace::isFarFrom()), for example in national coordinates. All scans are then read in
 * double and moved near the origin (moved()), and the poses are adjusted: read() returns near
 * points in the frames of initialPose(). Three kinds of folders are told apart by their poses.
 * If the first pose lies amid the points, and the poses are closer together than the
 * transformed middles of the points, the points are in the world already
 * (PoseReading::kStation). If only the second condition is met, the points carry an offset
 * (kScanner). Otherwise, and without poses, the poses belong to the unchanged points (kFile).
 *
 * The initial poses are taken from the first available source: the given file; one
 * `scanNNN.pose` per scan (3DTK); `odometry.txt`; `poses.txt` (KITTI rows T_world_scan, one per
 * scan of the folder); PCD VIEWPOINT, or the headers of PTX, if at least one pose differs from
 * identity; identity. Files named `groundtruth*` are read only if given explicitly. Time stamps
 * are taken from TUM poses, else from `times.txt` or `timestamps.txt` (one stamp per line),
 * else from the names of the scans (stampsOfNames()). A folder of a published data set is
 * recognised (findDataset()): the folder of the scans, of a sequence, or of the data set, if
 * the data set has a single sequence. The number of rows must match all scans of the folder,
 * including scans skipped by first, last and every; if it does not, and poses and names of scans
 * have stamps, each scan takes the pose nearest in time. Stamps that contradict the names are
 * named in note(). \ingroup io */
class ScanFolder {
public:
  /** \throws IoFailed the folder is missing or unreadable, holds no scan, holds scans of several
   * formats (with kAuto), or the poses are incomplete or broken \throws BadArgument an option
   * is invalid, or selects no scan */
  explicit ScanFolder(const std::filesystem::path& folder,
                      const ScanFolderOptions& options = {});

  /** \brief Scans of a source instead of a folder. Names, poses and stamps come from the source,
   * unless options.poses_file gives poses; poses that all equal the identity count as missing.
   * \param[in] options the formats are ignored
   * \throws IoFailed the poses of the given file are incomplete or broken
   * \throws BadArgument an option is invalid, selects no scan, or the source is null */
  explicit ScanFolder(const std::shared_ptr<const ScanSource>& source,
                      const ScanFolderOptions& options = {});

  /** \brief A scan registered in a finished run, in the run's file. */
  struct Registered {
    std::filesystem::path file;
    std::string name; ///< see name()
    int index = 0;    ///< see index()
    Eigen::Isometry3d initial_pose = Eigen::Isometry3d::Identity();
  };

  /** \brief Scans of finished runs instead of a folder: every scan is registered.
   * \param[in] scans at least one \param[in] stamps [s] of every scan, or empty
   * \param[in] moved offset common to the runs
   * \param[in] source see poseSource()
   * \throws BadArgument no scan, or stamps missing for some scans */
  static ScanFolder
  ofRuns(const std::vector<Registered>& scans,
         std::vector<double> stamps,
         const std::optional<MovedPoints>& moved,
         const std::string& source);

  /** \brief Prepends the scans of a finished run, and removes scans of the folder that the run
   * already contains (same file name). Indices continue after the run's last index. Time stamps
   * are kept only if run and folder have stamps.
   * \param[in] run the run folder (share/doc/run_folder.md)
   * \param[in] summary of the run
   * \throws IoFailed a scan of the run is missing, or the folder has no new scan */
  void
  continueRun(const std::filesystem::path& run, const RunResult& summary);

  /** \return the number of scans, counted from the first, registered by a finished run; else 0 */
  std::size_t
  numRegistered() const
  {
    return num_registered_;
  }

  /** \return the number of selected scans, >= 1 */
  std::size_t
  size() const;

  /** \return the file of the i-th selected scan; several scans may share a file */
  const std::filesystem::path&
  file(std::size_t i) const;

  /** \return the name of the original file of the i-th scan in the folder; for a source, the
   * source's name of the scan */
  const std::string&
  name(std::size_t i) const;

  /** \return a name of the i-th scan for messages: the file, for a file of several scans with
   * the scan, such as "site.e57: scan 3 (Lobby)" */
  std::string
  title(std::size_t i) const;

  /** \return whether the i-th scan shares its file with further scans */
  bool
  sharesFile(std::size_t i) const
  {
    return entries_.at(i).source != nullptr;
  }

  /** \return the index of the i-th selected scan among all scans of the folder */
  int
  index(std::size_t i) const;

  /** \return the initial pose of the i-th selected scan, for points from read(); exactly rigid */
  const Eigen::Isometry3d&
  initialPose(std::size_t i) const;

  /** \return the initial pose for points in the file, before moved() */
  Eigen::Isometry3d
  poseOfFile(std::size_t i) const;

  /** \return time stamps [s] of the selected scans, or empty */
  const std::vector<double>&
  stamps() const;

  /** \return initial poses and stamps of all scans of the folder, including unselected scans */
  const Trajectory&
  odometry() const;

  /** \return the origin of the poses, for people: "odometry.txt", "PCD VIEWPOINT", "scan poses
   * (*.pose)", "identity", or the name of the given file; for a source the name of the source's
   * file */
  const std::string&
  poseSource() const;

  /** \brief Replaces the initial poses by estimated poses; also in odometry(), if all scans of
   * the folder are selected.
   * \param[in] poses T_world_scan of points from read(), for each selected scan
   * \param[in] source see poseSource()
   * \throws BadArgument the numbers of poses and scans differ, a pose is not a rigid motion, or
   * scans are registered */
  void
  replacePoses(const std::vector<Eigen::Isometry3d>& poses, const std::string& source);

  /** \brief Reduces the selection; odometry() keeps the poses of all scans.
   * \param[in] places positions in the selection to keep, increasing, not empty
   * \throws BadArgument the positions are empty, not increasing or beyond the end, or scans are
   * registered */
  void
  keepOnly(const std::vector<std::size_t>& places);

  /** \return whether replacePoses() gave the initial poses */
  bool
  posesAreEstimated() const
  {
    return are_estimated_;
  }

  /** \return false without a pose source: all poses are the identity */
  bool
  hasPoses() const;

  /** \return whether the initial poses tell where the scans are: there are poses, and those of
   * the selected scans are not all equal, as a constant VIEWPOINT is. Poses of fewer than three
   * scans, and estimated poses, always count */
  bool
  posesDiffer() const;

  /** \return the offset of points far from the origin; empty: points are not moved */
  const std::optional<MovedPoints>&
  moved() const
  {
    return moved_;
  }

  /** \return moved() as a line of text; empty if points are not moved */
  const std::string&
  coordinates() const
  {
    return coordinates_;
  }

  /** \return a single-line remark for the user on the selection of the scans; may be empty */
  const std::string&
  note() const
  {
    return note_;
  }

  /** \return the layout of the published data set of the scans; empty: unknown */
  const std::optional<DatasetLayout>&
  layout() const
  {
    return layout_;
  }

  /** \brief Reads the i-th selected scan. \throws IoFailed under the conditions of readScan() */
  Scan
  read(std::size_t i) const;

  /** \brief read() without a second copy of x, y, z. */
  ScanCloud
  readCloud(std::size_t i) const;

  /** \return the format of the first scan; kAuto for an external format
   * (ScanFolderOptions::other_format) */
  ScanFormat
  format() const;

  /** \return the name of the format; for a source the name of the source's format */
  std::string
  formatName() const;

private:
  ScanFolder() = default;

  struct Entry {
    std::filesystem::path file;
    std::string name;
    int index = 0;
    Eigen::Isometry3d given = Eigen::Isometry3d::Identity();
    ScanFormat format = ScanFormat::kAuto; ///< auto: other_format_
    bool is_far = false;                   ///< points are moved on reading
    Eigen::Isometry3d pose = Eigen::Isometry3d::Identity(); ///< of the points as read
    std::shared_ptr<const ScanSource> source = {}; ///< the source of the scan, or null
    std::size_t number = 0;                        ///< of the scan in the source
  };

  void
  takeLayout(const io::FoundScans& scans,
             const ScanFolderOptions& options,
             const std::vector<double>& stamps);
  void
  select(std::vector<Entry> all,
         Trajectory trajectory,
         const ScanFolderOptions& options);
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
  ScanReaderOptions reading_; ///< without the format, stored in each entry
  std::vector<double> stamps_;
  Trajectory odometry_;
  std::string pose_source_;
  bool are_estimated_ = false;
  std::size_t num_registered_ = 0;
  std::optional<MovedPoints> moved_;
  std::string coordinates_;
  std::string note_;
  std::optional<DatasetLayout> layout_;
  mutable std::shared_ptr<ScanCloud> first_; ///< the first scan, until handed out
};

/** \return the time stamps [s] of a run's scans; empty if the run stores indices instead
 * \throws IoFailed trajectory.tum cannot be read, or the number of rows differs from the number
 * of scans
 * \ingroup io */
std::vector<double>
stampsOfRun(const std::filesystem::path& run, const RunResult& summary);

/** \brief Looks up the pose of a single scan, outside of a folder.
 * \return the pose in the `.pose` file beside the scan, or in the PCD VIEWPOINT or PTX header,
 * unless the identity \throws IoFailed the pose is broken \ingroup io */
std::optional<Eigen::Isometry3d>
findScanPose(const std::filesystem::path& scan, ScanFormat format = ScanFormat::kAuto);

} // namespace pcl6d

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/error.h>
#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/common/progress.h>
#include <pcl6d/moving_objects/point_motion.h>
#include <pcl6d/slam6d/slam6d_options.h>
#include <pcl6d/slam6d/slam6d_result.h>
#include <pcl6d/slam6d/task_memory.h>

#include <pcl/point_cloud.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <string>

namespace PCL6D_EXPORTS pcl6d {

class WorkSharing;

/** \brief 6D SLAM as a class (book, chapter 6.1): scans and rough poses in, a
 * consistent trajectory out.
 *
 * Scans are gated by range and reduced as they are added. optimize() registers them one
 * after the other: the odometry's motion is carried over to the corrected pose (5.1.1),
 * then ICP (4.1) matches the scan against the union of earlier scans (metascan). A scan
 * that cannot be matched keeps its predicted pose, says so in its state, and is left
 * out of the metascan; so is one with little overlap or with pairs as far apart as
 * those of unrelated clouds (rms above 0.6 of max_distance). The first scan keeps its
 * pose. With InitialGuess::kGlobal initial poses and the order of the scans do not matter:
 * all are joined by what they see, and the scan with which the largest group began is the
 * origin; other groups lie beside it and are floating. The same bits for any number of
 * threads.
 * \code
 * pcl6d::Slam6D slam;
 * for (...)
 *   slam.addScan(cloud, rough_pose);
 * slam.optimize();
 * for (const auto& scan : slam.result().scans)
 *   use(scan.T_world_scan);
 * \endcode \ingroup slam6d */
class Slam6D {
public:
  /** \brief Called after each scan with its place and its result. */
  using Observer = std::function<void(std::size_t, const ScanResult&)>;

  /** \throws BadArgument an option breaks its rule */
  explicit Slam6D(const Slam6DOptions& options = {});
  ~Slam6D();
  Slam6D(Slam6D&&) noexcept;
  Slam6D&
  operator=(Slam6D&&) noexcept;

  /** \brief Adds a scan. Its points are kept until it and the next one are registered,
   * then only the reduced ones.
   * \param[in] points in the scan's own frame, right-handed [m]; NaN points are dropped
   * \param[in] initial_pose rough T_world_scan, e.g. odometry
   * \param[in] name for messages, e.g. its file; empty: "scan 7"
   * \throws BadArgument fewer than 3 finite points, or the pose is not rigid
   * \throws ComputeFailed as optimize() */
  void
  addScan(const Points& points,
          const Eigen::Isometry3d& initial_pose,
          const std::string& name = "");

  /** \brief Adds a scan that was taken on the move: its motion is found from its points and
   * those of the scans before and after it, and undone; initial poses need not tell of it
   * (`--deskew estimate`, share/doc/run_folder.md). It is kept as it is where that does not make
   * the scans agree better. When all are registered, the motion of all is found anew at once.
   * ScanResult::motion says what was found; undoMotion() brings further points of the scan there.
   * \param[in] points each in the scanner's frame at its own time [m]
   * \param[in] times of the points; a scan appears in the result when the one after it is
   * added, or in optimize()
   * \throws BadArgument as above, also if there is not one finite time per point, or the work
   * is shared (setSharing()) \throws ComputeFailed as optimize() */
  void
  addScan(const Points& points,
          const ScanTimes& times,
          const Eigen::Isometry3d& initial_pose,
          const std::string& name = "");

  /** \brief Adds a scan that an earlier run has registered: its result stands, and the
   * scans that follow are matched against it. The relaxation may move it. Scans of several
   * runs, which have no common world, are joined with InitialGuess::kGlobal: each run is moved
   * in one piece into the world of the one with the smallest number; then all are relaxed.
   * \param[in] earlier its initial pose, T_world_scan and all else that was found; of one
   * that was predicted the place is looked for anew with kGlobal
   * \param[in] group number of its run
   * \throws BadArgument as addScan(); it is pending, or a scan before it was not added
   * so; a second group without kGlobal \throws ComputeFailed as optimize() */
  void
  addRegistered(const Points& points,
                const ScanResult& earlier,
                const std::string& name = "",
                std::size_t group = 0);

  /** \brief The same for a PCL cloud. Its sensor_origin_ and sensor_orientation_ are
   * ignored: the points are taken to be in the scan's frame, and initial_pose alone says
   * where that is. */
  template <typename PointT>
  void
  addScan(const pcl::PointCloud<PointT>& cloud,
          const Eigen::Isometry3d& initial_pose,
          const std::string& name = "")
  {
    addScan(toPoints(cloud), initial_pose, name);
  }

  /** \brief The same for a Ptr or ConstPtr of a PCL cloud, which is not kept.
   * \throws BadArgument also if it is null */
  template <typename Cloud>
  void
  addScan(const pcl::shared_ptr<Cloud>& cloud,
          const Eigen::Isometry3d& initial_pose,
          const std::string& name = "")
  {
    if (!cloud)
      throw BadArgument(
          (name.empty() ? "scan " + std::to_string(result().scans.size()) : name) +
          ": the cloud is null");
    addScan(*cloud, initial_pose, name);
  }

  /** \brief Registers all scans that were added and not yet registered.
   * \return false if cancel() stopped it; calling it again goes on, with kGlobal from the
   * start
   * \throws BadArgument no scan was added
   * \throws ComputeFailed the range gate leaves a scan with fewer than 3 points, or its
   * extent has more voxels than the grid can number
   * \throws GroupsApart runs that are to be joined do not meet, or in several ways */
  bool
  optimize();

  /** \brief Asks a running optimize() to stop after the current scan. May be called
   * from another thread or a callback. */
  void
  cancel();

  /** \brief Results so far. Scans not yet registered are kPending, at predicted poses.
   */
  const Slam6DResult&
  result() const;

  /** \brief Which of some points of a scan moved, as other scans saw their places free at other
   * times; see MovingPoints. After optimize(), with Slam6DOptions::leave_out_moving. Where
   * little of a scan moved, points that are not near it are kStatic, which says no more than that.
   * \param[in] scan its place \param[in] points [m] in its frame, all measured ones say
   * \return one per point \throws BadArgument optimize() has not judged such a scan */
  std::vector<PointMotion>
  motionOf(std::size_t scan, const Points& points) const;

  void
  setProgressCallback(ProgressCallback callback);
  void
  setObserver(Observer observer);

  /** \brief Tasks whose results it knows are not done again. \param[in] memory asked and
   * told during optimize(); null: none. Kept by reference */
  void
  setMemory(TaskMemory* memory);

  /** \brief Several processes do the work together: each makes the same calls with the same
   * options, scans and poses, and comes to the same result. The points of a scan are needed by
   * the first rank and by the one that owns its place; others may add it without points. The
   * first rank alone matches scan after scan, is asked for cancel(), and has memory and
   * observers. All but setters are collective then, see WorkSharing.
   * \param[in] sharing null: this process does all; to be set before the first scan is added.
   * Kept by reference \note addScan() and optimize() also throw RankFailed */
  void
  setSharing(WorkSharing* sharing);

private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

} // namespace pcl6d

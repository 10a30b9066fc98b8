// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/error.h>
#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>
#include <pcl6d/common/posed_points.h>
#include <pcl6d/common/progress.h>
#include <pcl6d/moving_objects/point_motion.h>
#include <pcl6d/slam6d/slam6d_options.h>
#include <pcl6d/slam6d/slam6d_result.h>
#include <pcl6d/slam6d/slam_stage.h>

#include <pcl/point_cloud.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

class TaskMemory;
class WorkSharing;

/** \brief What lidar odometry over the sweeps of a drive tells of one of its keyframes. */
struct DriveContext {
  /** surfaces measured the motion of the initial poses from the scan before, without a direction
   * left open: where the match of both scans leaves a direction open, this motion fixes it */
  bool is_step_measured = false;
  /** sweeps around the scan, each with T_scan_sweep as tracked: the scan is matched, relaxed and
   * verified with their points, too, since few lines of a single sweep show no surface. They are
   * gated as scans are, and reduced together. Rays and the map are of the scan alone; of 2D scans,
   * dense as they are, only the scan counts */
  std::vector<PosedPoints> submap;
  /** covariance of the frame of the scan against its points, for small motions (translation [m],
   * rotation [rad]) in its own axes: the motion within the scan is not exactly known. Links match
   * points, so they do not show it; bounds of positions contain it */
  Eigen::Matrix<double, 6, 6> frame = Eigen::Matrix<double, 6, 6>::Zero();
};

/** \brief 6D SLAM as a class (book, chapter 6.1): scans and rough poses in, a consistent trajectory
 * out.
 *
 * Scans are gated by range and reduced when added. optimize() registers the scans in order: the
 * odometry's motion is applied to the corrected pose (5.1.1), then ICP (4.1) matches the scan with
 * the union of earlier scans (metascan). An unmatched scan keeps its predicted pose, has the state
 * kPredicted, and is left out of the metascan. A match is rejected if the overlap is small, or if
 * the pairs are as far apart as in unrelated clouds (rms above 0.6 of max_distance). The first
 * scan keeps its pose. With InitialGuess::kGlobal, initial poses and the order of the scans are
 * ignored: scans are joined by common surfaces. The first scan of the largest group is then the
 * origin; further groups are placed beside it and are floating. The same bits for any number of
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
  /** \brief Called after each scan with its index and its result. */
  using Observer = std::function<void(std::size_t, const ScanResult&)>;

  /** \throws BadArgument an option is invalid */
  explicit Slam6D(const Slam6DOptions& options = {});
  ~Slam6D();
  Slam6D(Slam6D&&) noexcept;
  Slam6D&
  operator=(Slam6D&&) noexcept;

  /** \brief Adds a scan. All its points are kept until the next scan is registered, then only the
   * reduced points.
   * \param[in] points in the scan's own frame, right-handed [m]; NaN points are dropped
   * \param[in] initial_pose rough T_world_scan, e.g. odometry
   * \param[in] name for messages, e.g. its file; empty: "scan 7"
   * \param[in] drive of a keyframe: what lidar odometry over the sweeps of a drive tells
   * \throws BadArgument fewer than 3 finite points, or the pose is not rigid
   * \throws ComputeFailed as optimize() */
  void
  addScan(const Points& points,
          const Eigen::Isometry3d& initial_pose,
          const std::string& name = "",
          const DriveContext& drive = {});

  /** \brief Adds a scan taken in motion. The motion is estimated from the points of this and the
   * neighbouring scans, and the scan is deskewed; initial poses need not contain the motion
   * (`--deskew estimate`, share/doc/run_folder.md). A scan stays as measured unless deskewing
   * improves the agreement of the scans. When all scans are registered, their motions are
   * estimated again, together. ScanResult::motion has the result; undoMotion() applies it to
   * further points of the scan.
   * \param[in] points each in the scanner's frame at its own time [m]
   * \param[in] times of the points; a scan appears in the result when the next scan is added, or
   * in optimize()
   * \throws BadArgument as above; the number of finite times and of points differ; or the work is
   * shared (setSharing()) \throws ComputeFailed as optimize() */
  void
  addScan(const Points& points,
          const ScanTimes& times,
          const Eigen::Isometry3d& initial_pose,
          const std::string& name = "");

  /** \brief Adds a scan registered by an earlier run: its result is kept, and later scans are
   * matched with it. The relaxation may move it. Scans of several runs, which have no common
   * world, are joined with InitialGuess::kGlobal: each run is moved in one piece into the world of
   * the run with the smallest number; then all are relaxed.
   * \param[in] earlier complete result of the scan, with initial pose and T_world_scan; with
   * kGlobal, the pose of a predicted scan is searched for again
   * \param[in] group number of its run
   * \throws BadArgument as addScan(); the scan is pending; an earlier scan was added by addScan();
   * a second group without kGlobal \throws ComputeFailed as optimize() */
  void
  addRegistered(const Points& points,
                const ScanResult& earlier,
                const std::string& name = "",
                std::size_t group = 0);

  /** \brief Adds a PCL cloud. Its sensor_origin_ and sensor_orientation_ are ignored: points are in
   * the scan's frame, and initial_pose is the pose of this frame. */
  template <typename PointT>
  void
  addScan(const pcl::PointCloud<PointT>& cloud,
          const Eigen::Isometry3d& initial_pose,
          const std::string& name = "")
  {
    addScan(toPoints(cloud), initial_pose, name);
  }

  /** \brief Adds a PCL cloud by its Ptr or ConstPtr, which is not kept.
   * \throws BadArgument also if the cloud is null */
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

  /** \brief Adds a user's stage to the run; several stages run in the order of addition. If
   * processes share the work, each process runs the stage.
   * \throws BadArgument the stage is null, or optimize() was called before; optimize() throws it
   * if the stage changes the number of scans, or gives a pose that is not rigid or an invalid
   * pair */
  void
  addStage(std::shared_ptr<SlamStage> stage, SlamStage::Place place);

  /** \brief Registers all scans not yet registered.
   * \return false if stopped by cancel(); the next call continues, with kGlobal from the start
   * \throws BadArgument no scan was added
   * \throws ComputeFailed the range gate leaves a scan with fewer than 3 points, or its extent has
   * more voxels than the grid can number
   * \throws GroupsApart runs to be joined do not overlap, or can be joined in several ways */
  bool
  optimize();

  /** \brief Asks a running optimize() to stop after the current scan, also while scans are
   * prepared. May be called from another thread or a callback. */
  void
  cancel();

  /** \brief The present results. Scans not yet registered are kPending, at predicted poses. */
  const Slam6DResult&
  result() const;

  /** \brief The state of motion of a scan's points, tested by rays of scans taken at different
   * times; see MovingPoints. Requires optimize() with Slam6DOptions::leave_out_moving. If few
   * points of a scan are dynamic, points far from dynamic ones are kStatic without a test.
   * \param[in] scan index \param[in] points [m] in its frame, e.g. all measured points
   * \return one per point \throws BadArgument optimize() has not tested this scan */
  std::vector<PointMotion>
  motionOf(std::size_t scan, const Points& points) const;

  void
  setProgressCallback(ProgressCallback callback);
  void
  setObserver(Observer observer);

  /** \brief Sets a cache of results: tasks with a known result are not repeated. \param[in] memory
   * read and filled during optimize(); null: none. Kept by reference */
  void
  setMemory(TaskMemory* memory);

  /** \brief Shares the work between several processes. Each process makes equal calls with equal
   * options, scans and poses, and gets the same result. The points of a scan are needed by the
   * first rank and by the scan's owner; the remaining ranks may add it without points. Only the
   * first rank matches scans in sequence, reacts to cancel(), and has memory and observers. All
   * calls except setters are then collective, see WorkSharing.
   * \param[in] sharing null: a single process; to be set before the first scan is added. Kept by
   * reference \note addScan() and optimize() also throw RankFailed */
  void
  setSharing(WorkSharing* sharing);

private:
  class Implementation;
  std::unique_ptr<Implementation> implementation_;
};

} // namespace pcl6d

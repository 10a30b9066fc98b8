// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/points.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <functional>
#include <memory>
#include <string>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Options of LiveView. */
struct LiveViewOptions {
  int width = 1280; ///< [px] 200 to 8192
  int height = 800; ///< [px] 200 to 8192
  std::string title = "pcl6d";
  std::size_t points_per_scan = 10000; ///< more are thinned evenly; > 0

  /** \throws BadArgument naming the first invalid field and its value */
  void
  validate() const;
};

/** \brief A window on the user's display (the variable DISPLAY) that shows a map while it
 * grows: registered scans, each in a colour of its own, their trajectory in white, and the
 * poses before registration in orange. The mouse turns and moves the view, which otherwise
 * follows the map.
 *
 * The window lives in a process of its own, made by fork(): a crash of the window or of the
 * user's display does not affect the caller, and no call waits for drawing. Construct a
 * LiveView before the PrivateDisplay, and before threads that may hold a lock. Calls after
 * the window was closed have no effect. The window's process ends with the LiveView and
 * with the calling process, even a killed one. Ctrl-C acts only on the calling process.
 * \ingroup visualization */
class LiveView {
public:
  /** \throws IoFailed no display, or the display cannot show the window
   * \throws BadArgument an option is invalid */
  explicit LiveView(const LiveViewOptions& options = LiveViewOptions());
  /** \brief Closes the window. */
  ~LiveView();
  LiveView(const LiveView&) = delete;
  LiveView&
  operator=(const LiveView&) = delete;

  /** \brief Adds the next scan; its points become visible with place().
   * \param[in] points in the scan's frame [m]; NaN is skipped
   * \param[in] initial_pose T_world_scan before registration */
  void
  addScan(const Points& points, const Eigen::Isometry3d& initial_pose);

  /** \brief Shows a scan at a pose, or moves the scan to the pose.
   * \param[in] scan its index, from 0 in the order of addScan()
   * \throws BadArgument the index is out of range */
  void
  place(std::size_t scan, const Eigen::Isometry3d& T_world_scan);

  /** \brief Sets the line of text at the lower edge. */
  void
  setText(const std::string& text);

  /** \return whether the user has not closed the window */
  bool
  isOpen();

  /** \brief Waits until the window is closed. \param[in] stop called several times a
   * second; true ends the wait */
  void
  waitUntilClosed(const std::function<bool()>& stop);

private:
  struct Process;
  LiveViewOptions options_;
  std::size_t num_scans_ = 0;
  /** first initial position: OpenGL's numbers are too short for world coordinates */
  Eigen::Vector3d origin_ = Eigen::Vector3d::Zero();
  std::unique_ptr<Process> process_;
};

} // namespace pcl6d

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "common/progress_bar.h"

#include <pcl6d/common/points.h>
#include <pcl6d/slam6d/slam6d_result.h>
#include <pcl6d/visualization/live_view.h>

#include <functional>
#include <optional>
#include <vector>

namespace pcl6d::app {

/** \brief The live view of a run, if it is wanted and there is a display. */
class LiveWindow {
public:
  /** \brief Opens it, or warns that it cannot be opened: the run needs no window. */
  LiveWindow(bool wanted, const std::string& title, ProgressBar& bar);

  /** \brief A scan was read. */
  void
  add(const Points& points, const Eigen::Isometry3d& initial_pose);

  /** \brief Shows the scans that are registered where they are now. */
  void
  update(const Slam6DResult& result);

  /** \brief Tells what the run does. */
  void
  show(const Progress& progress);

  /** \brief Leaves the result to be looked at until the window is closed, or stop says
   * true. */
  void
  linger(const std::string& verdict, const std::function<bool()>& stop);

private:
  std::optional<LiveView> view_;
  std::vector<Eigen::Isometry3d> placed_; ///< of the scans that are seen
  ProgressBar& bar_;
};

} // namespace pcl6d::app

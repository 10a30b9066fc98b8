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

/** \brief The live view of a run, if requested and if a display is available. */
class LiveWindow {
public:
  /** \brief Opens the window, or warns if opening fails: the run needs no window. */
  LiveWindow(bool wanted, const std::string& title, ProgressBar& bar);

  /** \brief A scan was read. */
  void
  add(const Points& points, const Eigen::Isometry3d& initial_pose);

  /** \brief Shows the registered scans at their present poses. */
  void
  update(const Slam6DResult& result);

  /** \brief Shows the progress of the run. */
  void
  show(const Progress& progress);

  /** \brief Shows the result until the window is closed, or stop returns true. */
  void
  linger(const std::string& verdict, const std::function<bool()>& stop);

private:
  std::optional<LiveView> view_;
  std::vector<Eigen::Isometry3d> placed_; ///< of the visible scans
  ProgressBar& bar_;
};

} // namespace pcl6d::app

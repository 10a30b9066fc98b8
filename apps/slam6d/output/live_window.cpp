// SPDX-License-Identifier: BSD-3-Clause
#include "slam6d/output/live_window.h"

#include <pcl6d/common/error.h>

namespace pcl6d::app {

LiveWindow::LiveWindow(bool wanted, const std::string& title, ProgressBar& bar)
: bar_(bar)
{
  if (!wanted)
    return;
  LiveViewOptions options;
  options.title = title;
  try {
    view_.emplace(options);
  } catch (const IoFailed& e) {
    bar_.warn(std::string(e.what()) + "; the run goes on without");
  }
}

void
LiveWindow::add(const Points& points, const Eigen::Isometry3d& initial_pose)
{
  if (view_)
    view_->addScan(points, initial_pose);
}

void
LiveWindow::update(const Slam6DResult& result)
{
  if (!view_)
    return;
  for (std::size_t i = 0; i < result.scans.size(); ++i) {
    const ScanResult& scan = result.scans[i];
    if (scan.state == ScanState::kPending)
      return;
    if (i < placed_.size() && placed_[i].isApprox(scan.T_world_scan, 0))
      continue;
    placed_.resize(std::max(placed_.size(), i + 1), Eigen::Isometry3d::Identity());
    placed_[i] = scan.T_world_scan;
    view_->place(i, scan.T_world_scan);
  }
}

void
LiveWindow::show(const Progress& progress)
{
  if (view_)
    view_->setText(progress.stage + ' ' + std::to_string(progress.done) + '/' +
                   std::to_string(progress.total));
}

void
LiveWindow::linger(const std::string& verdict, const std::function<bool()>& stop)
{
  if (!view_ || !view_->isOpen() || stop())
    return;
  view_->setText(verdict);
  bar_.say(
      "the results are written; close the window (key q), or press Ctrl-C, to end");
  view_->waitUntilClosed(stop);
}

} // namespace pcl6d::app

// SPDX-License-Identifier: BSD-3-Clause
#include "slam_run.h"

#include <pcl6d/slam6d/slam6d.h>

#include <utility>

namespace pcl6d {

class Slam6D::Implementation : public slam6d::SlamRun {
  using SlamRun::SlamRun;
};

Slam6D::Slam6D(const Slam6DOptions& options)
: implementation_(std::make_unique<Implementation>(options))
{}

Slam6D::~Slam6D() = default;
Slam6D::Slam6D(Slam6D&&) noexcept = default;
Slam6D&
Slam6D::operator=(Slam6D&&) noexcept = default;

void
Slam6D::addScan(const Points& points,
                const Eigen::Isometry3d& initial_pose,
                const std::string& name,
                const DriveContext& drive)
{
  ScanResult scan;
  scan.initial_pose = initial_pose;
  scan.T_world_scan = initial_pose;
  implementation_->addStill(points, scan, name, drive);
}

void
Slam6D::addScan(const Points& points,
                const ScanTimes& times,
                const Eigen::Isometry3d& initial_pose,
                const std::string& name)
{
  implementation_->addMoving(points, times, initial_pose, name);
}

void
Slam6D::addRegistered(const Points& points,
                      const ScanResult& earlier,
                      const std::string& name,
                      std::size_t group)
{
  implementation_->addRegistered(points, earlier, name, group);
}

void
Slam6D::addStage(std::shared_ptr<SlamStage> stage, SlamStage::Place place)
{
  implementation_->addStage(std::move(stage), place);
}

bool
Slam6D::optimize()
{
  return implementation_->optimize();
}

void
Slam6D::cancel()
{
  implementation_->context.cancelled = true;
}

const Slam6DResult&
Slam6D::result() const
{
  return implementation_->result();
}

std::vector<PointMotion>
Slam6D::motionOf(std::size_t scan, const Points& points) const
{
  return implementation_->motionOf(scan, points);
}

void
Slam6D::setProgressCallback(ProgressCallback callback)
{
  implementation_->context.progress = std::move(callback);
}

void
Slam6D::setMemory(TaskMemory* memory)
{
  implementation_->context.memory = memory;
}

void
Slam6D::setSharing(WorkSharing* sharing)
{
  implementation_->setSharing(sharing);
}

void
Slam6D::setObserver(Observer observer)
{
  implementation_->context.observer = std::move(observer);
}

} // namespace pcl6d

// SPDX-License-Identifier: BSD-3-Clause
#include "sweep_track.h"

#include <pcl6d/common/name_table.h>
#include <pcl6d/common/require.h>

#include <cmath>
#include <utility>

namespace pcl6d {

namespace {
constexpr Named<SweepStatus> kSweepStatuses[] = {
    {SweepStatus::kFirst, "first"},
    {SweepStatus::kTracked, "tracked"},
    {SweepStatus::kFoundAgain, "found again"},
    {SweepStatus::kLost, "lost"}};

} // namespace

const char*
toString(SweepStatus status)
{
  return nameOf(kSweepStatuses, status);
}

void
SweepTrackerOptions::validate() const
{
  require(!voxel || (std::isfinite(*voxel) && *voxel > 0),
          "voxel",
          voxel.value_or(0),
          "finite and > 0");
  require(max_range > 0, "max_range", max_range, "> 0");
  require(points_of_match >= odometry::kLeastSweepPoints,
          "points_of_match",
          points_of_match,
          ">= 100");
  require(keyframe_way > 0, "keyframe_way", keyframe_way, "> 0");
  require(keyframe_overlap > 0 && keyframe_overlap < 1,
          "keyframe_overlap",
          keyframe_overlap,
          "in (0, 1)");
}

SweepTracker::SweepTracker(const SweepTrackerOptions& options)
: track_(std::make_unique<Track>(options))
{}
SweepTracker::~SweepTracker() = default;
SweepTracker::SweepTracker(SweepTracker&&) noexcept = default;
SweepTracker&
SweepTracker::operator=(SweepTracker&&) noexcept = default;

TrackedSweep
SweepTracker::track(const Sweep& sweep)
{
  return track_->track(sweep);
}

const std::vector<TrackedSweep>&
SweepTracker::openingOfSegment() const
{
  return track_->corrected();
}

double
SweepTracker::voxel() const
{
  return track_->voxel();
}

double
SweepTracker::resolution() const
{
  return track_->resolution();
}

std::size_t
SweepTracker::sweepsOfSurface() const
{
  return track_->sweepsOfSurface();
}

std::size_t
SweepTracker::mapBytes() const
{
  return track_->mapBytes();
}

} // namespace pcl6d

// SPDX-License-Identifier: BSD-3-Clause
#include "calibration.h"
#include "group/scan_group.h"
#include "pair/place_matching.h"

#include <pcl6d/common/portable_math.h>

#include <algorithm>

namespace pcl6d::global_registration {

namespace {
/** A scan is matched with this number of scans, by largest overlap. */
constexpr std::size_t kMatchedWith = 6;

/** Least number of common points, of both scans, for an overlap. */
constexpr double kLeastMet = 12;
} // namespace

ScanGroup::ScanGroup(const ScanList& scans) : scans_(&scans)
{}

void
ScanGroup::add(std::size_t scan, const Eigen::Isometry3d& T_group_scan)
{
  members_.push_back({scan, T_group_scan});
}

void
ScanGroup::remove(std::size_t scan)
{
  members_.erase(std::remove_if(members_.begin(),
                                members_.end(),
                                [&](const auto& one) { return one.scan == scan; }),
                 members_.end());
}

std::optional<Eigen::Isometry3d>
ScanGroup::placeOf(std::size_t scan) const
{
  for (const auto& one : members_)
    if (one.scan == scan)
      return one.T_group_scan;
  return std::nullopt;
}

bool
ScanGroup::reaches(std::size_t scan,
                   const Eigen::Isometry3d& T,
                   const PlacedScan& other) const
{
  const auto& a = (*scans_)[scan]->ball();
  const auto& b = (*scans_)[other.scan]->ball();
  return (T * a.centre - other.T_group_scan * b.centre).norm() < a.radius + b.radius;
}

JointSupport
ScanGroup::support(std::size_t scan,
                   const Eigen::Isometry3d& T_group_scan,
                   double distance,
                   double sigma,
                   double scale,
                   std::size_t every) const
{
  const PlaceableScan& moved = *(*scans_)[scan];
  std::vector<PointSight> any(moved.evaluated().points.size(), PointSight::kNotAsked);
  PlaceSupport both; // summed over the pairs of scans
  std::vector<std::pair<double, std::size_t>> met;
  for (std::size_t k = 0; k < members_.size(); ++k) {
    const PlacedScan& member = members_[k];
    if (member.scan == scan || !reaches(scan, T_group_scan, member))
      continue;
    const PlaceableScan& fixed = *(*scans_)[member.scan];
    const Eigen::Isometry3d T = member.T_group_scan.inverse() * T_group_scan;
    const auto there = lookAt(fixed, moved, T, distance, sigma, every);
    PlaceSupport pair;
    count(moved, there, pair);
    count(fixed, lookAt(moved, fixed, T.inverse(), distance, sigma, every), pair);
    both += pair;
    if (pair.met() >= kLeastMet)
      met.emplace_back(-pair.met(), k);
    for (std::size_t i = 0; i < any.size(); ++i)
      any[i] = std::max(any[i],
                        there[i] == PointSight::kMet        ? PointSight::kMet
                        : there[i] == PointSight::kNotAsked ? PointSight::kNotAsked
                                                            : PointSight::kNothing);
  }
  PlaceSupport own;
  count(moved, any, own);
  JointSupport joint;
  joint.overlap = own.overlap();
  joint.contradiction = both.contradiction();
  joint.met_points = both.met();
  joint.free_points = both.level.free + both.other.free;
  joint.score = joint.overlap * portableExp(-joint.contradiction / scale);
  std::sort(met.begin(), met.end());
  for (const auto& one : met)
    joint.met.push_back(one.second);
  return joint;
}

Eigen::Isometry3d
ScanGroup::matched(std::size_t scan,
                   const Eigen::Isometry3d& T_group_scan,
                   const std::vector<std::size_t>& met,
                   double start,
                   MatchedBy by) const
{
  IcpTarget target;
  // Relative to the pose: small coordinates, whatever the frame of the group.
  const Eigen::Translation3d to(T_group_scan.translation());
  for (std::size_t k = 0; k < std::min(met.size(), kMatchedWith); ++k) {
    const PlacedScan& member = members_[met[k]];
    target.push_back((*scans_)[member.scan]->scan().surfaces().part(
        to.inverse() * member.T_group_scan));
  }
  if (target.empty())
    return T_group_scan;
  const auto& sample =
      by == MatchedBy::kAll ? (*scans_)[scan]->matched() : (*scans_)[scan]->evaluated();
  const IcpResult found = icp(target,
                              {&sample.points, &sample.normals},
                              to.inverse() * T_group_scan,
                              matchingOptions((*scans_)[scan]->scan().voxel(), start));
  return to * found.T_target_source;
}

} // namespace pcl6d::global_registration

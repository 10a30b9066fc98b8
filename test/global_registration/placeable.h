// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "verification/verified_rooms.h"

#include <pcl6d/global_registration/placeable_scan.h>

#include <cstddef>
#include <deque>

namespace pcl6d::test {

/** \brief Scans of one room, or of several, ready to be placed. */
class Placeable {
public:
  void
  add(const Points& measured, double voxel = kVoxel)
  {
    verified_.add(measured, voxel);
    scans_.emplace_back(verified_.all().back());
  }
  const std::deque<PlaceableScan>&
  all() const
  {
    return scans_;
  }
  const PlaceableScan&
  operator[](std::size_t i) const
  {
    return scans_[i];
  }

private:
  VerifiedScans verified_;
  std::deque<PlaceableScan> scans_;
};

} // namespace pcl6d::test

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "verification/verified_rooms.h"

#include <pcl6d/global_registration/placeable_scan.h>

#include <cstddef>
#include <deque>

namespace pcl6d::test {

constexpr double kPlaceTol = kVoxel / 3; ///< [m]
constexpr double kTurnTol = 0.01;        ///< [rad] the same at walls 5 m away

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

constexpr double kFineTol = 0.02; // [m] what the class promises in a room

constexpr double kFineTurn = 0.004; // [rad] the same at walls 5 m away

inline const ScannedPair&
scannedPair()
{
  static const ScannedPair scans;
  return scans;
}

} // namespace pcl6d::test

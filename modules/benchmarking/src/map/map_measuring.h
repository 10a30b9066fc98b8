// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "map/map_scan.h"

#include <pcl6d/graph_relaxation/network_scan.h>

namespace pcl6d::benchmarking {

/** \brief Computes the measures of a map one by one from scans prepared once. The world
 * is moved by whole metres, with the first scan near the origin. */
class MapMeasuring {
public:
  MapMeasuring(const std::vector<Points>& scans,
               const std::vector<Eigen::Isometry3d>& poses,
               const MapQualityOptions& options);
  MapMeasuring(const MapMeasuring&) = delete; // the network refers to the scans
  MapMeasuring&
  operator=(const MapMeasuring&) = delete;

  /** \brief Finds overlapping scans and their agreement. Must come first. */
  void
  measureAgreement(MapQuality& quality);

  /** \brief Distances between overlapping scans, including steps and revisits. */
  void
  measureDistances(MapQuality& quality) const;

  /** \brief Entropy and plane variance. */
  void
  measureSpread(MapQuality& quality) const;

  /** \brief Thickness of the planes of at most 50 scans, evenly chosen: other scans see
   * mostly the same planes. */
  void
  measurePlanes(MapQuality& quality) const;

  /** \brief Distances to a cloud in the world. */
  void
  measureReference(const Points& reference, MapQuality& quality) const;

private:
  std::vector<PlaneSegment>
  planesOfScans() const;
  double
  within() const;
  double
  maxDistance() const;
  std::size_t
  revisitGap() const;

  const MapQualityOptions& options_;
  Eigen::Vector3d origin_; ///< [m] whole metres, subtracted from the world
  Poses poses_;            ///< in the moved world
  std::vector<MapScan> scans_;
  std::vector<NetworkScan> network_;
  std::vector<ScanPair> pairs_;
};

} // namespace pcl6d::benchmarking

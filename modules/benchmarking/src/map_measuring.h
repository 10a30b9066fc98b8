// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "map_scan.h"

#include <pcl6d/graph_relaxation/network_scan.h>

namespace pcl6d::benchmarking {

/** \brief The scans of a map, prepared once, and its measures one after the other. The
 * world is moved by whole metres so that the first scan is near its origin. */
class MapMeasuring {
public:
  MapMeasuring(const std::vector<Points>& scans,
               const std::vector<Eigen::Isometry3d>& poses,
               const MapQualityOptions& options);
  MapMeasuring(const MapMeasuring&) = delete; // the network refers to the scans
  MapMeasuring&
  operator=(const MapMeasuring&) = delete;

  /** \brief Which scans see each other, and how well they agree. First of all. */
  void
  measureAgreement(MapQuality& quality);

  /** \brief Distances between scans that see each other, steps and revisits among them. */
  void
  measureDistances(MapQuality& quality) const;

  /** \brief Entropy and plane variance. */
  void
  measureSpread(MapQuality& quality) const;

  /** \brief Thickness of the planes of single scans, at most 50 of them, evenly chosen:
   * what they show is seen by others, too. */
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

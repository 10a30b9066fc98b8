// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pair_ranking.h"
#include "place_support.h"

#include <pcl6d/global_registration/placeable_scan.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <optional>
#include <vector>

namespace pcl6d::global_registration {

/** \brief Scans with a place among all. */
struct PlacedScan {
  std::size_t scan = 0;
  Eigen::Isometry3d T_group_scan = Eigen::Isometry3d::Identity();
};

/** \brief How well a scan fits a place among others, by all of them together. */
struct JointSupport {
  double overlap = 0;       ///< share of its points that meet any of them, in [0, 1]
  double contradiction = 0; ///< free, as share of free and met, over all of them
  double met_points = 0, free_points = 0; ///< of all pairs of scans
  double score = 0;                       ///< overlap exp(-contradiction / scale)
  std::vector<std::size_t>
      met; ///< places in the group of those it meets, the most first
};

/** \brief Which points of a scan are matched. */
enum class MatchedBy {
  kFewPoints, ///< those that judge places: to come near
  kAll        ///< those that are to be matched
};

/** \brief Scans whose places relative to each other are known. */
class ScanGroup {
public:
  explicit ScanGroup(const ScanList& scans);

  void
  add(std::size_t scan, const Eigen::Isometry3d& T_group_scan);
  void
  remove(std::size_t scan);

  const std::vector<PlacedScan>&
  members() const
  {
    return members_;
  }
  /** \return a group of the same scans without members */
  ScanGroup
  without() const
  {
    return ScanGroup(*scans_);
  }
  const PlaceableScan&
  scan(std::size_t place) const
  {
    return *(*scans_)[place];
  }
  /** \return the place of a scan, if it is a member */
  std::optional<Eigen::Isometry3d>
  placeOf(std::size_t scan) const;

  /** \brief Judges a place of a scan, which may be a member: itself is not asked.
   * \param[in] distance, sigma as supportOf() \param[in] scale of contradictions */
  JointSupport
  support(std::size_t scan,
          const Eigen::Isometry3d& T_group_scan,
          double distance,
          double sigma,
          double scale,
          std::size_t every = 1) const;

  /** \brief Matches a scan with those that it meets. \param[in] start [m] as
   * matchingOptions() */
  Eigen::Isometry3d
  matched(std::size_t scan,
          const Eigen::Isometry3d& T_group_scan,
          const std::vector<std::size_t>& met,
          double start,
          MatchedBy by = MatchedBy::kAll) const;

private:
  bool
  reaches(std::size_t scan, const Eigen::Isometry3d& T, const PlacedScan& other) const;

  const ScanList* scans_;
  std::vector<PlacedScan> members_;
};

} // namespace pcl6d::global_registration

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pair/pair_ranking.h"
#include "pair/place_support.h"

#include <pcl6d/global_registration/placeable_scan.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <optional>
#include <vector>

namespace pcl6d::global_registration {

/** \brief A scan with its pose in the group. */
struct PlacedScan {
  std::size_t scan = 0;
  Eigen::Isometry3d T_group_scan = Eigen::Isometry3d::Identity();
};

/** \brief Support of a pose of a scan by the whole group. */
struct JointSupport {
  double overlap = 0;       ///< share of points on a surface of any member, in [0, 1]
  double contradiction = 0; ///< violations / (violations + met points)
  double met_points = 0, free_points = 0; ///< summed over the pairs of scans
  double score = 0;                       ///< overlap exp(-contradiction / scale)
  std::vector<std::size_t>
      met; ///< indices in the group of overlapping members, most overlap first
};

/** \brief Which points of a scan are matched. */
enum class MatchedBy {
  kFewPoints, ///< the test points: a coarse match
  kAll        ///< every point for matching
};

/** \brief Scans with known relative poses. */
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
  /** \return an empty group over these scans */
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
  /** \return the pose of a scan, if it is a member */
  std::optional<Eigen::Isometry3d>
  placeOf(std::size_t scan) const;

  /** \brief Tests a pose of a scan; a member does not test itself.
   * \param[in] distance, sigma as supportOf()
   * \param[in] scale of contradictions */
  JointSupport
  support(std::size_t scan,
          const Eigen::Isometry3d& T_group_scan,
          double distance,
          double sigma,
          double scale,
          std::size_t every = 1) const;

  /** \brief Matches a scan with its overlapping members.
   * \param[in] start [m] as matchingOptions() */
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

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/graph_relaxation/network_scan.h>
#include <pcl6d/graph_relaxation/scan_network.h>

#include <Eigen/Geometry>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace pcl6d {

/** Finds the partner in scan a of points of scan b. */
class PartnerSearch {
public:
  using RememberedPartner = ScanNetwork::RememberedPartner;

  PartnerSearch(const NetworkScan& a,
                const NetworkScan& b,
                const Eigen::Isometry3d& T_a_b,
                double max_distance)
  : a_(a.model())
  , b_(b.model())
  , T_a_b_(T_a_b)
  , limit_(static_cast<float>(max_distance))
  , limit_sq_(static_cast<float>(max_distance * max_distance))
  {}

  /** \return the index of the partner of b's i-th point; -1 without a partner */
  int
  operator()(std::size_t i) const
  {
    return a_.tree().nearest(place(i), limit_sq_).index;
  }

  /** The partner, without a search if no other point can have become nearer. */
  int
  operator()(std::size_t i, RememberedPartner& last) const
  {
    constexpr float kRounding = 16 * std::numeric_limits<float>::epsilon();
    const Eigen::Vector3f p = place(i);
    const float own_sq = distanceSqTo(last.index, p), own = std::sqrt(own_sq);
    const float sizes =
        p.cwiseAbs().maxCoeff() + last.others + (last.index < 0 ? 0 : own);
    const float others = last.others - (p - last.at).norm() - kRounding * sizes;
    if (own < others || (own >= limit_ && others >= limit_))
      return own_sq < limit_sq_ ? last.index : -1;
    search(p, own_sq, last);
    return distanceSqTo(last.index, p) < limit_sq_ ? last.index : -1;
  }

private:
  Eigen::Vector3f
  place(std::size_t i) const
  {
    return (T_a_b_ * b_.points()[i].cast<double>()).cast<float>();
  }

  float
  distanceSqTo(int index, const Eigen::Vector3f& p) const
  {
    return index < 0 ? std::numeric_limits<float>::infinity()
                     : distanceSq(p, a_.points()[static_cast<std::size_t>(index)]);
  }

  void
  search(const Eigen::Vector3f& p, float own_sq, RememberedPartner& last) const
  {
    const float reach = (1 + kReach) * limit_, reach_sq = reach * reach;
    TwoNearest best{{-1, reach_sq}, reach_sq};
    const bool has_candidate = own_sq < reach_sq;
    if (has_candidate) {
      const float second = std::sqrt(own_sq) + kReach * limit_;
      best = {{last.index, own_sq}, std::min(reach_sq, second * second)};
    }
    a_.tree().improveTwo(p, best, has_candidate ? last.index : -1);
    last.at = p;
    last.index = best.nearest.index;
    last.others = std::sqrt(best.second_sq);
  }

  /** Share of the limit added to the search radius: rounds move scans by less. */
  static constexpr float kReach = 0.2F;

  const IcpModel& a_;
  const IcpModel& b_;
  Eigen::Isometry3d T_a_b_;
  float limit_, limit_sq_; ///< [m], [m^2]
};

} // namespace pcl6d

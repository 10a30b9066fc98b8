// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/registration/icp_model.h>
#include <pcl6d/visibility/ray_image.h>

#include <Eigen/Geometry>

#include <cstddef>
#include <functional>
#include <utility>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

class WorkSharing;

/** \brief A scan as a member of a network: its point search, its extent, and its rays.
 * \ingroup graph_relaxation */
class NetworkScan {
public:
  /** \param[in] model is kept by reference */
  explicit NetworkScan(const IcpModel& model);

  const IcpModel&
  model() const
  {
    return *model_;
  }
  /** \return its rays, from the points of the model */
  const RayImage&
  rays() const
  {
    return rays_;
  }
  /** \return the middle of its points, in its own frame [m] */
  const Eigen::Vector3d&
  centre() const
  {
    return centre_;
  }
  /** \return the largest distance of a point from the centre [m] */
  double
  radius() const
  {
    return radius_;
  }

private:
  const IcpModel* model_;
  RayImage rays_;
  Eigen::Vector3d centre_ = Eigen::Vector3d::Zero();
  double radius_ = 0;
};

/** \brief Two scans, first < second. */
using ScanPair = std::pair<std::size_t, std::size_t>;
using Poses = std::vector<Eigen::Isometry3d>; ///< T_world_scan, one per scan

/** \brief Counts of points of one scan tested by another. */
struct PointVotes {
  std::size_t points = 0; ///< tested points
  std::size_t near = 0;   ///< points with a point of the other scan within a distance
  std::size_t empty = 0;  ///< violations: points in the free space of the other scan

  PointVotes&
  operator+=(const PointVotes& other);

  /** \return (near - empty) / points; 0 without points */
  double
  share() const;
};

/** \param[in] distance [m] within which a point is near
 * \param[in] stride tests each stride-th point of `scan`; >= 1 */
PointVotes
votesOf(const NetworkScan& scan,
        const NetworkScan& other,
        const Eigen::Isometry3d& T_other_scan,
        double distance,
        std::size_t stride = 1);

/** \return the overlap: share of the points of one scan with a partner in the other within a
 * distance [m], the larger of both ways, in [0, 1]; from samples of the points */
double
overlapOf(const NetworkScan& a,
          const NetworkScan& b,
          const Eigen::Isometry3d& T_a_b,
          double distance);

/** \return the pairs of overlapping scans: overlapOf() at the poses reaches min_overlap.
 * Candidates come from bounding spheres; a scan is compared with at most the 64 nearest
 * earlier scans, so that the number of pairs grows linearly with the number of scans.
 * \param[in] distance [m] within which points are partners
 * \param[in] min_overlap of a pair; called from several threads
 * \param[in] num_threads 0: a thread per core; never changes the result
 * \param[in] sharing shares the work between processes; null: one process */
std::vector<ScanPair>
overlappingPairs(const std::vector<NetworkScan>& scans,
                 const Poses& poses,
                 double distance,
                 const std::function<double(const ScanPair&)>& min_overlap,
                 unsigned int num_threads,
                 WorkSharing* sharing = nullptr);

} // namespace pcl6d

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/object_localization/scan_targets.h>
#include <pcl6d/search/point_tree.h>

#include <optional>
#include <vector>

/** \file The parts of findTargets(). */
namespace pcl6d::targets {

/** \brief The finite points of a scan, their intensities if available, and a search
 * tree. */
struct TargetScan {
  Points points;
  std::vector<float> intensity;
  PointTree tree;
};

/** \brief A fault of a candidate, with its number. */
struct MeasuredFault {
  TargetFault fault = TargetFault::kOtherDiameter;
  double measured = 0; ///< see TargetFault
};

/** \brief Cosine of the largest angle between rays and the normal of a board: 70 degrees, at which a
 * board appears a third as wide. */
constexpr double kGrazing = 0.342;

/** \brief Adds a candidate to the found targets, or with a fault to the rejected ones. */
void
addTarget(const FoundTarget& candidate,
          const std::optional<MeasuredFault>& fault,
          TargetSearch& search);

/** \return indices of the points within a distance [m] of a position, ascending */
std::vector<std::size_t>
pointsNear(const TargetScan& scan, const Eigen::Vector3d& place, double distance);

/** \return one point of each occupied voxel, in the order of the points */
std::vector<std::size_t>
seedsOf(const TargetScan& scan, double voxel);

/** \brief Adds the spheres found around the seeds. \param[in] diameter [m] */
void
findSpheres(const TargetScan& scan,
            double diameter,
            unsigned int num_threads,
            TargetSearch& search);

/** \brief Adds the boards found around the seeds. \param[in] size [m] edge of the
 * square */
void
findBoards(const TargetScan& scan,
           double size,
           unsigned int num_threads,
           TargetSearch& search);

} // namespace pcl6d::targets

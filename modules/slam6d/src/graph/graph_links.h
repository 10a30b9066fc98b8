// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/pose_graph.h>
#include <pcl6d/common/run_result.h>
#include <pcl6d/graph_relaxation/error_diffusion.h>
#include <pcl6d/graph_relaxation/graph_slam.h>
#include <pcl6d/graph_relaxation/network_scan.h>
#include <pcl6d/graph_relaxation/scan_link.h>

#include <optional>
#include <string>
#include <vector>

/** \file Results of a relaxation for the links of a run. */
namespace pcl6d::slam6d {

/** \return why a relaxation is rejected independently of the map: no solution, or links without a
 * cycle; empty: acceptable */
Rejection
whyNotTaken(const GraphSlamResult& relaxed);

/** \return the odometry link of a scan to the previous scan, used where points are too few */
ScanLink
odometryLink(const Poses& poses, std::size_t scan, std::size_t pairs);

/** \return a step between two scans as a measured link, known as odometry without stated noise is
 * \param[in] voxel [m] of the reduction, the length scale of the scans */
PoseLink
stepLink(std::size_t from,
         std::size_t to,
         const Eigen::Isometry3d& T_from_to,
         double voxel);

/** \return the odometry of each link as a measured link, which connects scans without common points
 * (6.3) \param[in] scans with their initial poses
 * \param[in] voxel [m] of the reduction, the length scale of the scans */
std::vector<PoseLink>
measuredLinks(const std::vector<ScanLink>& odometry,
              const std::vector<ScanResult>& scans,
              double voxel);

/** \return the graph over which ELCH (5.1.3) distributes errors: each scan linked to the previous
 * scan, with the covariance of its match, or of the odometry for an unmatched scan
 * \param[in] count of scans, from the first on */
PCL6D_EXPORTS std::vector<LoopEdge> // exported for its test
chainOf(const std::vector<ScanResult>& scans, std::size_t count, double voxel);

/** \return [m^2] covariances of the positions: each a sum over the steps from the first scan, plus
 * a thousandth of the voxel. Matches count as independent */
PCL6D_EXPORTS std::vector<Eigen::Matrix3d> // exported for its test
driftOf(const std::vector<ScanResult>& scans, std::size_t count, double voxel);

/** \return the cost of a loop from the covariance of its match; none if unknown */
PCL6D_EXPORTS std::optional<PerDimension> // exported for its test
costOf(const ScanLink& loop);

/** \return the loops with an open gap between their ends
 * \param[in] max_distance [m] of point pairs in matching */
std::vector<Loop>
openLoops(const std::vector<ScanLink>& found, const Poses& poses, double max_distance);

/** \return the chain of the scans, and the closed loops among the links
 * \param[in] open loops, left out */
std::vector<LoopEdge>
edgesOf(const std::vector<ScanResult>& scans,
        std::size_t count,
        const std::vector<ScanLink>& links,
        const std::vector<Loop>& open,
        double voxel);

/** \brief Merges loop candidates with links of the network between the same scans: the link gets
 * the candidate's matched pose, and the candidate is removed.
 * \param[in,out] links of the network \param[in,out] candidates of loops */
void
takeLoops(std::vector<ScanLink>& links, std::vector<ScanLink>& candidates);

/** \brief Writes the results of the relaxation to the links.
 * \param[in,out] links of the network, in the order of their scans
 * \param[in,out] graph gets the used links */
void
rejectSwitchedOff(const GraphSlamResult& relaxed,
                  std::vector<ScanLink>& links,
                  std::vector<PoseLink>& graph);

/** \brief Replaces links with too few pairs by odometry links between the same scans, and adds the
 * rest. \param[in,out] links in the order of their scans */
void
putIn(const std::vector<ScanLink>& odometry, std::vector<ScanLink>& links);

/** \return whether a scan was recovered off the odometry from the previous scan, with both scans
 * registered */
bool
isRefuted(const std::vector<ScanResult>& scans, std::size_t scan);

} // namespace pcl6d::slam6d

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

/** \file What a relaxation says of the links of a run. */
namespace pcl6d::slam6d {

/** \return why a relaxation is not taken whatever the map looks like: it found no answer, or
 * its links close no cycle; empty: it may be taken */
std::string
whyNotTaken(const GraphSlamResult& relaxed);

/** \return the link of a scan and the one before it, which no points join */
ScanLink
odometryLink(const Poses& poses, std::size_t scan);

/** \return the odometry of each link as a measured one, which joins scans that no points do
 * (6.3) \param[in] scans with their initial poses
 * \param[in] voxel [m] of the reduction, which tells the scale of the scans */
std::vector<PoseLink>
measuredLinks(const std::vector<ScanLink>& odometry,
              const std::vector<ScanResult>& scans,
              double voxel);

/** \return the graph that ELCH (5.1.3) spreads errors over: each scan and the one before it,
 * with the covariance of its match, or of the odometry if there is none
 * \param[in] count of scans, from the first one */
PCL6D_EXPORTS std::vector<LoopEdge> // shown to its test
chainOf(const std::vector<ScanResult>& scans, std::size_t count, double voxel);

/** \return [m^2] covariances of the positions, each the sum of those of the steps from the first
 * scan, and a thousandth of the voxel: matches count as independent */
PCL6D_EXPORTS std::vector<Eigen::Matrix3d> // shown to its test
driftOf(const std::vector<ScanResult>& scans, std::size_t count, double voxel);

/** \return what a loop costs, by the covariance of its match; none if it is not known */
PCL6D_EXPORTS std::optional<PerDimension> // shown to its test
costOf(const ScanLink& loop);

/** \return the loops whose ends do not meet yet
 * \param[in] max_distance [m] within which matching pairs points */
std::vector<Loop>
openLoops(const std::vector<ScanLink>& found, const Poses& poses, double max_distance);

/** \return the chain of the scans, and the loops among the links that are closed already
 * \param[in] open the others */
std::vector<LoopEdge>
edgesOf(const std::vector<ScanResult>& scans,
        std::size_t count,
        const std::vector<ScanLink>& links,
        const std::vector<Loop>& open,
        double voxel);

/** \brief A closed loop is one link: candidates that the network knows are taken over into its
 * links, with their matched pose, and are candidates no more.
 * \param[in,out] links of the network \param[in,out] candidates of loops */
void
takeLoops(std::vector<ScanLink>& links, std::vector<ScanLink>& candidates);

/** \brief Writes down what relaxation made of the links.
 * \param[in,out] links of the network, in the order of their scans
 * \param[in,out] graph gets those that are used */
void
judgeLinks(const GraphSlamResult& relaxed,
           std::vector<ScanLink>& links,
           std::vector<PoseLink>& graph);

/** \brief Puts links in the place of those between the same scans, whose few pairs do not
 * count. \param[in,out] links in the order of their scans */
void
putIn(const std::vector<ScanLink>& odometry, std::vector<ScanLink>& links);

/** \return whether a scan was found again where the odometry did not lead from the one before,
 * which is believed too */
bool
isRefuted(const std::vector<ScanResult>& scans, std::size_t scan);

} // namespace pcl6d::slam6d

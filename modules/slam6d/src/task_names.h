// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/points.h>
#include <pcl6d/graph_relaxation/scan_link.h>
#include <pcl6d/slam6d/slam6d.h>
#include <pcl6d/slam6d/slam6d_result.h>

#include <cstdint>
#include <vector>

/** \file A hash of the input of a task, by which a journal identifies the task. */
namespace pcl6d::slam6d {

/** \return the hash of a scan and all scans before
 * \param[in] before the hash of the previous scan; ignored for the first
 * \param[in] place index of the scan in the run
 * \param[in] drive see Slam6D::addScan() */
std::uint64_t
inputsOf(std::uint64_t before,
         std::size_t place,
         const Points& points,
         const ScanResult& scan,
         const DriveContext& drive);

/** \return the hash of a task
 * \param[in] inputs of its last scan \param[in] result with the parameters
 * \param[in] improved number of first scans moved by an earlier optimize()
 * \param[in] links given by the user or stages */
std::uint64_t
taskOf(std::uint64_t inputs,
       const Slam6DResult& result,
       std::size_t improved,
       const std::vector<ScanPair>& links = {});

} // namespace pcl6d::slam6d

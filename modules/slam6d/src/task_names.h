// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/points.h>
#include <pcl6d/graph_relaxation/scan_link.h>
#include <pcl6d/slam6d/slam6d_result.h>

#include <cstdint>
#include <vector>

/** \file What a task of a run works on, as one number, by which a journal knows it again. */
namespace pcl6d::slam6d {

/** \return what a scan and all before it are
 * \param[in] before the same of the scan before; of no account for the first
 * \param[in] place of the scan in the run */
std::uint64_t
inputsOf(std::uint64_t before,
         std::size_t place,
         const Points& points,
         const ScanResult& scan);

/** \return the name of a task
 * \param[in] inputs of its last scan \param[in] result with the parameters
 * \param[in] improved so many first scans an earlier optimize() has moved
 * \param[in] links that were given */
std::uint64_t
taskOf(std::uint64_t inputs,
       const Slam6DResult& result,
       std::size_t improved,
       const std::vector<ScanPair>& links = {});

} // namespace pcl6d::slam6d

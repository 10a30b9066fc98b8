// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/trajectory.h>

#include <filesystem>
#include <optional>
#include <string>
#include <vector>

/** \file Time stamps of poses and of scan files, compared. */
namespace pcl6d::io {

/** \brief Selects from a trajectory the pose nearest in time to each scan.
 * \param[in] stamps [s] of the scans, increasing
 * \return a pose for each scan; empty if stamps are missing, or a scan has no pose within half of
 * the smaller median step of poses and scans */
std::optional<Trajectory>
posesAtStamps(const Trajectory& trajectory, const std::vector<double>& stamps);

/** \brief Compares the stamps of the scans with the stamps in their names (stampsOfNames()).
 * Stamps that begin before 2001 are not of the clock of the names: then only the times since
 * the first scan are compared.
 * \param[in] stamps [s] of the scans, or empty \param[in] source of the stamps, for people
 * \return a sentence that names the first scan with a difference above half of the median step;
 * empty: the stamps agree, or one of the sources is missing */
std::string
contradictionOfStamps(const std::vector<double>& stamps,
                      const std::string& source,
                      const std::vector<std::filesystem::path>& scans);

} // namespace pcl6d::io

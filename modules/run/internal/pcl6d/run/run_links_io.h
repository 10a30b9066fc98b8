// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>
#include <pcl6d/common/run_result.h>

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Writes links.csv, atomically. \throws IoFailed the file cannot be written
 * \ingroup run */
void
writeRunLinks(const std::filesystem::path& path, const std::vector<RunLink>& links);

/** \brief Writes verification.csv, atomically. \param[in] links by the numbers NNN of
 * their scans \throws IoFailed the file cannot be written \ingroup run */
void
writeLinkChecks(const std::filesystem::path& path, const std::vector<LinkCheck>& links);

/** \brief Reads verification.csv: scans by their numbers, trust, probability, patches, shift,
 * deviation, open directions, detectable errors and reason; columns that a graph does not need are
 * optional.
 * \throws IoFailed as readRunLinks() \ingroup run */
std::vector<LinkCheck>
readLinkChecks(const std::filesystem::path& path);

/** \brief Reads links.csv by its column names; columns irrelevant to a graph (reason, distance,
 * overlap, condition, weight) are optional.
 * \param[in] fault returns the fault of a link, or an empty text; empty function: no check
 * \throws IoFailed naming file, line, value and rule: unreadable, a column is missing, a row has
 * another number of columns, an invalid number or word, a fault \ingroup run */
std::vector<RunLink>
readRunLinks(const std::filesystem::path& path,
             const std::function<std::string(const RunLink&)>& fault = {});

} // namespace pcl6d

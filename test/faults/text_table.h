// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "case.h"

#include <filesystem>
#include <string>
#include <vector>

/** \file The tables of the tool: columns with " | " between, # for comments. */
namespace pcl6d::faults {

/** \return the rows; the last column may hold | itself
 * \throws std::runtime_error there is no such file, or a row has fewer columns */
std::vector<std::vector<std::string>>
rowsOf(const std::filesystem::path& file, std::size_t columns);

/** \return the words of a text; quotes hold blanks together */
std::vector<std::string>
separated(const std::string& text);

/** \brief Sets program, arguments and inputs.
 * \param[in] inputs samples, separated by blanks
 * \param[in] call such as "pcl_slam6d_graph info in.g2o" */
void
setCall(Case& one, const std::string& inputs, const std::string& call);

} // namespace pcl6d::faults

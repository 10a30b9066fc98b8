// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "case.h"

#include <cstdint>

namespace pcl6d::faults {

/** \brief An option that takes a value, as --help tells. */
struct Option {
  std::string name;       ///< "--voxel"
  std::string short_name; ///< "-o"; empty: none
  bool is_number = false; ///< by its default and the word for its value
};

/** \return the options with a value in the text of --help */
std::vector<Option>
optionsOf(const std::string& help);

/** \return the jobs that the text of --help names; none: the program has but one */
std::vector<std::string>
jobsOf(const std::string& help);

/** \return extreme values, a few for each option of each job of each program, read from
 * their --help, so that a new option comes by itself
 * \param[in] calls the table calls.txt
 * \param[in] scratch a folder for what the programs print
 * \throws std::runtime_error a program or job has no row in the table */
std::vector<Case>
extremeOptionCases(const std::filesystem::path& calls,
                   const std::filesystem::path& programs,
                   const std::filesystem::path& scratch,
                   std::uint64_t seed);

} // namespace pcl6d::faults

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "breakage.h"
#include "case.h"

namespace pcl6d::faults {

/** \brief A file that one call of one program reads: a row of targets.txt. */
struct Target {
  std::string call;   ///< program, then arguments
  std::string inputs; ///< samples that the call needs, separated by blanks
  std::string broken; ///< which file below them is broken
  Format format = Format::kBytes;
  std::size_t cases = 0; ///< how many breakages of it belong to a whole round
  bool needs_all_numbers = true;
  bool may_be_empty = false;
  bool may_be_missing = false;
  bool holds_rotations = false;
};

/** \return the rows of targets.txt \throws std::runtime_error it is not as it should be */
std::vector<Target>
readTargets(const std::filesystem::path& file);

/** \return for each target a case that is whole, and its broken ones
 * \param[in] samples the folder of makeSamples() */
std::vector<Case>
brokenInputCases(const std::vector<Target>& targets,
                 const std::filesystem::path& samples,
                 std::uint64_t seed);

} // namespace pcl6d::faults

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "case.h"

#include <regex>

namespace pcl6d::faults {

/** \brief A finding that is as it should be, with the reason: a row of accepted.txt. */
struct Acceptance {
  std::string kind;
  std::regex name;  ///< of cases
  std::regex words; ///< of findings
  std::string reason;
  std::size_t uses = 0; ///< how often it was needed
};

/** \return the rows of accepted.txt
 * \throws std::runtime_error a row has no reason or an unknown kind */
std::vector<Acceptance>
readAcceptances(const std::filesystem::path& file);

/** \return whether one of them covers the finding, whose uses are then one more */
bool
isAccepted(const Case& one,
           const Finding& finding,
           std::vector<Acceptance>& acceptances);

} // namespace pcl6d::faults

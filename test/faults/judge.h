// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "case.h"
#include "child.h"

#include <map>

namespace pcl6d::faults {

/** Path below a folder to what lies there: type, size and a hash of the bytes. */
using Listing = std::map<std::string, std::string>;

/** \return all that lies below a folder */
Listing
listingOf(const std::filesystem::path& folder);

/** \brief All that is known of a case that has run. */
struct Trace {
  Ended end;
  std::string out, err;  ///< what it printed, up to 1 MB each
  Listing before, after; ///< of its folder
  std::size_t left_processes = 0;
  std::size_t input_size = 0; ///< [B] of all its inputs
};

/** \return what is wrong, in the order of findingKinds(); nothing: it passed */
std::vector<Finding>
evaluate(const Case& one, const Trace& trace);

} // namespace pcl6d::faults

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** \file How large a scan may be. Internal to the module scanner. */
namespace pcl6d {

/** \throws BadArgument lines or samples below 1, or more than 1e8 samples; the message
 * states the memory that they would take */
void
requireScanSize(double num_lines, double samples_per_line);

} // namespace pcl6d

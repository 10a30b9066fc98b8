// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** \file How large scans and images may be. */
namespace pcl6d::scanner {

/** \throws BadArgument rows or columns below 1, or more than 1e8 pixels; the message
 * states the memory of the range image */
void
requireImageSize(int rows, int cols);

/** \throws BadArgument lines or samples below 1, or more than 1e8 samples; the message
 * states the memory of the scan */
void
requireScanSize(double num_lines, double samples_per_line);

} // namespace pcl6d::scanner

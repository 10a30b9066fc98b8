// SPDX-License-Identifier: BSD-3-Clause
#pragma once

/** \file How large an image may be. Internal to the module scanner. */
namespace pcl6d {

/** \throws BadArgument rows or columns below 1, or more than 1e8 pixels; the message
 * states the memory that a range image of that size would take */
void
requireImageSize(int rows, int cols);

} // namespace pcl6d

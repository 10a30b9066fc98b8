// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "pcd_header.h"
#include "text_input.h"

/** \file The points of a PCD file. Internal to the module io. */
namespace pcl6d {

/** \param[in] input stands behind the header
 * \return the points, laid out as in the header; padding is no field any more
 * \throws IoFailed naming place, value and rule: too short, text that is no number,
 * broken compression */
pcl::PCLPointCloud2
decodePcdBody(text::Input& input, const PcdHeader& header);

} // namespace pcl6d

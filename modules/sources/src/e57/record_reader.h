// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "e57/bit_stream.h"

#include <functional>

namespace pcl6d::sources {

/** \brief Takes the next values of the requested fields, in the requested order.
 * \param[in] count number of valid values per column; further values of a column are passed
 * again */
using RecordSink = std::function<void(const std::vector<const E57Column*>& columns,
                                      std::size_t count)>;

/** \brief Reads the points of a scan, packet by packet (ASTM E2807, 9.3). Index packets are
 * skipped. \param[in] title of the scan, for messages
 * \param[in] wanted numbers of the fields
 * \throws IoFailed naming file, scan and position: the section, a packet or a field is broken,
 * or values are missing for some points. A number of points that exceeds the bytes is reported
 * before reading. */
void
readRecords(PageReader& file,
            const E57Scan& scan,
            const std::string& title,
            const std::vector<std::size_t>& wanted,
            const RecordSink& sink);

} // namespace pcl6d::sources

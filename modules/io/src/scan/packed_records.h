// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/io/scan_reader.h>

#include <cstdint>
#include <vector>

/** \file Points in packed records of numbers of several types (HeLiPR). */
namespace pcl6d::io {

/** \return whether points of the layout are packed records */
bool
isPackedRecord(BinLayout layout);

/** \return the points, with the numbers of the records as fields
 * \param[in] path for messages; for kHeliprAeva the name is the stamp, which decides whether
 * the records have an intensity \throws IoFailed the size is not a multiple of the record size */
ScanCloud
fromPackedRecords(const std::filesystem::path& path,
                  BinLayout layout,
                  std::vector<std::uint8_t> data);

} // namespace pcl6d::io

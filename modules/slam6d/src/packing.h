// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/packing.h>
#include <pcl6d/global_registration/scan_joiner.h>
#include <pcl6d/slam6d/slam6d_result.h>

#include <string>

/** \file Serialisation of results: the fields of run_fields.h, and the fields kept in no file. */
namespace pcl6d {
template <typename Archive>
void
packFields(Archive& archive, KnownPlace& place)
{
  archive(place.group, place.T_group_scan);
}
} // namespace pcl6d

namespace pcl6d::slam6d {

/** \return the bytes of a result */
std::string
packed(const ScanResult& scan);
std::string
packed(const Slam6DResult& result);

/** \throws IoFailed too few bytes, or too many */
void
unpack(const std::string& bytes, ScanResult& scan);
void
unpack(const std::string& bytes, Slam6DResult& result);

} // namespace pcl6d::slam6d

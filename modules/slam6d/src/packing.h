// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/packing.h>
#include <pcl6d/slam6d/slam6d_result.h>

#include <string>

/** \file Results as bytes. The fields are those of run_fields.h, and those that no file
 * keeps. */
namespace pcl6d::slam6d {

/** \return the bytes of a result */
std::string
packed(const ScanResult& scan);
std::string
packed(const Slam6DResult& result);

/** \throws IoFailed there are too few bytes, or too many */
void
unpack(const std::string& bytes, ScanResult& scan);
void
unpack(const std::string& bytes, Slam6DResult& result);

} // namespace pcl6d::slam6d

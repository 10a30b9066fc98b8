// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/slam6d/plugin.h>

#include <string>

/** \file
 * Plug-in functions with a guard: exceptions and invalid results become ComputeFailed, with the
 * name of the part in the message. */
namespace pcl6d::slam6d {

/** \param[in] who part and file, e.g. "minimiser mine of /tmp/my.so" */
RigidMinimiser
guarded(const std::string& who, RigidMinimiser step);

PlaneMinimiser
guarded(const std::string& who, PlaneMinimiser step);

/** Distances are recomputed, to equal the bits of built-in searches. */
SearchMaker
guarded(const std::string& who, SearchMaker search);

ScanFilter
guarded(const std::string& who, ScanFilter filter);

ScanReader
guarded(const std::string& who, ScanReader reader);

} // namespace pcl6d::slam6d

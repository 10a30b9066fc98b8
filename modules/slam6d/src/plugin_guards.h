// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/slam6d/plugin.h>

#include <string>

/** \file
 * The functions of plug-ins with a guard about them: whatever they throw becomes ComputeFailed
 * that names them, and so does what no such function may return. */
namespace pcl6d::slam6d {

/** \param[in] who "minimiser mine of /tmp/my.so" */
RigidMinimiser
guarded(const std::string& who, RigidMinimiser step);

PlaneMinimiser
guarded(const std::string& who, PlaneMinimiser step);

/** Distances are measured anew, so that they have the bits of all searches. */
SearchMaker
guarded(const std::string& who, SearchMaker search);

ScanFilter
guarded(const std::string& who, ScanFilter filter);

ScanReader
guarded(const std::string& who, ScanReader reader);

} // namespace pcl6d::slam6d

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

/** \file Names of run options that further modules read from the summary. The remaining names
 * appear only in the row of the option (OptionSpec). */
namespace PCL6D_EXPORTS pcl6d {

constexpr char kMinRangeOption[] = "min-range";
constexpr char kMaxRangeOption[] = "max-range";
constexpr char kVoxelOption[] = "voxel";
constexpr char kLoopClosingOption[] = "loop-closing";
constexpr char kRelaxationOption[] = "relaxation";

} // namespace pcl6d

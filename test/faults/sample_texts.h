// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace pcl6d::faults {

/** \return names and contents of the samples that are short texts */
const std::vector<std::pair<std::string, std::string>>&
sampleTexts();

} // namespace pcl6d::faults

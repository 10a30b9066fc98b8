// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <pcl6d/common/export.h>

#include <cstddef>
#include <functional>
#include <string>

namespace PCL6D_EXPORTS pcl6d {

/** \brief Progress of a stage. Libraries report progress by callback and never print.
 * \ingroup common */
struct Progress {
  std::string stage;     ///< the stage: "reading", "matching"
  std::size_t done = 0;  ///< finished steps
  std::size_t total = 0; ///< number of steps; 0 if not known
};

/** \brief Called from the thread of the stage. May be empty. */
using ProgressCallback = std::function<void(const Progress&)>;

} // namespace pcl6d

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "evaluate/suite/suite_file.h"

namespace pcl6d::app {

/** \brief Sources of a damaged folder. */
struct DamageSource {
  std::filesystem::path scans;   ///< folder of scans
  std::filesystem::path truth;   ///< trajectory, one pose per scan; empty: no truth
  std::filesystem::path foreign; ///< folder of foreign scans
};

/** \brief Makes a folder of damaged scans: links to the scans, or thinned copies;
 * `odometry.txt` (unless the damage removes poses); `groundtruth.txt`, where swapped
 * scans keep their true poses; `times.txt`, if the source has one.
 *
 * Noise is the error of each odometry step, in position and direction; its translation
 * and angle are scaled: 0 gives the truth, 1 keeps the odometry.
 * \param[in] folder empty
 * \throws BadArgument a scan is missing; noise without truth; a change of poses without
 * poses; not one true pose per scan; scans of two formats
 * \throws IoFailed a file cannot be read or written */
void
makeDamagedFolder(const SuiteDamage& damage,
                  const DamageSource& source,
                  const std::filesystem::path& folder);

/** \brief Writes the links of a damage for --graph-in. \throws IoFailed writing failed */
void
writeLinks(const std::filesystem::path& file, const SuiteDamage& damage);

} // namespace pcl6d::app

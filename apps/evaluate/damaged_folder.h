// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include "evaluate/suite_file.h"

namespace pcl6d::app {

/** \brief What a damaged folder is made from. */
struct DamageSource {
  std::filesystem::path scans; ///< folder of scans
  std::filesystem::path truth; ///< trajectory, one pose per scan; empty: there is none
  std::filesystem::path foreign; ///< folder that a foreign scan comes from
};

/** \brief Makes a folder of scans with what a damage makes of them: links to the scans, or
 * thinned copies; `odometry.txt` (unless there are no poses); `groundtruth.txt`, where
 * scans that change places take their true poses with them; `times.txt`, if there is one.
 *
 * Noise is what each step of the odometry is off by, in place and direction; its
 * translation and its angle are multiplied, so that 0 is the truth and 1 changes nothing.
 * \param[in] folder empty
 * \throws BadArgument a scan is not there; noise without truth; poses without any; the
 * truth has another number of poses; scans of two formats
 * \throws IoFailed a file cannot be read or written */
void
makeDamagedFolder(const SuiteDamage& damage,
                  const DamageSource& source,
                  const std::filesystem::path& folder);

/** \brief Writes the links of a damage for --graph-in. \throws IoFailed it cannot */
void
writeLinks(const std::filesystem::path& file, const SuiteDamage& damage);

} // namespace pcl6d::app
